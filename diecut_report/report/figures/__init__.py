"""Figures of the results as SVG: charts and drawings.

Whatever draws with Matplotlib imports this package first, so that the library is imported with settings of its own.
"""

from diecut_report.report.scope import settings_of_its_own

with settings_of_its_own():
    import matplotlib.font_manager  # noqa: F401  # imported here for its settings, and for the folder in which it keeps its list of fonts
