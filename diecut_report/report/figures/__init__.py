"""Figures of the results as SVG: charts and drawings."""
