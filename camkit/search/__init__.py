"""Searches for the best designs of a study: the only pymoo."""
