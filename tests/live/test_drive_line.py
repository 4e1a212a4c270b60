"""The drive line on the live page: the views of a machine of parts, whose parts lead to mechanisms of the page."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest

from diecut_report.config.plugins import LIST, Discovery
from diecut_report.errors import UserError
from diecut_report.live.page import Pictures, assets, page_data
from diecut_report.live.session import LiveSession
from diecut_report.text.translation import speaking
from tests.configs import EXAMPLES
from tools.site.api_examples import configuration, example_of

KNIFE = next(path for path in EXAMPLES if path.stem == "circular_knife")


@pytest.fixture(scope="module")
def session(tmp_path_factory: pytest.TempPathFactory) -> LiveSession:
    """The small machine of parts of the reference."""
    folder, example = tmp_path_factory.mktemp("parts"), example_of("Port")
    assert example is not None
    shutil.copy(example.file, folder)
    listed = [f"{kind}: {example.file.name}:{name}\n" for kind, name in example.kinds.items()]
    (folder / LIST).write_text("".join(listed), encoding="utf-8")
    file = folder / "machine.yaml"
    file.write_text(configuration(example), encoding="utf-8")
    return LiveSession(file, Discovery([folder]))


def test_a_part_leads_to_its_calculation_on_the_page(session: LiveSession) -> None:
    assert session.machine is not None
    shown = page_data(session)["machine"]
    names = {each["name"] for each in shown["mechanisms"]}
    assert shown["views"] == ["Drive line, front view", "Shafts of the drive line, side by side"]
    svg = "".join(Pictures().view(session.machine, index)["svg"] for index in (0, 1))
    links = {*re.findall(r'<a href="#([^"]+)"', svg)}
    assert links == {
        "shafts_main", "shafts_main_bearings", "shafts_main_wheel_key", "shafts_main_disc_key", "meshes_drive",
    } and links <= names  # fmt: skip


@pytest.mark.nightly
def test_a_change_on_the_page_changes_the_colour_of_the_part_that_it_overloads(session: LiveSession) -> None:
    def told(name: str) -> str:
        assert session.machine is not None
        found = re.search(rf"<title>{name}: ([^<]*)</title>", Pictures().view(session.machine, 1)["svg"])
        assert found is not None
        return found[1]

    before = told("main.disc.key")
    session.change({"stamp.force": "80 kN"})
    assert session.faults == []
    assert "fail" not in before and told("main.disc.key").endswith(", fail")
    session.take_back()
    assert told("main.disc.key") == before


def test_the_views_speak_the_language_of_the_page(session: LiveSession) -> None:
    with speaking("uk"):
        assert session.machine is not None
        assert page_data(session)["machine"]["views"][0] == "Привод, вигляд спереду"
        assert "не перевірено на міцність" in Pictures().view(session.machine, 0)["svg"]


def test_a_machine_without_parts_has_no_views(tmp_path: Path) -> None:
    file = tmp_path / "knife.yaml"
    file.write_bytes(KNIFE.read_bytes())
    alone = LiveSession(file, Discovery([]))
    assert alone.machine is not None and page_data(alone)["machine"]["views"] == []
    for index in (0, 2):
        with pytest.raises(UserError, match="There is no figure"):
            Pictures().view(alone.machine, index)


def test_a_click_on_a_part_opens_its_calculation() -> None:
    script = assets()["live.js"].content.decode()
    assert re.search(r'byId\("views"\).addEventListener\("click".*?closest\("a"\).*?preventDefault\(\).*?visit\(', script, re.DOTALL)  # fmt: skip
