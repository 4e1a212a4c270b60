"""Curves on smooth pieces and what is found on them: extremes, roots, integrals, for all variants at once."""
