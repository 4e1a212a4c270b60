"""What a check does not say follows from the quantities that it compares, once, when the mechanism is put together."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from diecut_report.api import (
    Block,
    Chapter,
    Check,
    Inputs,
    Mechanism,
    Quantity,
    abscissa,
    crossings,
    m,
    parts,
    reduction,
    samples,
    value,
)
from diecut_report.cli.main import main
from diecut_report.declaration import faults
from diecut_report.declaration.texts import texts
from diecut_report.text.phrases import small


class Pin(Block):
    diameter = Quantity("d_i", "mm", "Diameter of a pin", gt=0)
    allowed = Quantity("[p]_i", "MPa", "Allowed pressure of a pin", gt=0)


class Press(Inputs):
    force = Quantity("F", "kN", "Force", gt=0)
    pins = parts(Pin, "Pins")
    allowed = Quantity("[p]", "MPa", "Allowed pressure", gt=0, default=20)
    radius = Quantity("r", "mm", "Radius that is given", gt=0, default=10)
    mass = Quantity("m", "kg", "Mass that swings", gt=0, optional=True)
    n_points = samples(36)


pins = Chapter("Pins")
pins.pressure = m.force / m.pins.diameter**2, "p_i", "N/mm**2", "Pressure of a pin", "S1 (6)"
pins.modulus = m.force / m.radius**2, "E", "GPa", "ISO modulus"
pins.factor = m.force / m.force, "K_A", "1", "K factor"
pins.effort = value(m.force * m.radius, units=(("mass", "N"),)), "M", "N*m", "Effort at the crank"
pins.curvature = 2 * m.radius, "ρ", "cm", "Radius of curvature", "geometry"
pins.angle = abscissa(2 * np.pi), "φ", "deg", "Angle"
pins.torque = m.force * m.radius * np.sin(m.angle), "M_φ", "N*m", "Torque over a turn"
pins.torque_max = reduction("max", of="torque"), "M_max", "N*m", "Greatest torque"
pins.zeros = crossings(of="torque"), "φ_0", "deg", "Where the torque changes its sign"
WORDS = {"consequence": "it breaks."}


def made(demand: Any, limit: Any, **options: Any) -> Check:
    check = Check("c", "strength", "C", demand, limit, **{**WORDS, **options})
    return mechanism(check).checks[0]


def mechanism(*checks: Check) -> Mechanism:
    return Mechanism(
        kind="press", version="1", title="Press", summary="A press.", inputs=Press, chapters=(pins,), checks=checks
    )


@pytest.mark.parametrize(
    ("demand", "limit", "unit", "labels", "source"),
    [
        (m.pressure, m.allowed, "N/mm**2", ("pressure of a pin", "allowed"), "S1 (6)"),
        (m.pressure, m.pins.allowed, "N/mm**2", ("pressure of a pin", "allowed"), "S1 (6)"),
        (m.pressure, 12, "N/mm**2", ("pressure of a pin", "accepted"), "S1 (6)"),
        (m.radius, m.curvature, "mm", ("radius that is given", "radius of curvature"), "geometry"),
        (8, m.curvature, "cm", ("at least", "radius of curvature"), "geometry"),
        (8, m.radius, "mm", ("at least", "radius that is given"), ""),
        (m.inputs.radius, m.force, "mm", ("radius that is given", "force"), ""),
        (m.modulus, m.pressure, "GPa", ("ISO modulus", "pressure of a pin"), "S1 (6)"),
        (m.factor, 2, "1", ("K factor", "accepted"), ""),
        (m.torque, m.effort, "N*m", ("torque over a turn", "effort at the crank"), ""),
        (m.zeros_1, 90, "deg", ("where the torque changes its sign", "accepted"), ""),
        (m.pressure[0], m.allowed, "N/mm**2", ("pressure of a pin", "allowed"), "S1 (6)"),
    ],
    ids=repr,
)  # fmt: skip
def test_unit_labels_and_source_follow_from_both_sides(
    demand: Any, limit: Any, unit: str, labels: tuple[str, str], source: str
) -> None:
    found = made(demand, limit)
    assert (found.unit, found.demand_label, found.limit_label, found.source) == (unit, *labels, source)


def test_what_is_said_stands() -> None:
    said = {"unit": "MPa", "demand_label": "p", "limit_label": "most", "source": "S2"}
    found = made(m.pressure, m.allowed, **said)
    assert {name: getattr(found, name) for name in said} == said


def test_a_check_with_an_input_has_the_unit_that_holds_beside_it() -> None:
    assert made(m.effort, 3).unit == "N*m" and made(m.effort, 3, needs=("mass",)).unit == "N"
    assert made(m.effort, 3, only_with=(m.mass,)).unit == "N"


@pytest.mark.parametrize(("demand", "limit"), [(m.torque_max_at, 90), (m.zeros_count, 2)], ids=repr)
def test_of_a_place_and_a_count_unit_and_label_must_be_said(demand: Any, limit: Any) -> None:
    told = [fault.text for fault in faults(mechanism(Check("c", "strength", "C", demand, limit, **WORDS)))]
    head = "and none follows from what it compares; write"
    assert f"has no unit, {head} unit=" in told and f"has no demand_label, {head} demand_label=" in told
    unit = "deg" if "at" in demand.id else "1"
    said = Check("c", "strength", "C", demand, limit, unit=unit, demand_label="place", **WORDS)
    assert not [fault for fault in faults(mechanism(said)) if fault.subject == "check c"]


def test_a_name_that_nothing_gives_is_told_alone() -> None:
    found = [str(fault) for fault in faults(mechanism(Check("c", "strength", "C", m.presure, m.allowed, **WORDS)))]
    [told] = [each for each in found if "check c" in each]
    assert "takes presure, which nothing gives (did you mean 'pressure'?)" in told


def test_a_mechanism_that_is_made_anew_has_the_same_checks() -> None:
    first = mechanism(Check("c", "strength", "C", m.pressure, m.allowed, **WORDS))
    assert replace(first, title="Other").checks == first.checks


def test_what_has_another_shape_is_told_as_that() -> None:
    for wrong in ({"chapters": pins}, {"inputs": Press(force=1, pins=[])}, {"checks": 3}):
        assert faults(replace(mechanism(), **wrong))  # type: ignore[arg-type]


def test_a_label_is_translated_as_its_description_and_needs_no_entry() -> None:
    found = mechanism(Check("c", "strength", "C", m.pressure, 3, **WORDS))
    assert "pressure of a pin" not in [each.text for each in texts(found)]


@pytest.mark.parametrize(
    ("text", "expected"),
    [("Pressure", "pressure"), ("ISO class", "ISO class"), ("K factor", "K factor"), ("η of the pair", "η of the pair"), ("", "")],
)  # fmt: skip
def test_words_begin_with_a_small_letter_but_for_symbols_and_abbreviations(text: str, expected: str) -> None:
    assert small(text) == expected


CONFIG = """
schema_version: 1
project: {title: Press, language: uk}
press: {name: Press}
mechanisms:
  hook: {kind: hook, force: 30 kN}
"""
PLUGIN = """
from diecut_report.api import Chapter, Check, Inputs, Mechanism, Quantity, m


class Hook(Inputs):
    force = Quantity("F", "kN", "Force", gt=0)
    area = Quantity("A", "mm**2", "Area", gt=0, default=100)
    allowed = Quantity("[σ]", "MPa", "Allowed stress", gt=0, default=120)


hook = Chapter("Hook")
hook.stress = m.force / m.area, "σ", "MPa", "Stress of the shank"
CHECKS = (
    Check("stress", "strength", "Stress", m.stress, m.allowed, consequence="it breaks."),
    Check("load", "practice", "Load", m.force, 10, consequence="it breaks."),
    Check("size", "practice", "Size", 200, m.area, consequence="it breaks."),
)
MECHANISM = Mechanism(kind="hook", version="1", title="Hook", summary="A hook.", inputs=Hook, chapters=(hook,), checks=CHECKS)
"""
WORDS_UK = {"Stress of the shank": "Напруження стрижня", "Force": "Сила", "Area": "Площа"}


def test_the_ukrainian_page_has_labels_that_begin_as_the_language_has_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "hook.py").write_text(PLUGIN, encoding="utf-8")
    entries = "".join(f'msgid "{one}"\nmsgstr "{other}"\n\n' for one, other in WORDS_UK.items())
    head = 'msgid ""\nmsgstr ""\n"Language: uk\\n"\n"Content-Type: text/plain; charset=utf-8\\n"\n\n'
    (tmp_path / "hook.uk.po").write_text(head + entries, encoding="utf-8")
    (tmp_path / "press.yaml").write_text(CONFIG, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    assert main(["report", "press.yaml", "-o", ".", "--plugins", ".", "--format", "html"]) == 1
    page = (tmp_path / "press.html").read_text("utf-8")
    for label in ("напруження стрижня", "допустиме", "сила", "прийнятне", "не менше ніж", "площа"):
        assert f'<span class="sub">{label}</span>' in page
    assert "Напруження стрижня 300 MPa, допустиме 120 MPa: it breaks." in page
    assert "Не менше ніж 200 mm², площа 100 mm²: it breaks." in page
