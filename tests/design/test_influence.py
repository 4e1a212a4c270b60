"""The command influence and its chapter of the report: closed forms of a lever, distribution functions, and what is bad input."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.stats import beta, norm

from diecut_report import __version__
from diecut_report.cli.main import main
from diecut_report.config.loader import load_config
from diecut_report.config.plugins import Discovery
from diecut_report.design import influence as design_influence
from diecut_report.design.influence import _ends, by_input, data, lines, tornados, within_tolerances
from diecut_report.design.inputs import DesignInput, free_input, given_numbers, numbers_at_default, numbers_to_vary
from diecut_report.design.machines import proved
from diecut_report.errors import UserError
from diecut_report.press import Press
from diecut_report.report.rendering import Rendering
from diecut_report.results.model import ResultsRecord
from tests.configs import EXAMPLE, GOOD, HEAD, MECHANISMS, saved

Capture = pytest.CaptureFixture[str]
TEXT = HEAD + "  a: {kind: lever, force: 2 kN, arm: 100 mm, teeth: 20, allowable_moment: 210 N*m}\n"


@pytest.fixture
def press(tmp_path: Path) -> Path:
    return saved(tmp_path, TEXT)


def influence(press: Path, *more: object) -> int:
    return main(["influence", str(press), *map(str, more), "--plugins", str(GOOD)])


def found(capfd: Capture) -> dict[str, Any]:
    answer: dict[str, Any] = json.loads(capfd.readouterr().out)
    return answer


def test_each_input_moves_a_product_by_its_share(press: Path, capfd: Capture) -> None:
    assert influence(press, "--of", "a.moment", "--by", "5", "--tolerance", "a.arm=1 mm", "--count", "10") == 0
    out = capfd.readouterr().out.splitlines()
    assert out[:4] == [
        "a.moment, at present 200 N·m",
        "  a.force  1.9 kN … 2.1 kN: 190 N·m … 210 N·m",
        "  a.arm    99 mm … 101 mm: 198 N·m … 202 N·m",
        "  5 have no effect",
    ]


def test_the_governing_checks_are_looked_at_by_themselves(press: Path, capfd: Capture) -> None:
    assert influence(press, "--format", "json") == 0
    (tornado,) = found(capfd)["tornados"]
    assert tornado["name"] == "a.checks.moment.utilisation" and tornado["today"] == pytest.approx(200 / 210)
    bars = {bar["path"]: (bar["low"], bar["high"]) for bar in tornado["bars"]}
    assert bars["mechanisms.a.arm"] == pytest.approx((180 / 210, 220 / 210))
    assert bars["mechanisms.a.allowable_moment"] == pytest.approx((200 / 189, 200 / 231))


def test_what_the_calculation_presumes_is_not_looked_at_by_itself(capfd: Capture) -> None:
    knife = EXAMPLE.with_name("circular_knife.yaml")
    assert main(["influence", str(knife), "--format", "json"]) == 0
    (tornado,) = found(capfd)["tornados"]
    assert tornado["name"] == "knife.checks.reach.utilisation"  # shear_resistance stands at 1 whatever the machine is


@pytest.mark.parametrize(
    ("distribution", "probability"),
    [("uniform", (105 - 80) / (120 - 80)), ("normal", norm.cdf((105 - 100) / (20 / 3)))],
)
def test_the_probability_is_that_of_the_distribution(
    press: Path, capfd: Capture, distribution: str, probability: float
) -> None:
    more = ("--tolerance", "a.arm=20 mm", "--distribution", distribution, "--count", 4000, "--format", "json")
    assert influence(press, *more) == 0
    told = capfd.readouterr().out
    (chance,) = json.loads(told)["tolerances"]["checks"]
    low, high = chance["interval"]
    assert low < probability < high and high - low < 0.04
    held, count = chance["held"], chance["count"]
    # Clopper and Pearson by the beta distribution
    assert (low, high) == pytest.approx(
        (beta.ppf(0.025, held, count - held + 1), beta.ppf(0.975, held + 1, count - held))
    )
    assert influence(press, *more) == 0 and capfd.readouterr().out == told  # the seed is fixed


def test_the_page_in_ukrainian_has_decimal_commas(press: Path, tmp_path: Path) -> None:
    page = tmp_path / "1.html"
    more = ("--tolerance", "a.arm=2.5 mm", "--count", 20, "--language", "uk")
    assert influence(press, "--format", "html", "-o", page, *more) == 0
    text = page.read_text("utf-8").replace(__version__, "")
    shown = re.sub(r"<(style|script)\b.*?</\1>|<[^>]+>", " ", text, flags=re.DOTALL)
    assert not re.search(r"\d\.\d", shown) and re.search(r"\d,\d", shown)


def test_the_page_has_figures_and_no_scripts(press: Path, tmp_path: Path, capfd: Capture) -> None:
    first, second = tmp_path / "1.html", tmp_path / "2.html"
    for page in (first, second):
        assert influence(press, "--format", "html", "-o", page, "--tolerance", "a.arm=2 mm", "--count", 20) == 0
    text = first.read_text()
    assert "<svg" in text and "<script" not in text and "no check fails: 100 %" in text
    assert first.read_bytes() == second.read_bytes()


def test_inputs_at_their_default_are_told_and_changed_on_demand(tmp_path: Path, capfd: Capture) -> None:
    """The lever's arm is 100 mm, and its teeth are 20, where nobody gives them."""
    press = saved(tmp_path, HEAD + "  a: {kind: lever, force: 2 kN}\n")
    assert influence(press, "--of", "a.moment", "--by", "5") == 0
    out = capfd.readouterr().out.splitlines()
    assert out[1].startswith("  a.force ") and not any("a.arm" in line for line in out)
    assert out[-1] == "2 inputs have their default values and are not varied; --defaults includes them"
    assert influence(press, "--of", "a.moment", "--by", "5", "--defaults") == 0
    out = capfd.readouterr().out.splitlines()
    assert "  a.arm    95 mm … 105 mm: 190 N·m … 210 N·m" in out and "--defaults" not in out[-1]


@pytest.mark.parametrize(
    ("name", "share", "ends"),
    [
        ("train.vbelt.efficiency", 0.1, (0.855, 1.0)),  # 0.95, at most 1
        ("train.vbelt.efficiency", 1.0, (0.475, 1.0)),  # more than 0
        ("crankshaft.reliability", 0.01, (0.95, 0.999)),  # 0.99, of a list
        ("bearings.service_factor", 0.1, (1.0, 1.1)),  # at least 1, which it is
        ("gear_key.key_count", 1.0, (1.0, 2.0)),  # 1 or 2
        ("drive.crank_length", 0.1, (0.09, 0.11)),
    ],
)
def test_an_input_is_changed_within_its_own_range(
    press_inputs: dict[str, DesignInput], name: str, share: float, ends: tuple[float, float]
) -> None:
    design = press_inputs[name]
    assert design.present is not None
    assert _ends(design, share * design.present) == pytest.approx(ends)


@pytest.fixture(scope="module")
def press_inputs() -> dict[str, DesignInput]:
    config = load_config(EXAMPLE, Discovery([]))
    return {each.name: each for each in (*given_numbers(config), *numbers_at_default(config))}


def test_inputs_whose_change_makes_no_machine_stand_at_the_end(capfd: Capture) -> None:
    assert main(["influence", str(MECHANISMS), "--of", "drive.stroke", "--by", "40", "--quiet"]) == 0
    head, mover, still, told, *impossible, _ = capfd.readouterr().out.splitlines()
    assert "drive.stroke" in head and re.match("  cylinder.radius .*: cannot exist … 9", mover) and "no effect" in still
    assert told == "changed one way or both, no machine exists:" and impossible[0].startswith(
        "  cylinder.segment_height ("
    )
    assert any(re.fullmatch(r"  cylinder\.density \(mechanisms\.cylinder\.density: .+\)", line) for line in impossible)


def test_each_input_without_a_machine_has_its_own_reason_not_that_of_one_that_moves(capfd: Capture) -> None:
    assert main(["influence", str(MECHANISMS), "--of", "cylinder.checks.radius", "--by", "40", "--quiet"]) == 0
    _, _, told = capfd.readouterr().out.partition("no machine exists:\n")
    assert told.startswith("  cylinder.density (mechanisms.cylinder.density: gives density = ")
    assert "\n  cylinder.elastic_modulus (mechanisms.cylinder.elastic_modulus.value: gives elastic_modulus = " in told


# A machine of parts.


KEY, SEAT, WIDTH = "shafts.rocker.parts.arm.key", "shafts.rocker.sections.1.diameter", "meshes.main_drive.width"


@pytest.fixture(scope="module")
def machine() -> Press:
    return Press.read(EXAMPLE.parent / "machines" / "flat_cylinder.yaml", Discovery([]))


def test_what_is_typed_at_parts_or_they_are_made_with_is_varied_once_by_its_name_there(machine: Press) -> None:
    config = machine.config
    assert config.parts is not None
    names = [each.name for each in numbers_to_vary(config)]
    typed = {KEY, SEAT, WIDTH, "belts.motor.diameter_2", "machine.frame.main.0", "chains.grippers.pretension"}
    assert typed | {"drive.crank_length", "press.sheet.length"} <= {*names} and len(names) == len({*names})
    assert not [each.name for each in numbers_to_vary(config) if config.parts.follows(each.asked.node)]


def test_the_effect_of_a_part_is_that_of_the_file_with_its_value(
    machine: Press, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Without the others of the machine, which take minutes."""
    own = [each for each in numbers_to_vary(machine.config) if each.name in (KEY, SEAT, WIDTH)]
    monkeypatch.setattr(design_influence, "numbers_to_vary", lambda config: own)
    check = "shafts_rocker_arm_key.checks.pressure_key"
    (found,) = tornados(machine.config, [check], 0.1, {})
    bars = {bar.design.name: bar for bar in (*found.bars, *found.impossible)}
    assert [bar.design.name for bar in found.bars] == [KEY, SEAT]
    typed = (
        {("shafts", "rocker", "parts", 2, "key"): "45 mm"},
        {("shafts", "rocker", "sections", 1, "diameter"): "66 mm"},
    )
    alone = [proved(machine.with_values(each)).run.checks["shafts_rocker_arm_key"] for each in typed]
    wanted = [next(each.utilisation for each in checks if each.id == "pressure_key") for checks in alone]
    assert [bars[KEY].low, bars[SEAT].high] == pytest.approx(wanted, rel=1e-9)
    assert np.isnan(bars[KEY].high)  # no key of 55 mm is made
    (told,) = [line for line in map(str, lines([found], None)) if WIDTH in line]
    assert "but the hub of flywheel.pinion is 50 mm long" in told
    reasons = [bar["reason"] for bar in data([found])["tornados"][0]["bars"] if bar["path"] == WIDTH]
    assert reasons and reasons[0] in told


def test_a_part_scatters_within_its_tolerance(machine: Press) -> None:
    """Its gear is cut wider than the hub in half of the machines, which are none."""
    scatter = by_input([(free_input(machine.config, WIDTH), 1e-3)])
    found = within_tolerances(machine.config, scatter, "uniform", 10, 1)
    assert found.inputs[0].name == WIDTH and sum(each.count for each in found.checks) > 0
    with pytest.raises(UserError, match="is a text"):
        free_input(machine.config, "machine.shaft_material")
    with pytest.raises(UserError, match=r"vary meshes\.main_drive\.width in its place"):
        free_input(machine.config, "meshes_main_drive.face_width")


# The chapter of the report.


ASKED = "{of: [a.moment], by: 5 %, tolerances: {a.arm: 20 mm}, count: 1000, seed: 2}"
LEVER = "  a: {kind: lever, force: 2 kN, arm: 100 mm, allowable_moment: 210 N*m}\n"


def config(asked: str, language: str = "en") -> str:
    head = HEAD.replace("{title: Test}", f"{{title: Test, language: {language}}}\nreport: {{influence: {asked}}}")
    return head + LEVER


def report(folder: Path, text: str, formats: str = "html,json") -> int:
    return main(["report", str(saved(folder, text)), "-o", str(folder), "--format", formats, "--plugins", str(GOOD)])


def test_the_report_holds_the_chapter_and_can_be_verified(tmp_path: Path, capfd: Capture) -> None:
    assert report(tmp_path, config(ASKED)) == 0
    found = json.loads((tmp_path / "press.json").read_text("utf-8"))["influence"]
    (tornado,) = found["tornados"]
    bars = {bar["name"]: (bar["lowered"], bar["low"], bar["raised"], bar["high"]) for bar in tornado["bars"]}
    assert bars["a.force"] == pytest.approx((1.9, 190, 2.1, 210)) and bars["a.arm"] == pytest.approx(
        (80, 160, 120, 240)
    )
    (check,) = found["tolerances"]["checks"]
    # the moment is linear in the arm: 2 kN by at most 105 mm, of a normal distribution about 100 mm with a deviation of 20/3 mm
    assert check["low"] < norm.cdf((105 - 100) / (20 / 3)) < check["high"]
    page = (tmp_path / "press.html").read_text("utf-8")
    assert "Influence of inputs" in page and "Lever · Moment" in page and 'id="fig-1.1"' in page
    capfd.readouterr()
    assert main(["verify", str(tmp_path / "press.html"), "--numbers", "--plugins", str(GOOD)]) == 0


def test_all_formats_hold_it_and_equal_results_give_equal_bytes(tmp_path: Path) -> None:
    assert report(tmp_path, config(ASKED), "json") == 0
    results = ResultsRecord.model_validate_json((tmp_path / "press.json").read_bytes())
    results = results.with_(project=results.project.with_(language="uk"))
    pages, words = ([Rendering(results).html() for _ in range(2)], [Rendering(results).docx() for _ in range(2)])
    assert pages[0] == pages[1] and "Вплив вхідних даних" in pages[0] and "Імовірність виконання" in pages[0]
    assert words[0] == words[1] and len(Rendering(results.with_(influence=None)).docx()) < len(words[0])


def test_without_names_the_governing_checks_are_looked_at(tmp_path: Path) -> None:
    assert report(tmp_path, config("{}"), "json") == 0
    found = json.loads((tmp_path / "press.json").read_text("utf-8"))["influence"]
    assert [each["name"] for each in found["tornados"]] == ["a.checks.moment.utilisation"] and "tolerances" not in found


@pytest.mark.parametrize(
    ("asked", "words"),
    [
        (
            "{tolerances: {a.n_points: 1}}",
            "press.yaml:3:35: report.influence.tolerances.a.n_points: a.n_points only sets how densely",
        ),
        ("{of: [a.momemt]}", "press.yaml:3:27: report.influence.of.0: a.momemt is neither a number that a gives"),
        ("{tolerances: {a.arn: 1 mm}}", "report.influence.tolerances.a.arn: a.arn 'arn' is not an input of a"),
        ("{tolerances: {a.arm: 1 kg}}", "report.influence.tolerances.a.arm: 1 kg is a mass"),
        ("{tolerances: {a.arm: -1 mm}}", "report.influence.tolerances.a.arm: a.arm: -1 mm is not above zero"),
        (
            "{tolerances: {a.arm: 1 mm, mechanisms.a.arm: 2 mm}}",
            "report.influence.tolerances: a.arm is given more than one tolerance",
        ),
        ("{tolerances: [1 mm]}", "report.influence.tolerances: must be written as keys and sizes"),
        ("{by: 0}", "report.influence.by: 0"),
        ("{share: 1}", "report.influence.share: is an unknown key"),
        ("{distribution: cauchy}", "report.influence.distribution"),
    ],
)
def test_what_is_wrong_is_told_with_its_place(tmp_path: Path, capfd: Capture, asked: str, words: str) -> None:
    assert report(tmp_path, config(asked)) == 2
    _, err = capfd.readouterr()
    assert words in err and list(tmp_path.iterdir()) == [tmp_path / "press.yaml"]


def test_validate_tells_all_that_is_wrong_with_it_at_once(tmp_path: Path, capfd: Capture) -> None:
    file = saved(tmp_path, config("{of: [a.moment, a.momemt, b.moment], tolerances: {a.arn: 1 mm, a.arm: 1 kg}}"))
    assert main(["validate", str(file), "--plugins", str(GOOD)]) == 2
    _, err = capfd.readouterr()
    assert [line.split(" ")[1] for line in err.splitlines()] == [
        f"report.influence.{key}:" for key in ("of.1", "of.2", "tolerances.a.arn", "tolerances.a.arm")
    ]
    assert err.splitlines()[0].startswith(f"{file}:3:37: ") and "did you mean 'moment'?" in err
    assert f"{file}:3:71: report.influence.tolerances.a.arn" in err and "did you mean 'arm'?" in err
    file.write_text(config(ASKED), encoding="utf-8")
    assert main(["validate", str(file), "--plugins", str(GOOD)]) == 0


def test_the_schema_knows_it(capfd: Capture) -> None:
    assert main(["schema"]) == 0
    report_block = json.loads(capfd.readouterr().out)["properties"]["report"]["properties"]["influence"]
    assert {"of", "by", "tolerances", "distribution", "count", "seed"} <= set(json.dumps(report_block).split('"'))


@pytest.mark.parametrize(("asked", "told"), [("{}", True), ("{defaults: true}", False)])
def test_the_chapter_tells_of_inputs_at_their_default(tmp_path: Path, asked: str, told: bool) -> None:
    assert report(tmp_path, config(asked, "uk")) == 0
    template = "вхідна величина має типове значення і не змінюється; report.influence.defaults змінює і її."
    assert (template in (tmp_path / "press.html").read_text("utf-8")) == told
