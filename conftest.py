"""Tests and notebooks learn under a name of their own: exercises have the same numbers everywhere, nothing is kept."""

import os

os.environ["CAMKIT_LEARNER"] = "instructor"
