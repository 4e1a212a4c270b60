"""Roots, extremes, integrals and jumps of piecewise smooth curves."""
