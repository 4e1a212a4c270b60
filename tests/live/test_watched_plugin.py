"""A plugin that is watched: its chapter in the browser, made anew after each change, with each fault beside its line."""

from __future__ import annotations

import asyncio
import json
import re
import sys
from pathlib import Path

import pytest
from starlette.types import Message

from diecut_report.live.watched_plugin import WatchedPlugin
from diecut_report.testing.scaffold import scaffold

JUDGED = """\
import json, sys
from pathlib import Path

Path(sys.argv[-1]).write_text("<style>b {}</style><h1>Springs</h1>")
print(json.dumps([{"rules": [
    {"status": "fail", "faults": ["springs.py:3: <rate> is wrong", "elsewhere"], "places": ["springs.py:3", ""]},
    {"status": "note", "faults": ["no file", "no line"], "places": ["/*.py:1", "springs.py:99"]},
    {"status": "pass", "faults": [], "places": []},
]}]))
"""


def asked(page: WatchedPlugin, path: str) -> str:
    """What the page gets of an address."""
    told: list[Message] = []

    async def ask() -> None:
        async def receive() -> Message:
            return {"type": "http.request"}

        async def send(message: Message) -> None:
            told.append(message)

        scope = {"type": "http", "method": "GET", "path": path, "headers": [], "query_string": b"", "root_path": ""}
        await page.starlette(scope, receive, send)

    asyncio.run(ask())
    return b"".join(each.get("body", b"") for each in told).decode()


def test_a_fault_stands_beside_its_line_and_the_chapter_below(tmp_path: Path) -> None:
    (tmp_path / "springs.py").write_text("one\ntwo\nrate = <3>\nfour\n")
    page = WatchedPlugin([sys.executable, "-c", JUDGED], tmp_path)
    assert json.loads(asked(page, "/serial")) == [0, True]
    asyncio.run(page.judge())
    assert json.loads(asked(page, "/serial")) == [1, False]
    shown = asked(page, "/")
    assert 'data-serial="1"' in shown and "<style>b {}</style>" in shown and "<h1>Springs</h1>" in shown
    assert "springs.py:3: &lt;rate&gt; is wrong" in shown and "elsewhere" in shown
    assert re.findall(r"<mark>(.*?)</mark>", shown) == ["rate = &lt;3&gt;"]
    assert shown.count("<pre>") == 1 and "location.reload" in asked(page, "/plugin.js")


@pytest.mark.parametrize("program", ["raise SystemExit('no such plugin')", "print('[no such plugin')"])
def test_a_process_that_ends_without_an_answer_is_told_by_what_it_said(program: str, tmp_path: Path) -> None:
    page = WatchedPlugin([sys.executable, "-c", program], tmp_path)
    asyncio.run(page.judge())
    assert "no such plugin" in asked(page, "/")


def test_what_is_begun_for_files_that_are_no_more_is_ended(tmp_path: Path) -> None:
    page = WatchedPlugin([sys.executable, "-c", "import time; time.sleep(60)"], tmp_path)

    async def begun() -> None:
        judging = asyncio.create_task(page.judge())
        await asyncio.sleep(0.2)
        judging.cancel()
        with pytest.raises(asyncio.CancelledError):
            await judging

    asyncio.run(asyncio.wait_for(begun(), 10))
    assert page.serial == 0


@pytest.mark.nightly
def test_a_change_of_a_plugin_is_judged_anew(tmp_path: Path) -> None:
    home = tmp_path / "spring"
    scaffold("spring_pack", home, as_package=False, like="parts")
    command = [sys.executable, "-m", "diecut_report", "check-plugin", str(home), "--format", "json", "--part"]
    page, file = WatchedPlugin(command, home), home / "plugins" / "spring_pack.py"
    asyncio.run(page.judge())
    shown = asked(page, "/")
    assert "all rules hold" in shown and "Springs of an ejector" in shown
    assert (
        shown.count("<body") == shown.count("</html>") == shown.count("<script") == 1
    )  # its own: the chapter is shown without its reader
    text = file.read_text("utf-8")
    assert "travel: rate * (preload + travel)" in text
    file.write_text(text.replace("travel: rate * (preload", "travel: rate + (preload"), "utf-8")
    asyncio.run(page.judge())
    assert "brings together N/m (rate) and m (preload + travel)" in asked(page, "/")
