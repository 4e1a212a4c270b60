"""A draft of any kinds can be read and calculated; its mechanisms are wired to each other, and each key is explained."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

from diecut_report.cli.main import main
from diecut_report.config import yaml as yaml_tree
from diecut_report.config.drafting import Draft, draft
from diecut_report.config.loader import load_config
from diecut_report.config.plugins import Discovery, catalogues_for
from diecut_report.errors import PluginError
from diecut_report.press import Press
from diecut_report.results.model import ResultsRecord
from diecut_report.text.translation import speaking
from tests.configs import DISCOVERY, GOOD
from tests.examples import examples, few

KINDS = [kind for kind, origins in Discovery().origins.items() if origins[0].is_own]
OFF = re.compile(
    r"^    # (\w+: (?=[^\s…])(?:[^…#]|#(?! ))*?) *(# .*)?$", re.MULTILINE
)  # a key that may be turned on, with a value
CYLINDER = ["cylinder_sizing", "cylinder_drive", "clutch", "damper", "drive_train", "cyclogram"]


def test_a_platen_is_a_line_of_the_cyclogram_and_its_press_runs(tmp_path: Path) -> None:
    """No cylinder is brought along, none is missed, and the rate is that of the platen."""
    made = draft(["platen_press", "geneva_transport", "cyclogram", "drive_train"], DISCOVERY)
    assert made.added == ()
    lines = values(made)["timing"]["lines"]
    assert [each["mechanism"] for each in lines] == ["platen", "cross"]
    file = tmp_path / "press.yaml"
    file.write_text(made.text, "utf-8")
    results = Press.read(file, DISCOVERY).calculate().results
    assert results.summary.verdict == "conditional"
    checks = {f"{name}.{check.id}" for name, own in results.mechanisms.items() for check in own.checks}
    assert not [each for each in checks if "cylinder" in each or "carriage_height" in each]


def values(made: Draft) -> dict[str, Any]:
    """The mechanisms of a draft, as another reader of YAML has them."""
    return dict(yaml.safe_load(made.text)["mechanisms"])


def validated(text: str) -> None:
    assert load_config(yaml_tree.parse(text, "draft.yaml"), DISCOVERY).broken == {}


def calculated(made: Draft) -> ResultsRecord:
    outcome = Press.read(yaml_tree.parse(made.text, "draft.yaml"), DISCOVERY).calculate()
    assert outcome.broken == ()
    return outcome.results


@pytest.mark.parametrize("kind", KINDS)
def test_a_draft_of_each_kind_is_valid(kind: str) -> None:
    made = draft([kind], DISCOVERY)
    validated(made.text)
    assert (made.guessed, made.open) == ((), ())


@pytest.mark.parametrize("kinds", few([CYLINDER, *([kind] for kind in KINDS), KINDS], lambda kinds: kinds is CYLINDER))
def test_a_draft_is_calculated_and_no_check_fails(kinds: Sequence[str]) -> None:
    results = calculated(draft(kinds, DISCOVERY))
    assert results.status in ("pass", "warn")
    assert results.summary.assumed  # the values of an example are assumed


SUBSETS = st.lists(st.sampled_from(KINDS), min_size=2, max_size=12)


@examples(15)
@given(SUBSETS)
def test_a_draft_of_any_kinds_is_valid(kinds: list[str]) -> None:
    made = draft(kinds, DISCOVERY)
    validated(made.text)
    assert len(values(made)) == len(kinds) + len(made.added)


@pytest.mark.nightly
@examples(5)
@given(SUBSETS)
def test_a_draft_of_any_kinds_is_calculated(kinds: list[str]) -> None:
    results = calculated(draft(kinds, DISCOVERY))
    assert {mechanism.status for mechanism in results.mechanisms.values()} <= {"pass", "warn", "fail"}


@pytest.mark.parametrize("kind", few(KINDS, lambda kind: kind == "damper"))
def test_each_key_that_is_turned_off_has_a_default_that_may_be_turned_on(kind: str) -> None:
    text = draft([kind], DISCOVERY).text
    head = text.index("mechanisms:")
    found = [each for each in OFF.finditer(text, head) if "instead of" not in whole(text, each.end())]
    assert found
    for each in found:
        validated(f"{text[: each.start()]}    {each[1]}{text[each.end() :]}")


def whole(text: str, end: int) -> str:
    """The comment of a line, to its end in the next lines."""
    start = text.rindex("\n", 0, end)
    lines = text[start + 1 :].split("\n")
    more = next(number for number, line in enumerate(lines[1:], 1) if not line.startswith(" " * 20 + " "))
    return " ".join(line.rpartition("# ")[2] for line in lines[:more])


def test_partners_are_referred_to_and_without_them_numbers_stand() -> None:
    alone, together = (
        values(draft(["cylinder_drive"], DISCOVERY)),
        values(draft(["cylinder_drive", "cylinder_sizing"], DISCOVERY)),
    )
    assert alone["drive"]["cylinder_mass"] == {"value": "104 kg", "basis": "assumed"}
    assert together["drive"]["cylinder_mass"] == "${cylinder.mass}"
    assert together["drive"]["cylinder_length"] == "${cylinder.generatrix_length}"


def test_the_second_of_a_kind_belongs_to_the_second_of_another_one() -> None:
    made = values(
        draft(["cylinder_sizing", "cylinder_drive:left", "cylinder_sizing:other", "cylinder_drive"], DISCOVERY)
    )
    assert list(made) == ["cylinder", "left", "other", "drive"]
    assert made["left"]["cylinder_mass"] == "${cylinder.mass}" and made["drive"]["cylinder_mass"] == "${other.mass}"
    names = values(draft(["clutch", "clutch", "clutch:clutch_2", "damper"], DISCOVERY))
    assert list(names) == ["clutch", "clutch_3", "clutch_2", "damper"]


def test_what_a_kind_cannot_be_without_is_added() -> None:
    made = draft(["cyclogram:all"], DISCOVERY)
    assert [(new.name, asking.name) for new, asking in made.added] == [("drive", "all"), ("cross", "all")]
    assert [line["mechanism"] for line in values(made)["all"]["lines"]] == ["drive", "cross"]


@pytest.mark.parametrize(
    ("kinds", "added"),
    [
        (["platen_press", "cyclogram"], ["geneva_transport"]),
        (["cyclogram", "cam_gear_transport"], ["cylinder_drive"]),
        (["cyclogram"], ["cylinder_drive", "geneva_transport"]),
    ],
)
def test_of_several_ways_that_with_the_fewest_further_mechanisms_is_taken(kinds: list[str], added: list[str]) -> None:
    """A platen press brought the drive of a cylinder along where no transport was named."""
    assert [new.kind for new, _ in draft(kinds, DISCOVERY).added] == added


def test_each_drive_is_a_line_of_the_cyclogram() -> None:
    made = values(draft(["cylinder_drive:a", "cylinder_drive:b", "cam_gear_transport", "cyclogram"], DISCOVERY))
    assert [line["mechanism"] for line in made["timing"]["lines"]] == ["a", "b", "feeder"]


def test_each_key_stands_once_with_its_symbol_meaning_and_range() -> None:
    lines = draft(["clutch"], DISCOVERY).text.splitlines()
    (radius,) = [line for line in lines if "shoe_radius:" in line]
    assert radius.split("  # ") == [
        "    shoe_radius: {value: 180 mm, basis: assumed}          ".rstrip()
        + " " * (len(radius.split("  # ")[0]) - 48),
        "r: Radius of the drum's friction surface; > 0 mm",
    ]
    keys = DISCOVERY.mechanism("clutch").inputs.model_fields
    assert {key: sum(bool(re.match(rf" +(# )?{key}:", line)) for line in lines) for key in keys} == dict.fromkeys(
        keys, 1
    )
    (force,) = [line for line in lines if "allowable_slip_time:" in line]
    assert force.strip().startswith("# allowable_slip_time: … s") and "if omitted, not checked: Slip time" in force
    assert max(map(len, lines)) <= 150


def test_a_draft_in_ukrainian_explains_in_ukrainian() -> None:
    with speaking("uk", catalogues_for("uk", KINDS, DISCOVERY)):
        made = draft(KINDS, DISCOVERY)
    validated(made.text)
    data = yaml.safe_load(made.text)
    assert data["project"]["language"] == "uk"
    english = [part for part in comments(made.text) if re.search(r"\b(the|of|default|without)\b", part)]
    assert english == []


def comments(text: str) -> Iterator[str]:
    for line in text.splitlines():
        found = re.search(r"(?:^|\s)# (?!\w+:)(.*)", line)
        if found and "diecut-report" not in found[1] and not re.fullmatch(r"[\w./:${}… -]+", found[1]):
            yield found[1].replace("one of", "")


@pytest.fixture
def foreign(tmp_path: Path) -> Discovery:
    """A plugin without an example, and one with one."""
    text = """from diecut_report.api import Chapter, ExampleBlock, Inputs, Mechanism, Quantity, Wired, m
class Hook(Inputs):
    force = Quantity("F", "kN", "Load", gt=0)
    angle = Quantity("a", "deg", "Angle", gt=0, le=5)
step = Chapter("Hook")
step.pull = 2 * m.force, "P", "N", "Pull"
MECHANISM = Mechanism(kind="KIND", version="1", title="Hook", summary="A hook.", inputs=Hook, chapters=(step,)EXAMPLE)
"""
    (tmp_path / "hook.py").write_text(text.replace("KIND", "hook").replace("EXAMPLE", ""), "utf-8")
    example = ', example=ExampleBlock("lift", {"force": Wired("${<damper>.force_max}", otherwise="3 kN"), "angle": 4})'
    (tmp_path / "crane.py").write_text(text.replace("KIND", "crane").replace("EXAMPLE", example), "utf-8")
    return Discovery([tmp_path])


def test_an_example_that_needs_a_kind_that_is_not_there_is_a_fault_of_its_plugin(
    tmp_path: Path, foreign: Discovery
) -> None:
    text = (
        (tmp_path / "crane.py")
        .read_text("utf-8")
        .replace("Wired(", "(lambda value, otherwise: value)(")
        .replace("damper", "spring")
    )
    (tmp_path / "lift.py").write_text(text.replace('kind="crane"', 'kind="lift"'), "utf-8")
    with pytest.raises(PluginError, match="its example requires another mechanism: 'spring' is not a known kind"):
        draft(["lift"], Discovery([tmp_path]))


def test_a_foreign_plugin_gives_its_example_and_what_it_does_not_give_is_guessed_and_told(foreign: Discovery) -> None:
    made = draft(["hook", "crane", "crane"], foreign)
    found = values(made)
    assert found["lift"]["force"] == {"value": "3 kN", "basis": "assumed"} and "lift_2" in found
    assert found["hook"]["force"] == {"value": "10 kN", "basis": "assumed"}
    assert found["hook"]["angle"] == {"value": "1 deg", "basis": "assumed"}
    assert made.guessed == ("hook.force", "hook.angle")


# The command new: lists, writes, refuses; and the way of a designer who begins with it.


Capture = pytest.CaptureFixture[str]


def test_without_a_kind_the_kinds_are_listed_a_line_each(capfd: Capture) -> None:
    assert main(["new"]) == 0
    lines = capfd.readouterr().out.splitlines()
    assert "clutch              Friction clutch with a wedge-spread shoe ring" in lines
    assert len(lines) == 22
    assert main(["new", "--language", "uk"]) == 0
    assert "clutch              Фрикційна муфта" in capfd.readouterr().out


def test_without_a_file_it_goes_to_standard_output(capfd: Capture) -> None:
    assert main(["new", "clutch:main"]) == 0
    out, err = capfd.readouterr()
    assert list(yaml.safe_load(out)["mechanisms"]) == ["main"] and err == ""


def test_a_file_is_written_and_told_with_what_was_added(tmp_path: Path, capfd: Capture) -> None:
    file = tmp_path / "new folder" / "my_press.yaml"
    assert main(["new", "cyclogram", "-o", str(file)]) == 0
    out, err = capfd.readouterr()
    assert out == "" and err.splitlines() == [
        f"written: {file}",
        "added: drive (cylinder_drive), required by timing",
        "added: cross (geneva_transport), required by timing",
    ]
    assert "#   diecut-report report my_press.yaml -o build" in file.read_text("utf-8").splitlines()


def test_a_file_that_is_there_is_written_over_by_force_alone(tmp_path: Path, capfd: Capture) -> None:
    file = tmp_path / "press.yaml"
    file.write_text("mine\n", "utf-8")
    assert main(["new", "damper", "-o", str(file)]) == 2
    assert (
        capfd.readouterr().err
        == f"{file}: This already exists and is not overwritten. Choose another name, or give --force.\n"
    )
    assert file.read_text("utf-8") == "mine\n"
    assert main(["new", "damper", "-o", str(file), "--force", "--quiet"]) == 0
    assert "damper" in file.read_text("utf-8") and capfd.readouterr().err == ""
    assert main(["new", "damper", "-o", str(tmp_path), "--force"]) == 2
    assert [each.name for each in tmp_path.iterdir()] == ["press.yaml"]


def test_all_that_is_wrong_is_told_at_once_and_nothing_is_written(tmp_path: Path, capfd: Capture) -> None:
    file = tmp_path / "press.yaml"
    assert main(["new", "cluch", "damper:1x", "clutch:press", "clutch:a", "damper:a", "-o", str(file)]) == 2
    err = capfd.readouterr().err
    assert "'cluch' is not a known kind (did you mean 'clutch'?)" in err
    assert (
        "“1x” is not a name" in err
        and "the name 'press' is reserved" in err
        and "the name 'a' is given to several" in err
    )
    assert not file.exists()


def test_equal_kinds_give_equal_bytes(tmp_path: Path) -> None:
    texts = []
    for name in ("a", "b"):
        assert main(["new", "cam_gear_transport", "elastic_follower", "-o", str(tmp_path / name / "p.yaml")]) == 0
        texts.append((tmp_path / name / "p.yaml").read_bytes())
    assert texts[0] == texts[1]


def test_a_kind_without_an_example_is_written_with_what_is_to_be_given(tmp_path: Path, capfd: Capture) -> None:
    file = tmp_path / "press.yaml"
    code = main(["new", "lever", "-o", str(file), "--plugins", str(GOOD)])
    err = capfd.readouterr().err
    assert file.exists() and "no example values exist for these; enter your own: lever." in err
    assert code == main(["validate", str(file), "--plugins", str(GOOD), "--quiet"]) == 0


def test_a_designer_begins_changes_a_number_and_has_a_report(tmp_path: Path, capfd: Capture) -> None:
    file, out = tmp_path / "my_press.yaml", tmp_path / "build"
    assert main(["new", "damper", "cylinder_sizing", "-o", str(file)]) == 0
    text = file.read_text("utf-8")
    assert "velocity: {value: 0.6 m/s, basis: assumed}" in text
    file.write_text(text.replace("velocity: {value: 0.6 m/s, basis: assumed}", "velocity: 0.65 m/s"), "utf-8")
    assert (
        main(["report", "-o", str(tmp_path / "no"), str(file), "-o", str(out), "--format", "json", "--detail", "brief"])
        == 0
    )
    results = json.loads((out / "my_press.json").read_text("utf-8"))
    assert not (tmp_path / "no").exists()  # the last folder that is named holds: ./make-report names one first
    assert results["mechanisms"]["damper"]["inputs"]["velocity"]["value"] == pytest.approx(0.65)
    assert "mechanisms.damper.velocity" not in results["summary"]["assumed"]
    assert "mechanisms.damper.ring_width" in results["summary"]["assumed"]
    capfd.readouterr()
    assert main(["check", str(file)]) == 0
    assert "my_press" in capfd.readouterr().out
