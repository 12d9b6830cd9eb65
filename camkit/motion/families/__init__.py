"""Families of motion laws."""
