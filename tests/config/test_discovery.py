"""Where kinds come from, that they are loaded only when asked for, and what happens with those that are broken or doubled."""

from __future__ import annotations

import subprocess
import sys
from importlib.metadata import EntryPoint
from pathlib import Path

import pytest

from diecut_report.config import plugins
from diecut_report.config.plugins import Discovery, DuplicateKind, UnknownKind
from diecut_report.errors import PluginError, UserError
from tests.configs import BROKEN, GOOD, LISTED

pytestmark = pytest.mark.wheel


def installed(monkeypatch: pytest.MonkeyPatch, **values: str) -> None:
    """Pretend that other packages announce these kinds."""
    entries = [EntryPoint(name, value, plugins.GROUP) for name, value in values.items()]
    monkeypatch.setattr(plugins, "entry_points", lambda group: [e for e in entries if e.group == group])


def test_the_built_in_kinds_are_known_without_importing_them() -> None:
    code = (
        "import sys; from diecut_report.config.plugins import Discovery; print(sorted(Discovery().origins)); "
        "print([m for m in sys.modules if m.startswith('diecut_report.plugins.')])"
    )
    shown = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.splitlines()
    assert "cylinder_drive" in shown[0] and "cylinder_sizing" in shown[0]
    assert shown[1] == "[]"


@pytest.mark.parametrize("kind", Discovery().origins)
def test_a_built_in_kind_gives_its_mechanism(kind: str) -> None:
    assert Discovery().mechanism(kind).kind == kind


def test_each_file_of_a_folder_is_a_kind() -> None:
    known = Discovery([GOOD])
    assert known.mechanism("lever").kind == "lever"
    assert [origin.label for origin in known.origins["lever"]] == [str(GOOD / "lever.py")]


def test_a_folder_may_list_several_kinds_of_one_file() -> None:
    known = Discovery([LISTED])
    assert (known.mechanism("first_kind").title, known.mechanism("second_kind").title) == ("First", "Second")
    assert "pair" not in known.origins


def test_a_folder_with_an_init_is_a_kind_with_modules_of_its_own(tmp_path: Path) -> None:
    package = tmp_path / "gadget"
    package.mkdir()
    (package / "words.py").write_text("TITLE = 'A gadget'\n")
    (package / "__init__.py").write_text(
        "from diecut_report.api import Inputs, Mechanism\nfrom .words import TITLE\n"
        "MECHANISM = Mechanism(kind='gadget', version='1', title=TITLE, summary='', inputs=Inputs, chapters=())\n"
    )
    assert Discovery([tmp_path]).mechanism("gadget").title == "A gadget"


def project(folder: Path, title: str, name: str = "bar_chain", inner: str = "words") -> Path:
    """A project whose package imports its own modules by its name, as where it is installed."""
    package = folder / "src" / name
    package.mkdir(parents=True)
    (folder / "pyproject.toml").write_text(f"[project.entry-points.'{plugins.GROUP}']\nbar_chain = '{name}'\n")
    (package / "words.py").write_text(f"TITLE = {title!r}\n")
    (package / "__init__.py").write_text(
        f"from diecut_report.api import Inputs, Mechanism\nfrom {name}.{inner} import TITLE\n"
        "MECHANISM = Mechanism(kind='bar_chain', version='1', title=TITLE, summary='', inputs=Inputs, chapters=())\n"
    )
    return folder


def test_a_package_that_is_not_installed_imports_its_modules_by_its_name(tmp_path: Path) -> None:
    """Also where another project has one of the same name."""
    for title in ("First", "Second", "First"):
        folder = tmp_path / title
        folder = folder if folder.is_dir() else project(folder, title)
        assert Discovery([folder]).mechanism("bar_chain").title == title


def test_a_package_that_breaks_is_told_and_leaves_nothing(tmp_path: Path) -> None:
    with pytest.raises(PluginError, match=r"No module named 'bar_chain\.verbs' \(__init__\.py:2\)"):
        Discovery([project(tmp_path, "A", inner="verbs")]).mechanism("bar_chain")
    assert not [name for name in sys.modules if name.startswith("bar_chain")]


@pytest.mark.parametrize("name", ["json", "colorsys", "sys", "this", "pip"])  # the last three are not imported here
def test_a_package_with_the_name_of_another_one_is_refused(tmp_path: Path, name: str) -> None:
    with pytest.raises(PluginError, match=rf"there is another package {name}, .*uninstall it, or give this one"):
        Discovery([project(tmp_path, "A", name=name)]).mechanism("bar_chain")


def test_two_projects_with_a_package_of_one_name_are_refused_together(tmp_path: Path) -> None:
    """A function that imports while it calculates would take the module of the other."""
    folders = [project(tmp_path / title, title) for title in ("First", "Second")]
    with pytest.raises(UserError, match=r"The package bar_chain is in .*First too"):
        Discovery(folders).mechanism("bar_chain")


@pytest.mark.parametrize("after", ["", "sys.path.remove(str(Path(__file__).parent))\n"])
def test_a_helper_found_by_way_of_the_path_is_refused(tmp_path: Path, after: str) -> None:
    """Another plugin with a helper of this name would calculate with this one's."""
    before = list(sys.path)
    (tmp_path / "factors.py").write_text("F = 2\n")
    (tmp_path / "gate.py").write_text(
        "import sys\nfrom pathlib import Path\nsys.path.insert(0, str(Path(__file__).parent))\nimport factors\n" + after
    )
    try:
        with pytest.raises(PluginError, match=r"it imports factors by way of sys\.path, .* make a folder gate/ of it"):
            Discovery([tmp_path]).mechanism("gate")
        assert "factors" not in sys.modules
    finally:
        sys.path[:] = before


def test_a_library_below_the_folder_of_a_plugin_is_no_helper_of_it(tmp_path: Path) -> None:
    """Such as those of an environment that lies beside it."""
    before, libraries = list(sys.path), tmp_path / "env" / "site-packages"
    libraries.mkdir(parents=True)
    (libraries / "factors_of_makers.py").write_text("F = 2\n")
    (tmp_path / "gate.py").write_text("import factors_of_makers\n" + (GOOD / "lever.py").read_text("utf-8").replace(
        "from __future__ import annotations\n", "").replace('kind="lever"', 'kind="gate"'))  # fmt: skip
    sys.path.insert(0, str(libraries))
    try:
        assert Discovery([tmp_path]).mechanism("gate").kind == "gate"
    finally:
        sys.path[:] = before
        sys.modules.pop("factors_of_makers", None)


def test_files_that_begin_with_an_underscore_are_no_kinds(tmp_path: Path) -> None:
    (tmp_path / "_shared.py").write_text("raise RuntimeError\n")
    assert Discovery([tmp_path]).origins.keys() == Discovery().origins.keys()


def test_equal_names_in_two_folders_do_not_get_in_each_others_way(tmp_path: Path) -> None:
    text = (GOOD / "lever.py").read_text("utf-8")
    (tmp_path / "lever.py").write_text(text.replace('title="Lever"', 'title="Another lever"'), "utf-8")
    assert Discovery([GOOD]).mechanism("lever").title == "Lever"
    assert Discovery([tmp_path]).mechanism("lever").title == "Another lever"


def test_an_installed_package_announces_kinds_by_entry_points(monkeypatch: pytest.MonkeyPatch) -> None:
    module = "diecut_report.plugins.cylinder_sizing"
    installed(monkeypatch, again=f"{module}:MECHANISM", short=module)
    for kind in ("again", "short"):
        with pytest.raises(PluginError, match=f"gives the kind 'cylinder_sizing'; name it '{kind}' there"):
            Discovery().mechanism(kind)


def test_a_doubled_kind_names_both_origins_when_it_is_used(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    (tmp_path / "lever.py").write_text("raise RuntimeError('is never run')\n")
    installed(monkeypatch, cylinder_drive="somewhere:MECHANISM")
    known = Discovery([GOOD, tmp_path])
    with pytest.raises(DuplicateKind) as caught:
        known.mechanism("lever")
    both = f"{GOOD / 'lever.py'} and from {tmp_path / 'lever.py'}"
    assert str(caught.value) == f"The kind 'lever' comes from {both}. Remove or rename one of them."
    with pytest.raises(DuplicateKind, match="comes from the program itself and from an installed package"):
        known.mechanism("cylinder_drive")
    assert known.mechanism("cylinder_sizing").kind == "cylinder_sizing"


def test_the_same_folder_twice_is_one_folder() -> None:
    assert Discovery([GOOD, GOOD / ".." / "good"]).mechanism("lever").kind == "lever"


def test_an_unknown_kind_is_told_with_the_nearest() -> None:
    with pytest.raises(UnknownKind, match=r"'cylinder_drives' is not a known kind \(did you mean 'cylinder_drive'\?\)"):
        Discovery().mechanism("cylinder_drives")


BROKEN_KINDS = {
    "breaks_at_import": "ModuleNotFoundError: No module named 'library_that_is_not_there' (breaks_at_import.py:3)",
    "no_mechanism": "gives a dict, where a Mechanism is needed",
    "other_name": "gives the kind 'quite_other'; name it 'other_name' there",
}


@pytest.mark.parametrize("kind", BROKEN_KINDS)
def test_a_broken_plugin_names_its_file_and_the_cause(kind: str) -> None:
    with pytest.raises(PluginError) as caught:
        Discovery([BROKEN]).mechanism(kind)
    assert str(BROKEN / f"{kind}.py") in str(caught.value) and BROKEN_KINDS[kind] in str(caught.value)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("import sys\nsys.exit(1)\n", "SystemExit: 1 (bad.py:2)"),
        ("raise BaseException('no')\n", "BaseException: no (bad.py:1)"),
        ("raise GeneratorExit('no')\n", "GeneratorExit: no (bad.py:1)"),
        ("def f(:\n", "SyntaxError: invalid syntax (bad.py, line 1)"),
        ("x = 1\n", "AttributeError: there is no MECHANISM in it"),
    ],
)
def test_whatever_a_plugin_does_wrong_is_told(tmp_path: Path, text: str, words: str) -> None:
    (tmp_path / "bad.py").write_text(text)
    with pytest.raises(PluginError) as caught:
        Discovery([tmp_path]).mechanism("bad")
    assert words in str(caught.value)
    left = [name for name in sys.modules if name.startswith("diecut_report_local") and name.endswith("_bad")]
    assert text.startswith("x") or not left


def test_a_listed_file_that_is_missing_is_a_broken_plugin(tmp_path: Path) -> None:
    (tmp_path / "kinds.yaml").write_text("lost: lost.py\n")
    with pytest.raises(PluginError, match=r"FileNotFoundError.*lost\.py"):
        Discovery([tmp_path]).mechanism("lost")


def test_a_folder_that_is_not_there_and_a_list_that_is_none_are_told(tmp_path: Path) -> None:
    with pytest.raises(UserError, match="There is no such folder of plugins"):
        _ = Discovery([tmp_path / "nowhere"]).origins
    (tmp_path / "kinds.yaml").write_text("- lever\n")
    with pytest.raises(UserError, match="A list of kinds is needed"):
        _ = Discovery([tmp_path]).origins


def test_an_extension_is_run_once_and_is_no_kind(tmp_path: Path) -> None:
    (tmp_path / "extend_laws.py").write_text("import sys\nsys.laws_seen = getattr(sys, 'laws_seen', 0) + 1\n", "utf-8")
    known = Discovery([tmp_path])
    try:
        known.extend()
        known.extend()
        assert vars(sys)["laws_seen"] == 1 and not any("laws" in kind for kind in known.origins)
    finally:
        vars(sys).pop("laws_seen", None)


def test_an_extension_that_breaks_names_its_package_or_file_and_the_cause(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    entries = [EntryPoint("laws", "no_such_module_of_laws", plugins.EXTENSIONS)]
    monkeypatch.setattr(plugins, "entry_points", lambda group: [e for e in entries if e.group == group])
    template = "This extension cannot be loaded: "
    with pytest.raises(UserError, match=f"laws of an installed package: {template}.*no_such_module"):
        Discovery().extend()
    monkeypatch.setattr(plugins, "entry_points", lambda group: [])
    (tmp_path / "extend_bad.py").write_text("1 / 0\n", "utf-8")
    with pytest.raises(UserError, match=f"extend_bad.py: {template}ZeroDivisionError.*extend_bad.py:1"):
        Discovery([tmp_path]).extend()
