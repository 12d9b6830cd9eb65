"""What a cam can be chosen to be beside its sizes: how it turns, and what guides its roller."""

ROTATIONS = {"counter-clockwise": 1, "clockwise": -1}
"""``sigma``: which way the cam turns."""
CLOSURES = {"groove": True, "plate": False}
"""A groove has both flanks; a plate has the inner one, to which a spring or a weight holds the roller."""
