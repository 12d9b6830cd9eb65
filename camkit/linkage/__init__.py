"""Linkages: one module for each kind of linkage or machine."""
