"""Whole machines: design, measures and study, one file each."""
