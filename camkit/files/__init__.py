"""Designs, studies, profiles and tables as files."""
