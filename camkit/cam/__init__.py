"""Disk cams: one module for each kind of follower or machine."""
