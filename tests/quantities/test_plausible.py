"""Plausible sizes: what no machine has is refused in words, whoever gives it; what a machine has is not."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from diecut_report.api import CurveInput, Quantity
from diecut_report.config.loader import load_config
from diecut_report.config.plugins import Discovery
from diecut_report.errors import UserError
from diecut_report.mechanism.inputs import fields
from diecut_report.mechanism.names import SI
from diecut_report.quantities.plausible import SIZES, Plausible, plausible, without_rounding
from diecut_report.quantities.units import UnitError, unit
from diecut_report.results.press_run import compute
from diecut_report.study.definition.study_file import load_study
from diecut_report.study.execution.study_run import Where, run_study
from tests.configs import DISCOVERY, HEAD, problems, saved
from tests.plugins.cases import COMPARISONS, OF_KINDS
from tests.study.stored_study import variants

LENGTH = Quantity("l", "mm", "Length")
SHARE = Quantity("s", "1", "Share", ge=0, plausible=("0.01", "50"))


@pytest.mark.parametrize("text", SIZES)
def test_each_line_of_the_table_is_a_range_of_its_kind(text: str) -> None:
    own = Plausible(*SIZES[text])
    assert own.kind == unit(text).kind and 0 < own.ends[0] < own.ends[1] and plausible(text).ends == own.ends


def test_the_table_is_read_without_pint() -> None:
    code = (
        "import sys; from diecut_report.quantities import plausible as p; "
        "[p.Plausible(*ends).ends for ends in p.SIZES.values()]; print('pint' in sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "False\n"


def test_the_page_tells_each_line() -> None:
    page = (Path(__file__).parents[2] / "docs" / "limits.md").read_text("utf-8")
    for ends in SIZES.values():
        assert f"| {Plausible(*ends).told} |" in page


def test_every_quantity_of_every_kind_has_a_line_in_the_table() -> None:
    known = {unit(text).kind for text in SIZES}
    for mechanism in (*OF_KINDS.values(), *COMPARISONS.values()):
        for name, meta in fields(mechanism.inputs):
            units = [meta.unit, *(other for _, other in meta.units)] if isinstance(meta, Quantity | CurveInput) else []
            assert {unit(each).kind for each in units} <= known, f"{mechanism.kind}.{name}"


@pytest.mark.parametrize("given", ["1 um", "-1 um", "100 m", 0, "-0.0 mm", "1e5 mm", "0.001 mm", 1e5, 0.001])
def test_both_ends_and_zero_are_plausible(given: float | str) -> None:
    assert str(LENGTH.validate(given)) != "-0.0"


@pytest.mark.parametrize("given", [1e-300, "1e-300 mm", "0.999 um", "-0.999 um", "100.1 m", "-1e300 m", 1e12])
def test_what_is_not_plausible_is_told_with_what_is(given: float | str) -> None:
    with pytest.raises(ValueError, match=r"^.*m is not plausible; plausible: 1 µm to 100 m, or 0"):
        LENGTH.validate(given)


def test_zero_is_named_only_where_the_bounds_allow_it() -> None:
    with pytest.raises(ValueError, match=r"plausible: 1 µm to 100 m(?!, or 0)"):
        Quantity("l", "mm", "Length", gt=0).validate("200 m")


def test_a_key_may_declare_sizes_of_its_own() -> None:
    assert SHARE.validate("0.01") == 0.01 and SHARE.validate(50) == 50
    with pytest.raises(ValueError, match=r"51 is not plausible; plausible: 0.01 to 50, or 0"):
        SHARE.validate(51)


def test_the_sizes_of_a_key_hold_for_their_kind_of_quantity_alone() -> None:
    turned = Quantity("h", "m", "Rise", plausible=("1 deg", "90 deg"))
    assert turned.validate("3 m") == 3


@pytest.mark.parametrize("given", ["1e300 %", -1e300, 12.0])
def test_what_is_beyond_all_sizes_is_no_number_of_a_list(given: float | str) -> None:
    with pytest.raises(ValueError, match="out of range; allowed: 50, 90 %"):
        Quantity("R", "%", "Reliability", listed=(50, 90)).validate(given)


def test_columns_are_judged_as_single_values_are() -> None:
    values = np.array([0, 1e-6, 9e-7, -9e-7, 100, 101, np.inf, np.nan, 1e-6 * (1 - 1e-16), 0.1 + 0.2])
    assert LENGTH.holds(values).tolist() == [True, True, False, False, True, False, False, False, True, True]


@pytest.mark.parametrize("ends", [("1 mm", "1 kg"), ("0 mm", "1 m"), ("2 m", "1 m"), ("-1 m", "1 m"), ("one", "2 m")])
def test_ends_that_are_no_range_are_refused(ends: tuple[str, str]) -> None:
    with pytest.raises(UnitError):
        _ = Plausible(*ends).kind, Plausible(*ends).ends


def test_a_kind_without_a_line_has_a_wide_range() -> None:
    assert plausible("A*m**5").ends == (1e-12, 1e12)


def test_a_typed_value_is_told_with_line_and_key(tmp_path: Path) -> None:
    assert problems(tmp_path, HEAD + "  a: {kind: lever, force: 1e-300 kN}\n") == [
        "5:27: mechanisms.a.force: 1e-300 kN is not plausible; plausible: 1 mN to 100 MN"
    ]


def test_the_press_is_judged_too(tmp_path: Path) -> None:
    text = HEAD.replace("6000 1/h", "1e300 1/h") + "  a: {kind: lever, force: 2 kN}\n"
    (told,) = problems(tmp_path, text)
    assert told.startswith("3:") and "press.productivity: 1e300 1/h is not plausible; plausible: 0.001 1/h" in told


def test_a_value_of_a_curve_is_judged(tmp_path: Path) -> None:
    (told,) = problems(tmp_path, HEAD + "  a: {kind: lever, force: 2 kN, load: [1, 2, 0, 1e-300, 4]}\n")
    assert (
        "mechanisms.a.load: holds 1e-300 N·m, which is not plausible; plausible: 1e-06 N·m to 1000 MN·m, or 0" in told
    )


def test_a_value_that_is_referred_to_is_judged_when_it_is_known(tmp_path: Path) -> None:
    text = HEAD + (
        "  a: {kind: lever, force: 100 MN, arm: 1000 mm}\n"
        "  b: {kind: lever, force: 2 kN, load: ['${a.moment}', '${a.moment}', '${a.moment}', '${a.moment}']}\n"
    )  # fmt: skip
    compute(load_config(saved(tmp_path, text), DISCOVERY), lambda _: None)
    quantity = Quantity("M", "N*m", "Moment", gt=0)
    with pytest.raises(
        ValueError, match=r"2e\+09 N·m \(from a.moment\) is not plausible; plausible: 1e-06 N·m to 1000 MN·m$"
    ):
        quantity.validate(SI(2e9, "N*m", "a.moment"))


COMPARED = HEAD + (
    "  cam: {kind: cam_gear_transport, dwell_angle: 160 deg, sector_dwell_sweep: 60 deg, sector_stop_sweep: 20 deg,"
    " center_distance: 300 mm}\n"
    "  geneva: {kind: geneva_transport, slots: 6, center_distance: 200 mm, roller_radius: 10 mm}\n"
)


@pytest.mark.parametrize(
    ("key", "line", "path"), [("crank_speed", "6:3", "mechanisms.geneva"), ("slots", "6:43", "mechanisms.geneva.slots")]
)
def test_what_a_comparison_cannot_take_is_told_with_line_and_key(
    key: str, line: str, path: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    quantity = dict(fields(COMPARISONS["transport_comparison"].inputs))[key]
    monkeypatch.setitem(
        quantity.__dict__, "sizes", Plausible(*(f"{n} {quantity.unit}".removesuffix(" 1") for n in ("0.001", "2")))
    )
    config = load_config(saved(tmp_path, COMPARED), DISCOVERY)
    with pytest.raises(UserError) as refused:
        compute(config, lambda _: None)
    (told,) = map(str, refused.value.problems)
    assert f"press.yaml:{line}: {path}: The comparison transport_comparison-cam-geneva takes geneva.{key}: " in told
    assert "plausible: 0.001 " in told


BALANCE = """\
from diecut_report.api import Chapter, Inputs, Mechanism, Quantity, m

class Balance(Inputs):
    up = Quantity("M_1", "N*m", "Moment up")
    down = Quantity("M_2", "N*m", "Moment down", gt=0)

chapter = Chapter("Balance")
chapter.rest = m.up - 3 * m.down, "M_r", "N*m", "Rest"
MECHANISM = Mechanism(kind="balance", version="1", title="Balance", summary="Moments.", inputs=Balance, chapters=(chapter,))
"""
BALANCED = HEAD + "  a: {kind: balance, up: 0.3 N*m, down: 0.1 N*m}\n"
STUDY = """\
schema_version: 1
base: press.yaml
sample: {method: grid}
vary: {mechanisms.a.up: [0.3 N*m, 0.5 N*m]}
"""


@pytest.fixture
def balance(tmp_path: Path) -> Discovery:
    """A kind of which the result is zero but for rounding: 0.3 − 3 × 0.1."""
    (tmp_path / "plugins").mkdir()
    saved(tmp_path / "plugins", BALANCE, "balance.py")
    return Discovery([tmp_path / "plugins"])


def test_a_result_that_is_zero_but_for_rounding_is_taken_as_zero(balance: Discovery, tmp_path: Path) -> None:
    text = BALANCED + "  b: {kind: balance, up: '${a.rest}', down: 0.1 N*m}\n"
    run = compute(load_config(saved(tmp_path, text), balance), lambda _: None)
    assert 0 < abs(run.calculations["a"].values["rest"][0, 0]) < 1e-15
    assert run.blocks["b"].model_dump()["up"] == 0


def test_so_it_is_in_a_study(balance: Discovery, tmp_path: Path) -> None:
    saved(tmp_path, BALANCED + "  b: {kind: balance, up: '${a.rest}', down: 0.1 N*m}\n")
    study = load_study(saved(tmp_path, STUDY, "study.yaml"), balance)
    where = Where(jobs=1, plugins=(str(tmp_path / "plugins"),))
    run_study(study, tmp_path / "out", where, resume=False, tell=lambda _: None)
    rows = json.loads("".join(variants(tmp_path / "out", format="json")))["variants"]
    np.testing.assert_allclose([row["b.rest"] for row in rows], [-0.3, -0.1], rtol=1e-12)


@pytest.mark.parametrize("is_study", [False, True])
def test_a_result_that_is_smaller_than_anybody_types_it_is_taken(
    is_study: bool, balance: Discovery, tmp_path: Path
) -> None:
    text = BALANCED.replace("0.3 N", "0.30000005 N") + "  b: {kind: balance, up: '${a.rest}', down: 0.1 N*m}\n"
    config = load_config(saved(tmp_path, text), balance)
    if not is_study:
        assert compute(config, lambda _: None).blocks["b"].model_dump()["up"] == pytest.approx(5e-8, rel=1e-6)
        return
    study = load_study(saved(tmp_path, STUDY.replace("0.3 N", "0.30000005 N"), "study.yaml"), balance)
    where = Where(jobs=1, plugins=(str(tmp_path / "plugins"),))
    run_study(study, tmp_path / "out", where, resume=False, tell=lambda _: None)
    rows = json.loads("".join(variants(tmp_path / "out", format="json")))["variants"]
    np.testing.assert_allclose([row["b.rest"] for row in rows], [5e-8 - 0.3, -0.1], rtol=1e-9)


def test_zero_but_for_rounding_is_refused_as_zero_is(balance: Discovery, tmp_path: Path) -> None:
    text = BALANCED + "  b: {kind: balance, up: 1 N*m, down: '${a.rest}'}\n"
    with pytest.raises(UserError, match=r"mechanisms.b.down: 0 N·m \(from a.rest\) is out of range; allowed: > 0 N·m"):
        compute(load_config(saved(tmp_path, text), balance), lambda _: None)


def test_what_is_typed_is_meant(balance: Discovery, tmp_path: Path) -> None:
    told = problems(tmp_path, HEAD + "  a: {kind: balance, up: 5e-17 N*m, down: 0.1 N*m}\n", balance)
    assert told == ["5:26: mechanisms.a.up: 5e-17 N*m is not plausible; plausible: 1e-06 N·m to 1000 MN·m, or 0"]


def test_a_result_of_a_small_size_stays_what_it_is() -> None:
    least = plausible("N*m").ends[0]
    given = np.array([1.0, -least, 0.002 * least, -1e-9 * least, 0.0, np.nan])
    np.testing.assert_array_equal(without_rounding(given, "N*m"), [1.0, -least, 0.002 * least, 0.0, 0.0, np.nan])
