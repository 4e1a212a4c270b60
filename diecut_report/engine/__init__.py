"""The engine: runs the steps that a mechanism declares, proves what it finds, and prints what it computed."""

from diecut_report.engine.calculation import Calculation, CurveHandle, Impossible, ImpossibleTogether, Unproven
from diecut_report.engine.steps.run import calculate

__all__ = ["Calculation", "CurveHandle", "Impossible", "ImpossibleTogether", "Unproven", "calculate"]
