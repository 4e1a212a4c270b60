"""From results to a report that is read and signed: HTML and PDF. Pure functions of the results."""

from diecut_report.report.rendering import Rendering, render_html, render_pdf

__all__ = ["Rendering", "render_html", "render_pdf"]
