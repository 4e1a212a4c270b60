"""From results to a report: formulas, figures, document, HTML, PDF."""
