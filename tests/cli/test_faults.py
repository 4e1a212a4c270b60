"""What a fault in a plugin's code costs: a figure's fault the figure, an export's the export, told in words with exit code 3."""

from __future__ import annotations

import json
import re
import signal
import time
from pathlib import Path
from typing import Any

import pytest

from diecut_report import declaration, time_limit
from diecut_report.api import Quantity
from diecut_report.cli.main import main
from diecut_report.time_limit import TooLong, in_time, limited
from tests.configs import GOOD, HEAD, saved
from tests.examples import few

Capture = pytest.CaptureFixture[str]
PLUGIN = """
import numpy as np
from diecut_report.api import *


class Disc(Inputs):
    radius = Quantity("r", "mm", "Radius", gt=0, default=50)
    n_points = samples(36)


chapter = Chapter("All")
chapter.width = 2 * m.radius, "b", "mm", "Width"
chapter.angle = abscissa(2 * np.pi), "φ", "deg", "Angle"
chapter.height = m.radius * np.sin(m.angle), "y", "mm", "Height"
chapter.hidden = inner(m.radius * np.sin(m.angle)), "z", "mm", "Hidden"
STEPS

MECHANISM = Mechanism(
    kind="disc", version="1", title="Disc", summary="A disc.", inputs=Disc, chapters=(chapter,),
    figures=(
        FIGURE,
        Plot(id="sound", title="Sound", caption="All is well.", abscissa="angle",
             panels=(Panel(title="Height", unit="mm", series=(Series(curve="height", label="y"),)),)),
    ),
    exports=EXPORTS,
)
"""
PLOT = """Plot(id="lost", title="Lost", caption="Is not there.", abscissa="angle",
     panels=(Panel(title="Height", unit="mm", series=(Series(curve={!r}, label="y"),), {}),))"""
DRAWING = "Drawing(id='lost', title='Lost', caption='Is not there.', build=lambda view: {})"
NONE = "Drawing(id='lost', title='Lost', caption='', build=lambda view: [point((0, 0))])"
IN_CALC = {
    "a number for a curve": (PLOT.format("width", ""), "'width' is a number or a text, not a curve"),
    "an unknown curve": (PLOT.format("heigth", ""), "'heigth' is not a quantity of this machine"),
    "a curve that is not an output": (PLOT.format("hidden", ""), "'hidden' is a curve that is not an output"),
    "a level at an unknown id": (PLOT.format("height", "levels=(Level(value='top', label='t'),)"), "no number 'top'"),
    "an unknown id": (DRAWING.format("[circle((0, 0), view['top'])]"), "there is no number 'top' in this machine"),
    "what raises": (DRAWING.format("1 / 0"), "ZeroDivisionError: division by zero (disc.py:"),
    "what raises in numpy": (DRAWING.format("np.linalg.inv(np.zeros((2, 2)))"), "Singular matrix (disc.py:"),
    "a point at NaN": (
        DRAWING.format("[point((float('nan'), 0))]"),
        "shapes.0.point.at.0: Input should be a finite number",
    ),
    "an array": (
        DRAWING.format("[{'shape': 'polyline', 'points': np.zeros((2, 2))}]"),
        "shapes.0.polyline.points: Input should be a valid list",
    ),
    "an unknown shape": (DRAWING.format("[{'shape': 'blob', 'at': [0, 0]}]"), "Input tag 'blob' found"),
    "a shape without its keys": (DRAWING.format("[{'shape': 'circle'}]"), "shapes.0.circle.center: Field required"),
    "bars of a curve": (
        "Bars(id='lost', title='Lost', caption='', groups=(BarGroup(label='', unit='mm', bars=(('y', 'height'),)),))",
        "no number 'height'",
    ),
}
IN_DRAWING = {
    "a wrong role": (
        DRAWING.format("[circle((0, 0), view['width'], 'bold')]"),
        "'bold' is not a role of a circle; known: outline",
    ),
}


def folder(tmp_path: Path, figure: str = NONE, steps: str = "", exports: str = "()") -> Path:
    """A folder with the plugin."""
    text = PLUGIN.replace("STEPS", steps).replace("FIGURE", figure).replace("EXPORTS", exports)
    (tmp_path / "plugins").mkdir()
    saved(tmp_path / "plugins", text, "disc.py")
    return tmp_path / "plugins"


def run(tmp_path: Path, command: str, plugins: Path, *more: str) -> int:
    config = saved(tmp_path, HEAD + "  a: {kind: disc}\n")
    target = tmp_path / "out" / ("press.json" if command == "calc" else "")
    return main([command, str(config), "-o", str(target), "--plugins", str(plugins), *more])


def results(tmp_path: Path) -> dict[str, Any]:
    found: dict[str, Any] = json.loads((tmp_path / "out" / "press.json").read_text("utf-8"))["mechanisms"]["a"]
    return found


@pytest.fixture
def undeclared(monkeypatch: pytest.MonkeyPatch) -> None:
    """What declarations tell is not asked: a fault shows where it strikes, as one of the program's own plugins would."""
    monkeypatch.setattr(declaration, "faults", lambda mechanism: [])


@pytest.mark.usefixtures("undeclared")
@pytest.mark.parametrize("command", ["calc", "report"])
@pytest.mark.parametrize("fault", IN_CALC)
def test_a_figure_that_fails_costs_the_figure(tmp_path: Path, capfd: Capture, command: str, fault: str) -> None:
    figure, words = IN_CALC[fault]
    assert run(tmp_path, command, folder(tmp_path, figure), *(["--format", "json"] if command == "report" else [])) == 3
    err = capfd.readouterr().err
    told = next(line for line in err.splitlines() if line.startswith("mechanism 'a' of plugin 'disc': figure 'lost': "))
    assert words in told and "disc.py:" in told and "Traceback" not in err
    found = results(tmp_path)
    assert found["outputs"]["width"]["value"] == pytest.approx(0.1) and found["status"] == "pass"
    lost, sound = found["figures"]
    assert lost["type"] == "failed" and words in lost["error"] and sound["type"] == "plot"


@pytest.mark.parametrize("fault", IN_DRAWING)
def test_a_figure_that_cannot_be_drawn_costs_the_figure(tmp_path: Path, capfd: Capture, fault: str) -> None:
    figure, words = IN_DRAWING[fault]
    assert run(tmp_path, "report", folder(tmp_path, figure), "--format", "html,json") == 3
    err = capfd.readouterr().err
    told = next(line for line in err.splitlines() if "figure 'lost' cannot be drawn: " in line)
    assert told.startswith("mechanism 'a' of plugin 'disc'") and words in told and "disc.py:" in told
    assert "Traceback" not in err and "fault of diecut-report" not in err
    page = (tmp_path / "out" / "press.html").read_text("utf-8")
    assert page.count("This figure could not be drawn.") == 1 and page.count("<figure") == 2
    assert page.partition("<script")[0].count('pt" stroke-linejoin="round" role="img"') == 1


@pytest.mark.parametrize("formats", few(["html", "html,pdf"], keep=lambda formats: formats == "html"))
def test_the_report_shows_a_box_in_the_place_of_a_lost_figure(tmp_path: Path, capfd: Capture, formats: str) -> None:
    assert run(tmp_path, "report", folder(tmp_path, IN_CALC["what raises"][0]), "--format", formats) == 3
    assert "There are no checks." in capfd.readouterr().err
    page = (tmp_path / "out" / "press.html").read_text("utf-8")
    assert "This figure could not be drawn." in page and "ZeroDivisionError: division by zero" in page
    assert "Is not there." in page and "100" in page
    assert "There are no checks." in page
    assert "All checks pass" not in page
    assert "The mechanisms cite no sources." in page
    assert re.search(r"\(disc\.py:\d+\)", page) and str(tmp_path) not in page
    assert formats == "html" or (tmp_path / "out" / "press.pdf").read_bytes().startswith(b"%PDF")


@pytest.mark.usefixtures("undeclared")
@pytest.mark.parametrize(
    ("columns", "words"),
    [(("width", "height"), "'width' is a number"), (("height", "heigth"), "'heigth' is not a quantity")],
)
def test_an_export_that_fails_costs_the_export(tmp_path: Path, capfd: Capture, columns: Any, words: str) -> None:
    exports = f"(Profile(id='edge', title='Edge', columns={columns!r}),)"
    assert run(tmp_path, "report", folder(tmp_path, exports=exports), "--format", "html,json") == 3
    err = capfd.readouterr().err
    assert "of plugin 'disc': export 'edge': " in err and words in err and "disc.py:" in err
    assert words in results(tmp_path)["exports"][0]["error"]
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == ["press.html", "press.json"]
    assert "Edge could not be written" in (tmp_path / "out" / "press.html").read_text("utf-8")


@pytest.mark.usefixtures("undeclared")
def test_an_export_of_what_is_no_length_costs_the_export(tmp_path: Path, capfd: Capture) -> None:
    exports = "(Profile(id='edge', title='Edge', columns=('angle', 'height')),)"
    assert run(tmp_path, "report", folder(tmp_path, exports=exports), "--format", "json") == 3
    err = capfd.readouterr().err
    assert "export 'edge' cannot be drawn: ValueError: angle is not a length" in err and "disc.py:" in err


COMPUTED = 'chapter.x = computed({}, takes=("radius",), method="m"), "x", "1", "X"'
STEPS = {
    "a formula": 'chapter.x = m.lost, "x", "1", "X"',
    "computed": COMPUTED.format("lambda r: 1 / 0"),
    "a curve without values": 'chapter.x = as_number(np.arcsin(np.sin(m.angle) + 2)), "x", "1", "X"',
    "sys.exit": COMPUTED.format("lambda r: exit(5)"),
    "BaseException": COMPUTED.format("lambda r: (_ for _ in ()).throw(BaseException('no'))"),
    "no text": """chapter.words("w", function=lambda r: 5, takes=("radius",))
chapter.require("q", m.radius < 0, key="radius", message="is {w}")""",
    "a clash": 'chapter.clash("x", function=lambda r: 1 / 0, takes=("radius",), key="radius", message="m")',
}


@pytest.mark.parametrize("step", STEPS)
@pytest.mark.parametrize("command", ["calc", "report"])
def test_what_raises_in_a_calculation_gives_3_in_words(tmp_path: Path, capfd: Capture, command: str, step: str) -> None:
    plugins = folder(tmp_path, steps=STEPS[step])
    assert run(tmp_path, command, plugins, *(["--format", "json"] if command == "report" else [])) == 3
    err = capfd.readouterr().err
    assert "mechanism 'a' of plugin 'disc': " in err and "Traceback" not in err
    assert results(tmp_path)["status"] == "error"


def test_code_of_the_inputs_that_raises_gives_3_in_words(tmp_path: Path, capfd: Capture) -> None:
    plugins = folder(tmp_path)
    text = (plugins / "disc.py").read_text("utf-8")
    text = text.replace(
        "class Disc(Inputs):", "class Disc(Inputs):\n    def model_post_init(self, _):\n        1 / 0\n"
    )
    saved(plugins, text, "disc.py")
    assert run(tmp_path, "calc", plugins) == 3
    err = capfd.readouterr().err
    assert "class Disc: reads its inputs by code of its own (model_post_init)" in err and "Traceback" not in err


# A plugin that never comes back is told with its place by each command, and costs its mechanism alone.


ENDLESS_PLUGIN = """\
from typing import Annotated

from diecut_report.api import Chapter, Drawing, Inputs, Mechanism, Quantity, computed


class Arm(Inputs):
    arm = Quantity("a", "mm", "Arm", gt=0, default=10)


def found(arm):
    return 2 * arm


def drawn(view):
    return []


chapter = Chapter("All")
chapter.reach = computed(found, takes=("arm",), method="a search"), "r", "mm", "Reach"
MECHANISM = Mechanism(
    kind="endless", version="1", title="Arm", summary="", inputs=Arm, chapters=(chapter,),
    figures=(Drawing(id="arm_drawn", title="Arm", caption="The arm.", build=drawn),),
)
"""
ENDLESS_CONFIG = """\
schema_version: 1
project: {title: Endless}
press: {name: P}
mechanisms: {a: {kind: endless}}
"""
LOOP = "while True:\n        pass\n"
PLACES = {
    "at import": ("class Arm(Inputs):", f"if True:\n    {LOOP}\n\nclass Arm(Inputs):"),
    "in plain code": ("    return 2 * arm", f"    {LOOP}"),
    "in a drawing": ("    return []", f"    {LOOP}"),
}
COMMANDS = {
    "calc": ("calc", "press.yaml", "-o", "press.json"),
    "report": ("report", "press.yaml", "-o", "out", "--format", "html"),
    "check": ("check", "press.yaml"),
}


@pytest.mark.usefixtures("without_summary")
@pytest.mark.parametrize("command", few(COMMANDS, lambda command: command == "calc"))
@pytest.mark.parametrize("place", PLACES)
def test_an_endless_loop_is_ended(
    place: str, command: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    old, new = PLACES[place]
    assert ENDLESS_PLUGIN.count(old) == 1
    file = saved(tmp_path, ENDLESS_PLUGIN.replace(old, new), "endless.py")
    saved(tmp_path, ENDLESS_CONFIG, "press.yaml")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(time_limit, "MECHANISM_SECONDS", 0.5)
    assert main([*COMMANDS[command], "--plugins", "."]) == 3
    lines = file.read_text("utf-8").splitlines()
    line = 1 + next(i for i, text in enumerate(lines) if "while True" in text)
    told = capfd.readouterr().err
    assert "it did not come back within 0.5 s; let its loops end" in told
    assert any(f"(endless.py:{each})" in told for each in (line, line + 1)), told


def test_who_waits_already_waits_as_long_as_he_said(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(time_limit, "MECHANISM_SECONDS", 0.05)
    with limited(30), in_time():
        time.sleep(0.2)
    with pytest.raises(TooLong), in_time():
        time.sleep(0.2)


def test_the_alarm_of_a_program_around_rings_in_its_time() -> None:
    rung: list[int] = []
    before = signal.signal(signal.SIGALRM, lambda number, _: rung.append(number))
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.1)
        with in_time():
            pass
        assert 0 < signal.getitimer(signal.ITIMER_REAL)[0] <= 0.1
        time.sleep(0.2)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
    assert rung == [signal.SIGALRM]


# Code of a plugin's inputs that breaks is told as the plugin's fault, and the other mechanisms keep their results.


LEVER = (GOOD / "lever.py").read_text("utf-8")
PRESS = "def turn_for_each_sheet(productivity: Any) -> Any:\n    return 2 * pi * productivity\n"
BREAKING_CONFIG = """\
schema_version: 1
project: {title: Test}
press: {name: P, productivity: 5000 1/h}
mechanisms:
  a: {kind: lever, force: 2 kN, speed: 1 rpm}
  b: {kind: breaking, force: 2 kN}
"""
LISTED = """\
schema_version: 1
project: {title: Test}
press: {name: P}
mechanisms:
  a: {kind: lever, force: 2 kN, speed: 1 rpm}
  b: {kind: lever, force: 2 kN, speed: 1 rpm, load: [1 N*m, "${a.moment}", 1 N*m, 2 N*m]}
  c: {kind: lever, force: 2 kN, speed: 1 rpm, load: "${b.load}"}
"""


def test_what_breaks_gives_3_and_the_results_of_the_others(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    sound, breaking = "@formula\n" + PRESS, PRESS.replace("return", "raise KeyError('nothing')  #")
    assert sound in LEVER
    text = LEVER.replace('kind="lever"', 'kind="breaking"').replace(sound, breaking)
    (tmp_path / "own").mkdir()
    (tmp_path / "own" / "breaking.py").write_text(text, "utf-8")
    (tmp_path / "press.yaml").write_text(BREAKING_CONFIG, "utf-8")
    options = ["--plugins", str(GOOD), "--plugins", str(tmp_path / "own")]
    assert main(["calc", str(tmp_path / "press.yaml"), *options]) == 3
    out, err = capfd.readouterr()
    found = json.loads(out)["mechanisms"]
    assert found["a"]["outputs"]["moment"]["value"] == 200 and found["b"]["status"] == "error"
    assert err.startswith("mechanism 'b' of plugin 'breaking':") and "KeyError: 'nothing' (breaking.py:" in err


def test_a_default_of_an_unknown_field_of_the_press_is_told(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    text = LEVER.replace('kind="lever"', 'kind="breaking"').replace('"press.productivity"', '"press.productivty"')
    (tmp_path / "breaking.py").write_text(text, "utf-8")
    (tmp_path / "press.yaml").write_text(BREAKING_CONFIG, "utf-8")
    assert main(["calc", str(tmp_path / "press.yaml"), "--plugins", str(GOOD), "--plugins", str(tmp_path)]) == 3
    err = capfd.readouterr().err
    assert (
        "input speed: takes press.productivty, which is not a number of the press (did you mean 'press.productivity'?)"
        in err
    )


def test_a_reference_to_a_list_that_holds_references_is_told(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "press.yaml").write_text(LISTED, "utf-8")
    assert main(["calc", str(tmp_path / "press.yaml"), "--plugins", str(GOOD)]) == 2
    err = capfd.readouterr().err
    assert "mechanisms.c.load: ${b.load} is a list that holds references itself (${a.moment})" in err


@pytest.mark.parametrize("unit", ["%", "deg", "rpm", "mm", "1/h"])
def test_a_number_typed_as_its_bound_is_allowed(unit: str) -> None:
    for bound in range(1, 100):
        quantity = Quantity("x", unit, "X", ge=bound, le=bound)
        for given in (bound, f"{bound} {unit}", f"{bound}.0 {unit}"):
            quantity.validate(given)
        with pytest.raises(ValueError, match="out of range"):
            quantity.validate(bound * (1 + 1e-12))
