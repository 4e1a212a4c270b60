"""Design reports for die-cutting presses: a YAML description in, a checked calculation document out.

In scripts and notebooks: ``import diecut_report as dr; results = dr.load("press.yaml").calculate()`` (docs/python.md).
"""

__version__ = "1.0.0"
TYPE_CHECKING = False  # as type checkers know it; importing typing would run a file of that name in the current folder

if TYPE_CHECKING:
    from diecut_report.errors import ConfigError, PluginError, Problem, UnknownName, Unwritable, UserError
    from diecut_report.scripting.parts import CheckList, CheckResult, CurveResult, FigureResult, PhaseResult
    from diecut_report.scripting.press import (
        InfluenceTable,
        LoadedPress,
        MendedPress,
        PressInput,
        Solution,
        load,
        load_results,
        loads,
    )
    from diecut_report.scripting.results import MechanismResults, Results
    from diecut_report.scripting.sweeps import SweepTable
    from diecut_report.scripting.values import InputValue, QuantityValue, linspace

__all__ = [
    "CheckList",
    "CheckResult",
    "ConfigError",
    "CurveResult",
    "FigureResult",
    "InfluenceTable",
    "InputValue",
    "LoadedPress",
    "MechanismResults",
    "MendedPress",
    "PhaseResult",
    "PluginError",
    "PressInput",
    "Problem",
    "QuantityValue",
    "Results",
    "Solution",
    "SweepTable",
    "UnknownName",
    "Unwritable",
    "UserError",
    "__version__",
    "linspace",
    "load",
    "load_results",
    "loads",
]
_HOMES = {
    "errors": ("ConfigError", "PluginError", "Problem", "UnknownName", "Unwritable", "UserError"),
    "scripting.parts": ("CheckList", "CheckResult", "CurveResult", "FigureResult", "PhaseResult"),
    "scripting.press": (
        "InfluenceTable",
        "LoadedPress",
        "MendedPress",
        "PressInput",
        "Solution",
        "load",
        "load_results",
        "loads",
    ),
    "scripting.results": ("MechanismResults", "Results"),
    "scripting.sweeps": ("SweepTable",),
    "scripting.values": ("InputValue", "QuantityValue", "linspace"),
}
_HOME_OF = {name: home for home, names in _HOMES.items() for name in names}


def __getattr__(name: str) -> object:
    """Return what scripts use, loaded when it is asked for: the command line does without it."""
    if name not in _HOME_OF:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib import import_module

    found = globals()[name] = getattr(import_module(f"{__name__}.{_HOME_OF[name]}"), name)
    return found


def __dir__() -> list[str]:
    """Return what scripts use."""
    return __all__
