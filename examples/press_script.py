"""A script of a designer: which crank of a knife's shaft keeps the torque below 2 N·m, and what its report says.

Run it in this folder, ``python press_script.py``; type checkers know all that it uses.
"""

from __future__ import annotations

from pathlib import Path
from typing import assert_type

import diecut_report as dr

HERE = Path(__file__).parent


def least_torque(press: dr.LoadedPress) -> dr.LoadedPress:
    """Return the press of a sweep whose knife needs the least torque, of those that pass."""
    table = press.sweep({"knife.eccentricity": dr.linspace("19 mm", "21 mm", 21)}, outputs=["knife.torque_max"])
    passing = table["status"] == "pass"
    best = table["knife.torque_max"][passing].argmin()
    length = table["knife.eccentricity"][passing][best]
    return press.with_values({"knife.eccentricity": dr.QuantityValue(float(length), "m")})


def main() -> None:
    """Tell what changes."""
    try:
        press = dr.load(HERE.parent / "configs" / "circular_knife.yaml")
    except dr.ConfigError as error:
        for problem in error.problems:
            print(
                f"{problem.file}, line {problem.line}: {problem.path}: {problem.message} (allowed: {problem.allowed})"
            )
        raise SystemExit(2) from None
    results = least_torque(press).calculate()
    knife = assert_type(results["knife"], dr.MechanismResults)
    torque = assert_type(knife.torque_max, dr.QuantityValue)
    print(f"{torque.to('N*mm'):.0f}, {results.status}, governing: {results.governing}")
    assert_type(knife.checks["reach"].utilisation, float | None)
    assert_type(results.report(HERE / "build" / "knife.html", detail="brief"), Path)


if __name__ == "__main__":
    main()
