"""What holds for every kind, those of the comparisons too: its declaration is sound, many machines at once are each machine
alone, each quantity has a symbol of its own, and its report can be set.

CI takes the machines that have all that the examples leave out, of the laws of motion the one with most joints: what a law
changes is in no formula of a plugin. Sixteen machines at once go the way of hundreds: they are compiled from eight on.
A comparison is the same between the mechanisms of one press as of another. The examples' machines, a few of which
tests/study/test_chain.py holds against each machine alone, are tried at night.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import Any

import numpy as np
import pytest

from diecut_report.contract.inputs import Quantity
from diecut_report.contract.mechanism import Mechanism
from diecut_report.contract.result_names import named
from diecut_report.contract.steps import Crossings
from diecut_report.engine import Calculation, Impossible, Unproven, calculate
from diecut_report.mechanics.motion_laws import LAWS
from diecut_report.results.checks import applies, judged
from diecut_report.results.mechanism import mechanism_results
from diecut_report.testing import check_mechanism
from tests.examples import few
from tests.plugins.cases import COMPARISONS, FULL, MECHANISMS, Case, case, names
from tests.plugins.symbols import doubled

COUNT, ALONE, MANY = 16, 3, 300  # machines at once, those of them calculated alone too, and all of a nightly run
REFUSED = 48  # machines at once among which some cannot exist
RARE = {("gear_pair", "at distance"): REFUSED}  # machines of which few are possible
ALIKE = {  # quantities that a step takes over under another id
    "cylinder_sizing": [("wall_at_flat", "wall_verdict")],
    "damper": [("drive.force", "driving_force")],
    "drive_train": [("torque_curve", "output_torque")],
    "press_consistency": [
        ("cylinder_rotation", "rotation"),
        ("cylinder_speed", "speed"),
        ("output_turns_per_sheet", "turns_a_sheet"),
        ("engagement_angle", "start_angle"),
    ],
    "roller_chain": [
        ("application_factor", "application"),
        ("center_distance", "center"),
        ("teeth_2", "driven_teeth"),
        *((f"{name}_curve", f"{name}_over") for name in ("torque", "velocity", "acceleration")),
    ],
    "gear_pair": [("torque_curve", "torque_given")],
    "parallel_key": [("torque_curve", "torque_over_cycle")],
    "transport_comparison": [("gear_speed", "cam_gear_speed"), ("gear_acceleration", "cam_gear_acceleration")],
}
NEVER_REFUSED = {"damper", "elastic_follower"}
OF_ONE_PRESS = {"cyclogram"}  # takes other mechanisms whole, one machine at a time: tried in a module of its own
SMALLEST = "flat_cylinder_mechanisms-"  # of the examples with mechanisms that are compared
each_mechanism = pytest.mark.parametrize("mechanism", MECHANISMS.values(), ids=MECHANISMS)
CASES = [(kind, name) for kind in MECHANISMS if kind not in OF_ONE_PRESS for name in names(kind)]
AT_NIGHT = {  # beside others that have more
    ("cylinder_drive", "published"), ("cylinder_sizing", "sized"), ("elastic_follower", "slide"), ("shaft", "sized"), ("shaft", "own steel"),
    *(("cam_gear_transport", law) for law in LAWS if law != "modified_trapezoidal"),
}  # fmt: skip


def is_main(kind: str, name: str) -> bool:
    """Whether a machine is tried at each change, not only at night."""
    if kind in COMPARISONS:
        return name == (SMALLEST if SMALLEST in names(kind) else names(kind)[0])
    return name in FULL[kind] and (kind, name) not in AT_NIGHT


each_case = pytest.mark.parametrize(("kind", "name"), CASES)
main_cases = pytest.mark.parametrize(("kind", "name"), few(CASES, keep=lambda one: is_main(*one)))


@each_mechanism
def test_the_declaration_keeps_the_plugin_contract(mechanism: Mechanism) -> None:
    check_mechanism(mechanism)


@each_mechanism
def test_each_quantity_has_a_symbol_of_its_own(mechanism: Mechanism) -> None:
    assert [line for line in doubled(mechanism, ALIKE.get(mechanism.kind, ())) if not line.startswith("→")] == []


# --- many machines at once -------------------------------------------------------------------------------------------


@main_cases
def test_many_machines_at_once_are_each_machine_alone(kind: str, name: str) -> None:
    compare(case(kind, name), RARE.get((kind, name), COUNT), ALONE, seed=3)


@pytest.mark.nightly
@pytest.mark.parametrize("seed", range(3))
@each_case
def test_very_many_machines_at_once_are_each_machine_alone(kind: str, name: str, seed: int) -> None:
    compare(case(kind, name), MANY, MANY, seed)


def test_in_all_kinds_that_refuse_machines_some_of_those_that_vary_are_refused() -> None:
    mains = {kind: [name for name in names(kind) if is_main(kind, name)] for kind in set(FULL) - NEVER_REFUSED}
    refusing = {kind for kind, some in mains.items() if any(refuses_some(kind, name) for name in some)}
    assert refusing == mains.keys()


@pytest.mark.nightly
def test_the_other_kinds_refuse_none() -> None:
    assert not any(refuses_some(kind, name) for kind in NEVER_REFUSED for name in names(kind) if is_main(kind, name))


def refuses_some(kind: str, name: str) -> bool:
    """Whether some of many machines are."""
    return bool(case(kind, name).together(REFUSED, seed=3)[1].flaws)


def compare(machine: Case, count: int, alone: int, seed: int) -> None:
    """Calculate machines together, and some of them alone, impossible ones too: the same numbers, curves, verdicts, reasons."""
    varied, together = machine.together(count, seed)
    impossible, possible = sorted(together.flaws), [i for i in range(count) if i not in together.flaws]
    assert possible
    few = impossible[: max(alone // 3, alone - len(possible))]
    for i in [*few, *possible[: alone - len(few)]]:
        try:
            single = calculate(machine.mechanism, {**machine.values, **each(varied, i)})
        except Impossible as refused:
            assert together.flaws[i] in refused.reasons
        except Unproven as refused:
            assert together.flaws[i][1] == str(refused)
        else:
            assert i not in together.flaws, together.flaws[i]
            same_numbers(together, single, i)
            same_curves(together, single, i)
            same_verdicts(together, single, i)


def each(varied: Mapping[str, Any], i: int) -> dict[str, Any]:
    """The inputs of one of many machines."""
    return {name: tuple(float(part[i]) for part in value) if isinstance(value, tuple) else float(value[i])
            for name, value in varied.items()}  # fmt: skip


def same_numbers(together: Calculation, alone: Calculation, i: int) -> None:
    """Hold all numbers, rows, texts and places of one among many against the same machine alone."""
    scale = scales(alone)
    for name, values in together.values.items():
        found, expected = values[i], alone.values[name][0] if name in alone.values else np.array([np.nan])
        if values.dtype == object:
            assert list(found) == list(expected), name
            continue
        length = min(len(found), len(expected))  # a list of crossings is as long as the machine that has most
        assert not np.isfinite(found[length:]).any(), name
        within = 1e-5 if is_place(together, name) else 1e-11 * scale.get(unit_of(together, name), 0.0)
        np.testing.assert_allclose(found[:length], expected[:length], rtol=1e-9, atol=within, err_msg=name)
    assert alone.values.keys() <= together.values.keys()


def unit_of(calc: Calculation, name: str) -> str:
    """The unit of a number; none for how many crossings there are."""
    return "1" if name.endswith("_count") and name not in calc.steps else calc.step_or_input(name).unit


def scales(calc: Calculation) -> dict[str, float]:
    """The greatest number in each unit: a difference of such numbers is no more exact than they are."""
    found: dict[str, float] = {}
    numbers = {
        name: values
        for name, values in calc.inputs.items()
        if isinstance(calc.meta.get(name), Quantity) and isinstance(values, np.ndarray)
    }
    for name, values in (numbers | calc.values | {name: calc.curve_samples(name) for name in calc.curves}).items():
        if values.dtype != object and np.isfinite(values).any():
            unit = unit_of(calc, name)
            found[unit] = max(found.get(unit, 0.0), float(np.nanmax(np.abs(values))))
    return found


def is_place(calc: Calculation, name: str) -> bool:
    """Whether a number is a place that was found by search."""
    found = named(name, calc.steps)
    is_found = found is not None and found.role in ("place", "crossing")
    return is_found or isinstance(calc.steps.get(name), Crossings)


def same_curves(together: Calculation, alone: Calculation, i: int) -> None:
    """Hold the samples of all curves against the machine's own."""
    for name in alone.curves:
        found, expected = together.curve_samples(name)[i], alone.curve_samples(name)[0]
        great = float(np.max(np.abs(expected), initial=0.0))
        np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-9 * great, err_msg=name)


def same_verdicts(together: Calculation, alone: Calculation, i: int) -> None:
    """Hold each check against the machine's own, with its utilisation."""
    for check in filter(partial(applies, alone), together.mechanism.checks):
        found, own = judged(together, check), judged(alone, check)
        np.testing.assert_array_equal(found.held[i], own.held[0], err_msg=check.id)
        np.testing.assert_allclose(found.ratio[i], own.ratio[0], rtol=1e-7, atol=1e-6, err_msg=check.id)


# --- report ----------------------------------------------------------------------------------------------------------


@main_cases
def test_all_that_a_report_prints_is_made_of_a_machine(kind: str, name: str) -> None:
    machine = case(kind, name)
    results = mechanism_results(calculate(machine.mechanism, machine.values), {})
    assert results["status"] in ("pass", "warn", "fail")
    assert results["sections"] and results["figures"]


@each_mechanism
def test_each_kind_has_an_example_and_a_machine_with_what_the_examples_leave_out(mechanism: Mechanism) -> None:
    assert any("-" in name for name in names(mechanism.kind)) or mechanism.kind in OF_ONE_PRESS
    assert mechanism.kind in {*COMPARISONS, *OF_ONE_PRESS} or FULL[mechanism.kind]
