"""Formulas that mechanisms share: linkages, cams, motion laws, beams, belts."""
