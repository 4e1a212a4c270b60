"""Plain code that asks the clock, chance, a file or the surroundings gave unlike results for equal inputs, in silence."""

from __future__ import annotations

from pathlib import Path

import pytest

from diecut_report.config.plugins import Discovery
from diecut_report.errors import PluginError
from tests.examples import every

PLUGIN = """\
from __future__ import annotations

from datetime import date, datetime
import os
import random
import sys
import time
from pathlib import Path
from time import perf_counter as ticks

import numpy as np

from diecut_report.api import Chapter, Inputs, Mechanism, Quantity, computed

TABLE = Path(__file__).read_text("utf-8")
{module}


class Arm(Inputs):
    arm = Quantity("a", "mm", "Arm", gt=0, default=10)


def helper(arm):
    {helper}
    return arm


def found(arm):
    {body}
    return helper(arm)


chapter = Chapter("All")
chapter.reach = computed(found, takes=("arm",), method="a search"), "r", "mm", "Reach"
{loop}
MECHANISM = Mechanism(kind="asking", version="1", title="Arm", summary="", inputs=Arm, chapters=(chapter,))
"""
ASKED = {
    "arm = arm * time.time()": "the clock (time.time)",
    "arm = arm * ticks()": "the clock (ticks)",
    "arm = arm * datetime.now().year": "the clock (datetime.now)",
    "arm = arm * date.today().year": "the clock (date.today)",
    "import time as clock; arm = arm * clock.monotonic()": "the clock (clock.monotonic)",
    "from time import time as now; arm = arm * now()": "the clock (now)",
    "arm = arm * np.datetime64('today').astype(float)": "the clock (np.datetime64)",
    "arm = arm * float(np.datetime64('now'))": "the clock (np.datetime64)",
    "import socket; arm = arm * len(socket.gethostname())": "what is around the program (socket.gethostname)",
    "import resource; arm = arm * resource.getpagesize()": "what is around the program (resource.getpagesize)",
    "from email.utils import localtime; arm = arm * localtime().year": "the clock (localtime)",
    "arm = arm * random.random()": "chance (random.random)",
    "arm = arm * random.Random().random()": "chance (random.Random)",
    "arm = arm * np.random.rand()": "chance (np.random.rand)",
    "arm = arm + np.random.default_rng().normal()": "chance (np.random.default_rng)",
    "arm = arm * float(open('n').read())": "a file (open)",
    "arm = arm * float(Path('n').read_text())": "a file (Path('n').read_text)",
    "arm = arm * np.loadtxt('n')": "a file (np.loadtxt)",
    "arm = arm * len(os.environ)": "what is around the program (os.environ)",
    "arm = arm * len(os.listdir('.'))": "what is around the program (os.listdir)",
    "arm = arm * os.getpid()": "what is around the program (os.getpid)",
    "arm = arm * len(sys.argv)": "what is around the program (sys.argv)",
    "arm = arm * Path('n').exists()": "a file (Path('n').exists)",
    "arm = arm * float(Path('n').open().read())": "a file (Path('n').open)",
    "arm = arm * os.path.getmtime('n')": "what is around the program (os.path.getmtime)",
    "import linecache; arm = arm * len(linecache.getline('n', 1))": "a file (linecache.getline)",
    "import threading; arm = arm * threading.get_ident()": "chance (threading.get_ident)",
    "from scipy.stats import norm; arm = arm * norm.rvs()": "chance (norm.rvs)",
    "from scipy.optimize import differential_evolution as seek; arm = seek(abs, [(0, 1)]).fun": "chance (seek)",
    "from scipy.optimize import dual_annealing; arm = dual_annealing(abs, [(0, 1)], seed=None).fun": "chance (dual_annealing)",
    "arm = arm * hash('a')": "chance (hash)",
    "arm = arm * id(arm)": "chance (id)",
    "arm = (lambda: arm * time.time())()": "the clock (time.time)",
}
HELPERS = {
    "of a comprehension": "arm = arm * sum(helper(k) for k in (1,))",
    "of a lambda": "arm = (lambda k: helper(k))(arm)",
    "of a search": "from scipy.optimize import brentq; arm = arm * brentq(lambda x: x - helper(1), 0, 9)",
    "of an own function": "inner = [helper(k) for k in (1, 2)]; arm = arm * inner[0]",
}
KEPT = {
    "a cache": "@cache\ndef table(k):\n    return float(open('n').read())",
    "a memory": "@lru_cache(maxsize=3)\ndef table(k):\n    return float(open('n').read())",
    "a table of functions": "def read(k):\n    return float(open('n').read())\n\n\nWAYS = {'a': read}\ntable = lambda k: WAYS['a'](k)",
}
ENDING = ("os._exit(0)", "os.abort()", "os.kill(os.getppid(), 9)")
LOOPS = {
    "a lambda": 'for k in (1, 2):\n    chapter[f"x{k}"] = computed(lambda arm: k * arm, takes=("arm",), method="m"), f"X_{k}", "mm", "X"',
    "a function": 'for k in (1, 2):\n    def many(arm):\n        return k * arm\n'
    '    chapter[f"x{k}"] = computed(many, takes=("arm",), method="m"), f"X_{k}", "mm", "X"',
    "of several": 'for k, _ in ((1, 2), (2, 3)):\n'
    '    chapter[f"x{k}"] = computed(lambda arm: k * arm, takes=("arm",), method="m"), f"X_{k}", "mm", "X"',
    "in a function": 'def declare():\n    for k in (1, 2):\n'
    '        chapter[f"x{k}"] = computed(lambda arm: k * arm, takes=("arm",), method="m"), f"X_{k}", "mm", "X"\n\n\ndeclare()',
}  # fmt: skip
SOUND_LOOPS = (
    'for k in (1, 2):\n    chapter[f"x{k}"] = computed(partial(many, k), takes=("arm",), method="m"), f"X_{k}", "mm", "X"',
    'for k in (1, 2):\n    chapter[f"x{k}"] = computed(lambda arm: sum(k * arm for k in (1, 2)), takes=("arm",), method="m"), f"X_{k}", "mm", "X"',
)
SOUND = (
    "arm = arm * random.Random(3).random()",
    "arm = arm + 0 * np.random.default_rng(3).normal()",
    "time = arm; arm = time.real",
    "from scipy.optimize import differential_evolution; arm = differential_evolution(abs, [(0, 1)], seed=3).fun",
    "from scipy.stats import norm; arm = arm * norm.rvs(random_state=3)",
    "arm = arm * len(os.path.join('a', 'b'))",
    "arm = arm * len(TABLE)",
    "arm = arm * date(2026, 1, 1).year",
    "id = arm; arm = id.real",
    "arm = arm * np.datetime64('2026-01-01').astype(float)",
    "import subprocess; arm = arm * len(subprocess.check_output('true'))",
)


def judged(folder: Path, **code: str) -> list[str]:
    text = PLUGIN.format(**{"module": "", "loop": "", "helper": "pass", "body": "pass", **code})
    (folder / "asking.py").write_text(text, "utf-8")
    try:
        Discovery([folder]).mechanism("asking")
    except PluginError as error:
        return str(error).splitlines()
    return []


@pytest.mark.parametrize("body", HELPERS)
def test_a_helper_is_followed_out_of_what_stands_within_a_function(body: str, tmp_path: Path) -> None:
    (line,) = judged(tmp_path, body=HELPERS[body], helper="return float(open('n').read())")
    assert "function helper: uses a file (open)" in line


@pytest.mark.parametrize("kept", KEPT)
def test_a_function_is_followed_into_what_keeps_it(kept: str, tmp_path: Path) -> None:
    lines = judged(
        tmp_path, module=f"from functools import cache, lru_cache\n\n\n{KEPT[kept]}", body="arm = arm * table(1)"
    )
    assert any("uses a file (open)" in line for line in lines), lines


@pytest.mark.parametrize("code", ASKED)
@pytest.mark.parametrize("place", every(2, ["body", "helper"]))
def test_what_is_asked_beside_the_inputs_is_told(place: str, code: str, tmp_path: Path) -> None:
    (line,) = judged(tmp_path, **{place: code})
    name = {"body": "found", "helper": "helper"}[place]
    assert (
        f"function {name}: uses {ASKED[code]}, so that equal inputs give different results; take it as an input" in line
    )
    assert "asking.py:2" in line


HIDDEN = """class Finder:
    def __call__(self, arm):
        return arm * time.time()

    def method(self, arm):
        return arm * time.time()

    @staticmethod
    def static(arm):
        return arm * time.time()

    @property
    def now(self):
        return time.time()

    def __hash__(self):
        return hash("finder")


def wrapped(function):
    @functools.wraps(function)
    def inner(arm):
        return function(arm)
    return inner


def plain(arm):
    return arm * time.time()


FINDER = Finder()
"""
CALLED = {
    "an object": ("arm = FINDER(arm)", "FINDER", "__call__"),
    "a method": ("arm = FINDER.method(arm)", "FINDER.method", "method"),
    "a static method": ("arm = Finder.static(arm)", "Finder.static", "static"),
    "a property": ("arm = arm * FINDER.now", "FINDER", "now"),
    "a vectorized function": ("arm = np.vectorize(plain)(arm)", "np.vectorize(plain)", "plain"),
    "a wrapped function": ("arm = wrapped(plain)(arm)", "wrapped(plain)", "plain"),
    "a part of a method": ("arm = FINDER.method(arm)", "functools.partial(FINDER.method)", "method"),
}


@pytest.mark.parametrize("name", CALLED)
def test_code_is_followed_however_it_is_called(name: str, tmp_path: Path) -> None:
    body, function, called = CALLED[name]
    step = f'chapter.x = computed({function}, takes=("arm",), method="m"), "X", "mm", "X"'
    for place, parts in {"named": {"body": body}, "given": {"loop": step}}.items():
        (tmp_path / place).mkdir()
        lines = judged(tmp_path / place, module=f"import functools\n{HIDDEN}", **parts)
        assert any(f"function {called}: uses the clock (time.time)" in line for line in lines), lines
        assert not any("__hash__" in line for line in lines)


def test_what_moves_a_drawing_is_followed(tmp_path: Path) -> None:
    module = "def moved(view, place):\n    return [polyline([(0, time.time())])]\n"
    figure = 'Drawing(id="d", title="D", caption="", build=lambda view: [], moving=moved, over="angle")'
    loop = f"from diecut_report.api import Drawing, polyline\nFIGURES = ({figure},)"
    text = PLUGIN.format(module=module, loop=loop, helper="pass", body="pass").replace(
        "(chapter,))", "(chapter,), figures=FIGURES)"
    )
    (tmp_path / "asking.py").write_text(text, "utf-8")
    with pytest.raises(PluginError, match=r"function moved: uses the clock \(time\.time\)"):
        Discovery([tmp_path]).mechanism("asking")


@pytest.mark.parametrize("code", ENDING)
def test_what_ends_the_program_is_told(code: str, tmp_path: Path) -> None:
    told = judged(tmp_path, body=code)
    assert any(f"function found: ends the whole program ({code.partition('(')[0]})" in line for line in told)


@pytest.mark.parametrize("place", [{"body": "os.chdir('/')"}, {"module": "os.chdir(os.curdir)"}])
def test_what_leaves_the_folder_is_told(place: dict[str, str], tmp_path: Path) -> None:
    """The report would be written elsewhere than is said."""
    (line,) = judged(tmp_path, **place)
    assert "leaves the working folder of the program (os.chdir), so that reports are written elsewhere" in line


@pytest.mark.parametrize("name", LOOPS)
def test_the_number_of_a_loop_in_plain_code_is_told(name: str, tmp_path: Path) -> None:
    """All functions would take the last one, in silence."""
    (line,) = judged(tmp_path, loop=LOOPS[name])
    assert (
        "takes k of the loop around it, which is the last one when it is called; write functools.partial(function, k)"
        in line
    )


@pytest.mark.parametrize("code", SOUND_LOOPS)
def test_the_number_of_a_loop_that_is_given_at_once_passes(code: str, tmp_path: Path) -> None:
    assert (
        judged(tmp_path, module="from functools import partial\n\n\ndef many(k, arm):\n    return k * arm", loop=code)
        == []
    )


@pytest.mark.parametrize("code", SOUND)
def test_what_gives_the_same_each_time_passes(code: str, tmp_path: Path) -> None:
    assert judged(tmp_path, body=code) == []


def test_a_clock_that_is_asked_when_the_module_is_loaded_is_told(tmp_path: Path) -> None:
    (line,) = judged(tmp_path, module="BEGAN = time.time()")
    assert "asking.py:16: function the module: uses the clock (time.time)" in line
