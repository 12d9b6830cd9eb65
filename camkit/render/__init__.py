"""Pictures: a view is ``f(analysis, ax) -> ax``; it computes no physics.

Calling a view again on the same axes moves what it drew, so the same function serves a printed figure and
a live panel.
"""
