"""The cylinder as a beam: simply supported, with the line load over the generatrix in the middle of the span."""

from __future__ import annotations

from typing import Any

from diecut_report.api import formula


@formula
def deflection(
    line_load: Any, generatrix_length: Any, bearing_span: Any, elastic_modulus: Any, second_moment_min: Any
) -> Any:
    """Deflection in the middle of the span."""
    return (
        line_load
        * generatrix_length
        * (8 * bearing_span**3 - 4 * bearing_span * generatrix_length**2 + generatrix_length**3)
        / (384 * elastic_modulus * second_moment_min)
    )
