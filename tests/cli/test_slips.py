"""Slips of the keyboard in a configuration: each command reports file, line and key, and ends with 2, whatever refers to the value."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path

import pytest

import diecut_report as dr
from diecut_report.cli.main import main, program
from diecut_report.cli.output import FAULT
from diecut_report.config import yaml
from diecut_report.config.plugins import Discovery
from diecut_report.live.session import LiveSession
from diecut_report.study import machines
from tests.configs import MECHANISMS, problems, saved
from tests.examples import every, few

Capture = pytest.CaptureFixture[str]
PRESS = """\
schema_version: 1
project: {title: Test}
press:
  name: P
  productivity: 6000 1/h
  sheet:
    length: 700 mm
    width: 470.7 mm
    thickness: 0.6 mm
mechanisms:
  cylinder:
    kind: cylinder_sizing
    working_length: ${press.sheet.width}
    segment_height: 40 mm
    generatrix_length: ${press.sheet.length}
    bore_radius: 60 mm
    bearing_span: ${press.sheet.length} + 160 mm
  clutch:
    kind: clutch
    torque: 300 N*m
    shoe_radius: ${cylinder.segment_height} * 3
    wedge_angle: 10 deg
"""
STUDY = """\
schema_version: 1
base: press.yaml
sample: {method: grid}
vary: {mechanisms.clutch.wedge_angle: [9 deg, 10 deg]}
optimise: {objectives: [{minimise: clutch.pressing_force}], evaluations: 4}
"""
WIDTH, HEIGHT, RATE, ANGLE = "470.7 mm", "40 mm", "6000 1/h", "10 deg"
SLIPS = [  # what is typed, what is typed instead, and what the message holds
    # numbers
    (WIDTH, "470,700 mm", "470700 mm or 470.700 mm"), (WIDTH, "47o.7 mm", "'47o.7 mm'|'o.7 mm'"), (WIDTH, "4O0 mm", "mm"),
    (WIDTH, "l70 mm", "number"),
    (WIDTH, "470.7.0 mm", "470.7.0|'.0 mm'"), (WIDTH, "470..7 mm", "mm"), (WIDTH, "470 . 7 mm", "mm"), (WIDTH, "-470.7 mm", "out of range"),
    (WIDTH, "0 mm", "out of range"), (WIDTH, "1e999 mm", "finite|range|plausible"), (WIDTH, ".nan", "number|nan"), (WIDTH, ".inf", "number|inf"),
    (WIDTH, "1e30 m", "plausible|range"), (WIDTH, "470.7 ± 1 mm", "unit"), (WIDTH, "~470 mm", "number|mm"), (WIDTH, "> 470 mm", "number|text|mm"),
    (WIDTH, "470.7\u00a0 mm 2", "unit"), (RATE, "6 000 1/h", "6000 1/h or 6.000 1/h"), (RATE, "'6,000 1/h'", "6000 1/h or"),
    (RATE, "6'000 1/h", "6000 1/h or"),
    (WIDTH, "\u2212470 mm", "number|range|minus"), (WIDTH, "½ m", "number"), (WIDTH, "1/0 mm", "zero|unit|number"), (WIDTH, "1/0", "unit"),
    # units
    (WIDTH, "470.7 kg", "is a mass; a length is needed"), (WIDTH, "мм", "number"), (WIDTH, "470.7 Мм", "unit|mm"), (WIDTH, "470.7 MM", "unit|mm"),
    (WIDTH, "470.7 mmm", "not a known unit"), (WIDTH, "470.7 mm mm", "length|unit"), (WIDTH, "mm 470.7", "number"),
    (WIDTH, "470.7 mm²", "area|length"),
    (WIDTH, "470.7 %", "length|unit"), (WIDTH, "470.7°", "angle|unit|length"), (RATE, "sheets/h", "number"), (RATE, "6000 sheets/h", "unit"),
    (RATE, "6000 h", "time|needed"), (RATE, "6000 1/hh", "unit"), (ANGLE, "10 degg", "unit"), (ANGLE, "10 grd", "unit"),
    (ANGLE, "10 mm", "length"), (WIDTH, "470.7 inch mm", "unit|area|length"),
    # references and expressions
    (WIDTH, "${cylinder.weight}", "no 'weight'"), (WIDTH, "${cylinder.mass", "reference"), (WIDTH, "$cylinder.mass", "reference|number"),
    (WIDTH, "{cylinder.mass}", "cylinder.mass|unknown|block"), (WIDTH, "'${}'", "there is no mechanism ''"), (WIDTH, "${cylinder}", "cylinder"),
    (WIDTH, "${press.sheet.width}", "refers to itself"), (WIDTH, "${cylinder.working_length}", "refers to itself"),
    (WIDTH, "${cylinder.mass}", "kg|itself"),
    (WIDTH, "${cilinder.mass}", "cilinder"), (WIDTH, "${press.sheet.lenght}", "lenght"), (WIDTH, "${press.name}", "name"),
    (WIDTH, "${clutch.torque} / 0 N", "zero|itself|divi"),
    (WIDTH, "2 * ${press.sheet.length", "reference|[{]"), (WIDTH, "2 x 235 mm", "unit|x"), (WIDTH, "'=2*235 mm'", "number|="),
    (WIDTH, "sqrt(4) mm", "mm"),
    (WIDTH, "${press.sheet.length} + 1 kg", "kg|mass"), (WIDTH, "${press.sheet.length} +", r"\+|expression|end"), (HEIGHT, "4O mm", "mm"),
    (HEIGHT, "40 kg", "mass"), (HEIGHT, "-40 mm", "range"), (HEIGHT, "", "has no value"), (HEIGHT, "null", "has no value"),
    # YAML
    (WIDTH, "[470.7 mm]", "list|text"), (WIDTH, "{value: 470.7 mm, bassis: assumed}", "bassis"),
    (WIDTH, "{value: 470.7 mm, basis: assume}", "assume"),
    (WIDTH, "{valu: 470.7 mm}", "valu"), (WIDTH, "yes", "yes|number"), (WIDTH, "true", "true|number"), (WIDTH, "2026-01-01", "2026|number|unit"),
    (WIDTH, "'470.7 mm", "."), (WIDTH, '"470.7 mm', "."), (WIDTH, "470.7: mm", "."), (WIDTH, "*width", "width"), (WIDTH, "!mm 470.7", "mm|tag"),
    (WIDTH, "470.7 mm, width: 1 mm", "second colon"), (WIDTH, "0x1D6 mm", "unit|number"), (WIDTH, "4_7_0 mm", "unit|number|mm"),
    ("    kind: clutch", "    kind: cluch", "cluch"), ("    kind: clutch", "    kind:", "kind"), ("    kind: clutch", "    knd: clutch", "kind"),
    ("    kind: clutch", "    Kind: clutch", "kind|Kind"), ("    kind: clutch", "    kind: сlutch", "clutch"),
    ("    kind: clutch", "\tkind: clutch", "."),
    ("    kind: clutch", "   kind: clutch", "."), ("    kind: clutch", "kind: clutch", "indentation"), ("  clutch:", "  cylinder:", "cylinder"),
    ("  clutch:", "  clutch", "."),
    ("  clutch:", "  2nd clutch:", "name"), ("  clutch:", "  press:", "press"), ("    torque:", "    torqe:", "torqe"),
    ("    torque:", "    torque :x:", "."),
    ("mechanisms:", "mechanism:", "mechanism"), ("mechanisms:", "mechanisms", "."), ("press:\n", "pres:\n", "pres"),
    ("schema_version: 1", "schema_version: 2", "schema_version"),
    ("schema_version: 1", "", "schema_version"), ("{title: Test}", "{titel: Test}", "titel"), ("{title: Test}", "{title: Test", "."),
    ("press.sheet.width}", "press.sheet.width)", "reference|{"),
    (RATE, "12:30", "unit"), (RATE, "on", "number"), (RATE, "6_000 1/h", "unit|number"), (RATE, "6000–7000 1/h", "unit"),
    (RATE, "٦٠٠٠ 1/h", "number"),
    (ANGLE, "10°30'", "unit"), (ANGLE, "[10 deg, 20 deg]", "list"), (ANGLE, "{value: {value: 1}}", "value"), (ANGLE, "{a: 1}", "a block without"),
    (ANGLE, "{value: 10 deg, basis: }", "basis"), (ANGLE, "{value: , basis: assumed}", "without a value"), (ANGLE, "${press.sheet}", "list|block"),
    ("300 N*m", "300 Н*м*м", "needed"), ("    torque:", "    tоrque:", "tоrque"), ("${cylinder.seg", "${суlinder.seg", "Latin"),
    ("segment_height} * 3", "segment_hеight} * 3", "segment_hеight"), ("    torque:", "    bore_radius: 60 mm\n    torque:", "bore_radius"),
    ("    torque:", "    torque: 200 N*m\n    torque:", "again"), ("    kind: clutch", "    kind: clutch\n    <<: *x", "Merge"),
    ("300 N*m", "9**9**9 N*m", "unit"), ("300 N*m", "\u202e300 N*m", "U.202E"),
]  # fmt: skip
OF_YAML = "YAML|A tab|alias|The tag|Merge|again|not text|U\\+"
BY_CALCULATION = "${clutch.torque} / 0 N"
OF_A_CONFIGURATION = {
    "advise": [], "calc": [], "check": [], "compare": [], "influence": [], "report": ["-o", "out"],
    "solve": ["--for", "clutch.pressing_force <= 1 kN", "--vary", "clutch.torque"],
    "validate": [], "diff": ["good.yaml"],
}  # fmt: skip
OF_A_NUMBER = {"where": "clutch.pressing_force"}
OF_A_STUDY = {"batch": ["-o", "out"], "optimise": ["-o", "out"], "validate": []}
OTHERS = {
    "live",
    "check-plugin",
    "extract",
    "new",
    "new-plugin",
    "plugins",
    "render",
    "schema",
    "sign",
    "take",
    "variants",
    "verify",
}
"""Commands that read no configuration typed by a user; the page of live shows the faults of its file, and stays."""


def test_every_command_is_tried_or_named() -> None:
    assert {*OF_A_CONFIGURATION, *OF_A_NUMBER, *OF_A_STUDY, *OTHERS} == set(program.commands)


@pytest.fixture(name="folder")
def current_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def slipped(typed: str, instead: str) -> str:
    assert PRESS.count(typed) >= 1
    return PRESS.replace(typed, instead, 1)


def commands() -> Iterator[tuple[str, list[str]]]:
    yield from ((name, ["press.yaml", *more]) for name, more in OF_A_CONFIGURATION.items())
    yield from ((name, [number, "press.yaml"]) for name, number in OF_A_NUMBER.items())
    yield from ((name, ["study.yaml", *more]) for name, more in OF_A_STUDY.items())


def reported(command: str, arguments: list[str], capfd: Capture) -> str:
    """What a command reports of the slip, which it must end with 2 and in one line a problem."""
    code = main([command, *arguments])
    out, err = capfd.readouterr()
    assert code == 2, (command, code, err)
    assert "Traceback" not in err and "fault of diecut-report" not in err, command
    return err + out


@pytest.mark.parametrize(
    ("typed", "instead", "words"),
    every(2, SLIPS),
    ids=[f"{number}: {each[1].strip()[:30]}" for number, each in enumerate(SLIPS)],
)
def test_a_slip_is_reported_with_its_place_by_the_commands_that_read_most(
    typed: str, instead: str, words: str, folder: Path, capfd: Capture
) -> None:
    saved(folder, slipped(typed, instead))
    saved(folder, PRESS, "good.yaml")
    told = reported("validate", ["press.yaml"], capfd)
    line = next(each for each in told.splitlines() if each.startswith("press.yaml:"))
    assert re.match(r"press\.yaml:\d+:\d+: ", line) and re.search(words, told)


PARTS = Path(import_module("diecut_report.configs").__path__[0]) / "machines" / "flat_cylinder.yaml"
OF_PARTS = PARTS.read_text("utf-8")
SECTIONS, DRIVE, CONVEYED = "45x70 r1, 50x40 r1, 60x320", "module: 4, width: 50}", "to: [far.left, far.right]"
FORM = r"section 1 .*write diameter x length in mm.*60x320 r1"
SLIPS_OF_PARTS = [
    ("  surface:", "  surfce:", "surfce: is an unknown key .did you mean 'surface'"), ("  stop:", "  stopp:", "did you mean 'stop'"),
    ("  shaft_material:", "  shaft_materiall:", "did you mean 'shaft_material'"), ("  basis:", "  kind: x\n  basis:", "kind: is an unknown key"),
    (SECTIONS, "45.0.0x70 r1", FORM), (SECTIONS, "45..x70", FORM), (SECTIONS, ".x70", FORM), (SECTIONS, "45x70 r..", FORM),
    (SECTIONS, "45х70", r"section 1 .*“х” \(cyrillic small letter ha\) only looks Latin"), (SECTIONS, "٤٥x70", FORM),
    (SECTIONS, "45x70, 50*40", "section 2 “50.40 r1"), ("parts: [{pulley: small, at: 25}]", "parts: 5", "parts: is 5; a list is needed"),
    ("parts: [{pulley: small, at: 25}]", "parts: true", "parts: is true; a list"), ("sections: 35x70",
     "left: '${shafts.main.parts.²}'\n    sections: 35x70", "²"),
    ("  cylinder:\n    kind", "  shafts_main:\n    kind", "is the name of a calculation"),
    ("teeth: 18/87", "teeth: 18/87/3", "two numbers of teeth"), ("teeth: 30/30", "teeth: 30/", "one number of teeth, or two"),
    ("diameters: 125/375", "diameters: 125/375/500", "two diameters"), ("teeth: 18/87", "teeth: 18/87, teeth_1: 19", "stands beside teeth_1"),
    ("teeth: 52", "teeth: 52, teeth_1: 9", "stands beside teeth_1"), ("  main_drive:", "  ../x:", "is not a name"),
    ("belts: {motor:", "belts: {mo tor:", "“mo tor”, which is not a name"),
    (DRIVE, "module: 4, width: 50, foo: 1}", "foo: is an unknown key"), ("at: 100, designation", "at: 100 kg, designation", "is a mass; a length"),
]  # fmt: skip


@pytest.mark.parametrize(
    ("typed", "instead", "words"),
    every(2, SLIPS_OF_PARTS),
    ids=[f"{number}: {each[1].strip()[:30]}" for number, each in enumerate(SLIPS_OF_PARTS)],
)
def test_a_slip_in_the_parts_of_a_machine_is_reported_with_its_place(
    typed: str, instead: str, words: str, folder: Path, capfd: Capture
) -> None:
    text = OF_PARTS.replace("  stop:", "  surface: ground\n  stop:", 1)
    assert typed in text
    saved(folder, text.replace(typed, instead, 1))
    told = reported("validate", ["press.yaml"], capfd)
    lines = told.splitlines()
    assert all(re.match(r"press\.yaml:\d+:\d+: ", each) for each in lines) and re.search(words, told)
    assert len(lines) <= 2 and "sheet_step" not in told and "there is no such" not in told


def test_a_slip_in_the_parts_hides_none_in_a_mechanism(tmp_path: Path) -> None:
    text = OF_PARTS.replace(SECTIONS, "45..x70", 1).replace("    segment_height: 40 mm", "    segment_hight: 40 mm", 1)
    told = problems(tmp_path, text)
    assert len(told) == 2 and "which cannot be read" in told[0] and "did you mean 'segment_height'" in told[1]


SECOND = "  other: {kind: clutch, wedge_angel: 10 deg}\n"


@pytest.mark.parametrize(
    ("typed", "instead"),
    [each[:2] for each in SLIPS],
    ids=[f"{number}: {each[1].strip()[:30]}" for number, each in enumerate(SLIPS)],
)
def test_a_slip_hides_no_other_of_the_file(typed: str, instead: str, tmp_path: Path) -> None:
    told = "\n".join(problems(tmp_path, slipped(typed, instead) + SECOND))
    assert re.search(r"wedge_angel: is an unknown key \(did you mean 'wedge_angle'", told) or re.search(OF_YAML, told)


def test_one_bad_file_hides_no_other(folder: Path, capfd: Capture) -> None:
    saved(folder, PRESS, "good.yaml")
    for number, instead in enumerate(
        ("'470,700 mm'", "470 kg", "мм", "-700 mm", "${cylinder.weight}", "${cylinder.mass", "[1")
    ):
        saved(folder, slipped(WIDTH, instead), f"bad{number}.yaml")
    told = reported("check", [".", "--jobs", "1"], capfd)
    assert all(re.search(rf"bad{number}\.yaml:\d+:\d+: ", told) for number in range(7)) and re.search(
        r"(?m)^good +conditional", told
    )


def test_a_fault_of_the_program_in_one_file_hides_no_other(
    folder: Path, capfd: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    read = machines._source

    def broken(given: object, *others: object) -> object:
        if "bad" in str(given):
            raise ZeroDivisionError("of nothing")
        return read(given, *others)  # type: ignore[arg-type]

    monkeypatch.setattr(machines, "_source", broken)
    saved(folder, PRESS, "good.yaml")
    saved(folder, PRESS, "bad.yaml")
    assert main(["check", ".", "--jobs", "1"]) == FAULT
    out, err = capfd.readouterr()
    assert re.search(r"(?m)^good +conditional", out) and re.search(r"(?m)^bad +fault of the program$", out)
    assert re.search(
        r"(?m)^bad\.yaml: This is a fault of .*test_slips\.py, line \d+: ZeroDivisionError: of nothing", err
    )


def test_a_fault_of_the_program_in_one_of_several_files_hides_no_problem_of_another(
    folder: Path, capfd: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    read = yaml.read
    monkeypatch.setattr(yaml, "read", lambda file: read(file) if "bad" not in str(file) else 1 / 0)
    saved(folder, PRESS, "bad.yaml")
    saved(folder, slipped(HEIGHT, "40 kg"))
    assert main(["validate", "bad.yaml", "press.yaml"]) == FAULT
    err = capfd.readouterr().err
    assert "ZeroDivisionError" in err and "is a mass; a length is needed" in err
    assert main(["validate", "bad.yaml"]) == FAULT
    assert "Traceback" in capfd.readouterr().err  # of one file alone all is told


@pytest.mark.parametrize(("command", "arguments"), few(list(commands()), lambda each: each[0] in ("batch", "where")))
def test_every_command_reports_every_slip(command: str, arguments: list[str], folder: Path, capfd: Capture) -> None:
    saved(folder, PRESS, "good.yaml")
    saved(folder, STUDY, "study.yaml")
    for typed, instead, _ in SLIPS:
        if instead == BY_CALCULATION and (
            command in ("influence", "optimise", "batch", "solve") or "study.yaml" in arguments
        ):
            continue  # a machine that cannot exist is an error of its variants, which a study reports; influence names no line of it
        saved(folder, slipped(typed, instead))
        assert re.search(r"press\.yaml:\d+:\d+: ", reported(command, arguments, capfd)), (command, instead)
        assert not (folder / "out").exists()


FORMS = [  # of YAML that is read and refused, beside which all else is told; what is typed, what instead, and what the message holds
    (WIDTH, "*width", "no anchor"), (WIDTH, "!mm 470.7", "The tag"), (WIDTH, "{value: 470.7 mm, value: 1 mm}", "stands here again"),
    (WIDTH, "{<<: {value: 470.7 mm}}", "Merge keys"), ("    torque:", "    wedge_angle:", "stands here again"), ("  clutch:", "  2:", "not text"),
    ("schema_version: 1", "schema_version: 1\nschema_version: 1", "stands here again"),
]  # fmt: skip
BESIDE = slipped(HEIGHT, "40 kg")


@pytest.mark.parametrize(("typed", "instead", "words"), FORMS)
def test_what_is_refused_of_the_form_hides_no_other_fault(
    typed: str, instead: str, words: str, folder: Path, capfd: Capture) -> None:  # fmt: skip
    text = BESIDE.replace(typed, instead, 1)
    saved(folder, text)
    saved(folder, STUDY, "study.yaml")
    for command, arguments in (("validate", "press.yaml"), ("check", "press.yaml"), ("batch", "study.yaml")):
        told = reported(command, [arguments], capfd)
        assert words in told and "is a mass; a length is needed" in told, command
        assert len(re.findall(rf"(?m)^press.yaml:\d+:\d+: .*{words}", told)) == 1
    with pytest.raises(dr.ConfigError, match="is a mass") as raised:
        dr.loads(text)
    assert words in str(raised.value)
    session = LiveSession(folder / "press.yaml", Discovery())
    faults = "\n".join(map(str, session.faults))
    assert words in faults and "is a mass" in faults


def test_a_study_that_names_a_key_twice_is_told_with_its_other_faults(folder: Path, capfd: Capture) -> None:
    saved(folder, PRESS)
    saved(folder, STUDY.replace("9 deg", "9 kg") + "base: press.yaml\n", "study.yaml")
    told = reported("validate", ["study.yaml"], capfd)
    assert "stands here again" in told and "is a mass" in told


def test_a_quote_that_is_never_closed_is_told_where_it_begins(folder: Path, capfd: Capture) -> None:
    saved(folder, slipped(WIDTH, "'470.7 mm"))
    assert "press.yaml:8:12: " in reported("validate", ["press.yaml"], capfd)


@pytest.mark.parametrize(
    ("typed", "instead", "words"),
    [
        (WIDTH, "470.7 Мм", r"Did you mean mm\?"), (WIDTH, "470.7 mм", r"Did you mean mm\? “м” \(cyrillic small letter em\) only looks Latin"),
        (RATE, "6000 1/Год", r"Did you mean 1/h\?"), ("    torque:", "    tоrque:", r"'torque'\? “о” \(cyrillic small letter o\) only looks Latin"),
        (WIDTH, "${cylinder.mаss}", r"'mass'\? “а” \(cyrillic small letter a\) only looks Latin"), (WIDTH, "470.7 ± 1 mm", "unit. A length"),
    ],
)  # fmt: skip
def test_letters_of_another_alphabet_are_told(
    typed: str, instead: str, words: str, folder: Path, capfd: Capture) -> None:  # fmt: skip
    saved(folder, slipped(typed, instead))
    assert re.search(words, reported("validate", ["press.yaml"], capfd))


@pytest.mark.parametrize(
    ("typed", "instead", "words"),
    [
        ("${cylinder.segment_height} * 3", "${cylinder.segment_height} * ${cylinder.radius", r"'\$\{cylinder.radius' has no closing brace"),
        ("${press.sheet.length} + 160 mm", "${press.sheet.length} + @" + 70 * "x", r"'@x{58}…' is not allowed here"),
        (HEIGHT, "105 m", r"105 m is not plausible; plausible: 1 µm to 100 m\. Is 105 mm meant\?"),
        (WIDTH, "470.7 km", r"470.7 km is not plausible; .* Is 470.7 mm meant\?"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_shown_whole_and_with_what_may_be_meant(
    typed: str, instead: str, words: str, folder: Path, capfd: Capture) -> None:  # fmt: skip
    saved(folder, slipped(typed, instead))
    main(["validate", "press.yaml"])
    assert re.search(words, "".join(capfd.readouterr()))


def test_a_default_of_the_press_is_blamed_where_it_is_typed(folder: Path, capfd: Capture) -> None:
    text = MECHANISMS.read_text("utf-8").replace("    material_thickness: ${press.sheet.thickness}\n", "", 1)
    line = 1 + text[: text.index("thickness: 0.6 mm")].count("\n")
    saved(folder, text.replace("thickness: 0.6 mm", "thickness: 300 mm", 1))
    told = reported("validate", ["press.yaml"], capfd)
    words = (
        "press.sheet.thickness: drive.material_thickness takes it by default: is 300 mm, but the board must be thinner"
    )
    assert f"press.yaml:{line}:16: {words}" in told


def test_a_machine_that_cannot_exist_is_not_a_bad_file(folder: Path, capfd: Capture) -> None:
    saved(folder, slipped(HEIGHT, "40 kg"), "bad.yaml")
    saved(folder, slipped("bore_radius: 60 mm", "bore_radius: 600 mm"), "impossible.yaml")
    assert main(["check", ".", "-o", "out", "--format", "json,html"]) == 2
    out, err = capfd.readouterr()
    assert re.search(r"(?m)^bad +bad file$", out) and re.search(r"(?m)^impossible +impossible machine$", out)
    assert "2 machines: 1 impossible machine, 1 bad file." in err and "impossible.yaml:16:" in err
    assert {each["status"] for each in json.loads((folder / "out" / "machines.json").read_text())["machines"]} == {
        "bad",
        "impossible",
    }


def test_names_longer_than_a_file_system_takes_are_told(folder: Path, capfd: Capture) -> None:
    name = "n" * 400
    saved(folder, PRESS.replace("press:\n", f"materials: {name}.yaml\nreport: {{logo: {name}.png}}\npress:\n", 1))
    saved(folder, STUDY.replace("press.yaml", f"{name}.yaml"), "study.yaml")
    for command, given in (
        ("validate", "press.yaml"),
        ("validate", "study.yaml"),
        ("check", f"{name}.yaml"),
        ("live", f"{name}.yaml"),
    ):
        assert name in reported(command, [given], capfd)


@pytest.mark.parametrize("base", ["Base: press.yaml", ""])
def test_a_study_without_a_base_is_judged_as_a_study(base: str, folder: Path, capfd: Capture) -> None:
    saved(folder, STUDY.replace("base: press.yaml", base), "study.yaml")
    told = reported("validate", ["study.yaml"], capfd)
    assert "base: is missing" in told and "project" not in told
