"""Quantities: numbers with units, and their neutral texts."""
