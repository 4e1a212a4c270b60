"""What holds for every kind, those of the comparisons too: its declaration is sound, many machines at once are each machine
alone, each quantity has a symbol of its own, and its report can be set.

CI takes the machines that have all that the examples leave out, of the laws of motion the one with most joints: what a law
changes is in no formula of a plugin. Sixteen machines at once go the way of hundreds: they are compiled from eight on.
A comparison is the same between the mechanisms of one press as of another. The examples' machines, a few of which
tests/study/test_chain.py holds against each machine alone, are tried at night.
"""

from __future__ import annotations

import pytest

from diecut_report.declaration.formula_checks import check_mechanism
from diecut_report.machine.steps.run import calculate
from diecut_report.mechanics.motion_laws import LAWS
from diecut_report.mechanism.mechanism import Mechanism
from diecut_report.results.figure_views import shown_figures
from diecut_report.results.mechanism import mechanism_results
from diecut_report.testing.machines import unlike
from tests.examples import few
from tests.plugins.cases import COMPARISONS, FULL, MECHANISMS, Case, case, names
from tests.plugins.machine_parts import OF_PARTS
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
NEVER_REFUSED = {"damper", "drive_line", "elastic_follower", "machine_inertia", "shaft_loads"}
OF_ONE_PRESS = {"cyclogram"}  # takes other mechanisms whole, one machine at a time: tried in a module of its own
SMALLEST = "flat_cylinder_mechanisms-"  # of the examples with mechanisms that are compared
each_mechanism = pytest.mark.parametrize("mechanism", MECHANISMS.values(), ids=MECHANISMS)
UNDRAWN = {
    ("press_consistency", "flat_cylinder_belt_press-press_consistency"),  # a press without a crank, whose inertia is the one diagram
    ("drive_line", "line"), ("machine_inertia", "moving"), ("shaft_body", "bored"),  # sums of a few parts, in tables
    ("shaft_loads", "stepped"), ("shaft_loads", "swinging"),  # the shaft, the gears and the keys that take them draw them
}  # fmt: skip
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


@each_mechanism
def test_what_is_absent_is_said_in_the_words_of_the_heading_above_it(mechanism: Mechanism) -> None:
    """The report leaves out "not calculated: " under that heading, which has the part's name beside it."""
    told = [chapter.absent for chapter in mechanism.chapters if chapter.absent]
    assert [text for text in told if " not calculated" in text or " not rated" in text] == []


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
    assert len(machine.together(count, seed)[1].flaws) < count
    assert list(unlike(machine, count, alone, seed)) == []


# --- report ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("kind", "name"), few(CASES, keep=lambda one: is_main(*one) and CASES.index(one) % 2 == 0))
def test_all_that_a_report_prints_is_made_of_a_machine(kind: str, name: str) -> None:
    machine = case(kind, name)
    calc = calculate(machine.mechanism, machine.values)
    results = mechanism_results(calc, {})
    assert results.status in ("pass", "warn", "fail")
    assert not any(figure.error for figure in results.figures)
    assert results.figures or (kind, name) in UNDRAWN
    assert results.sections and [figure.id for figure in results.figures] == [
        figure.id for figure in shown_figures(calc)
    ]


@each_mechanism
def test_each_kind_has_an_example_and_a_machine_with_what_the_examples_leave_out(mechanism: Mechanism) -> None:
    assert any("-" in name for name in names(mechanism.kind)) or mechanism.kind in OF_ONE_PRESS | OF_PARTS
    assert mechanism.kind in {*COMPARISONS, *OF_ONE_PRESS} or FULL[mechanism.kind]
