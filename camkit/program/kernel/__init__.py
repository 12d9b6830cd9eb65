"""A program as native code (llvmlite, extra ``fast``): what it says of many designs, in a tenth of numpy's time."""

from .kernel import Kernel

__all__ = ["Kernel"]
