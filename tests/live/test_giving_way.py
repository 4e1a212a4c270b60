"""What the live page's one thread does first: an effect, which takes long, gives way to what a hand waits for."""

from __future__ import annotations

import asyncio
import gc
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from httpx import ASGITransport, AsyncClient

from diecut_report.cli.main import main
from diecut_report.config.loader import load_config
from diecut_report.config.plugins import Discovery
from diecut_report.errors import UserError
from diecut_report.live import server
from diecut_report.live import session as live_session
from diecut_report.live import session as reports
from diecut_report.live.server import LiveApplication
from diecut_report.live.session import LiveSession
from tests.configs import EXAMPLES
from tests.examples import few

KNIFE = next(path for path in EXAMPLES if path.stem == "circular_knife")


def test_a_page_is_told_that_a_saved_file_is_being_calculated(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file = tmp_path / "knife.yaml"
    file.write_bytes(KNIFE.read_bytes())
    session = LiveSession(file, Discovery([]))
    made, read = LiveApplication(session, (), None), session.read
    monkeypatch.setattr(session, "read", lambda: (time.sleep(0.2), read()))

    async def told() -> list[bytes]:
        stream = made._stream()
        found = [await anext(stream)]
        file.write_bytes(KNIFE.read_bytes() + b"\n")
        asking = asyncio.create_task(made._read_where_changed())
        while not found[-1].startswith(b"data: ") or len(found) == 1:
            found.append(await anext(stream))
        await asking
        return found

    found = asyncio.run(asyncio.wait_for(told(), 60))
    assert found[1] == b"event: busy\ndata: 1\n\n" and found[-1].startswith(b"data: ")


def test_a_file_that_is_emptied_and_filled_is_read_when_it_is_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = tmp_path / "knife.yaml"
    file.write_bytes(KNIFE.read_bytes())
    session = LiveSession(file, Discovery([]))
    made, marks, looks = LiveApplication(session, (), None), session.marks, 0

    def filled_at_the_third_look() -> dict[Path, object]:
        nonlocal looks
        if (looks := looks + 1) == 3:
            file.write_bytes(KNIFE.read_bytes() + b"\n")
        return marks()

    file.write_bytes(b"")
    monkeypatch.setattr(session, "marks", filled_at_the_third_look)
    monkeypatch.setattr(server, "SETTLED", 1)
    asyncio.run(asyncio.wait_for(made._read_where_changed(), 60))
    assert looks > 3 and not session.faults


@pytest.mark.nightly
def test_a_table_in_another_folder_is_read_again_when_it_changes(tmp_path: Path) -> None:
    file, table = tmp_path / "knife.yaml", tmp_path / "tables" / "own.yaml"
    table.parent.mkdir()
    table.write_text(
        "source: Works standard 12\ngear_materials: {own: {sigma_h_lim: 1500 MPa, sigma_f_lim: 500 MPa}}\n"
    )
    file.write_text(KNIFE.read_text("utf-8") + "materials: tables/own.yaml\n", "utf-8")
    session = LiveSession(file, Discovery([]))
    made = LiveApplication(session, (), None)

    async def told() -> None:
        async with made.starlette.router.lifespan_context(made.starlette):
            table.write_text("source: [")
            while not session.faults:
                await asyncio.sleep(0.05)

    asyncio.run(asyncio.wait_for(told(), 60))
    assert session.faults[0].file == str(table)


def test_a_plugin_that_never_comes_back_is_told_and_the_page_goes_on(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = tmp_path / "knife.yaml"
    file.write_bytes(KNIFE.read_bytes())
    session = LiveSession(file, Discovery([]))
    made = LiveApplication(session, (), None)
    monkeypatch.setattr(live_session, "MECHANISM_SECONDS", 0.2)

    async def told() -> tuple[int, bytes]:
        with monkeypatch.context() as patch:
            patch.setattr(LiveSession, "_made", endless)
            patch.setattr(server, "effect", endless)
            await made._done(session.read)
            assert session.machine is not None and "did not finish within 0.2 s" in str(session.faults[0].message)
            transport = ASGITransport(made.starlette)
            async with AsyncClient(transport=transport, base_url="http://page") as page:
                answer = await page.get("/effect", params={"input": "knife.depth"})
        await made._done(session.read)
        return answer.status_code, answer.content

    status, content = asyncio.run(asyncio.wait_for(told(), 60))
    assert status == 422 and b"did not finish within 0.2 s" in content and not session.faults


def test_a_report_that_is_never_made_is_given_up(monkeypatch: pytest.MonkeyPatch) -> None:
    config = load_config(KNIFE, Discovery([]))
    monkeypatch.setattr(reports, "REPORT_SECONDS", 0.05)  # an interpreter takes longer to begin
    with pytest.raises(UserError, match=r"not finished within 0\.05 s"):
        asyncio.run(asyncio.wait_for(reports.LiveReports((), None).made(config, "html"), 60))


@pytest.mark.nightly
@pytest.mark.parametrize("named", few([False, True], keep=bool), ids=["alone", "with its table and logo"])
def test_the_report_of_the_page_is_that_of_the_command(tmp_path: Path, named: bool) -> None:
    """Assumed values are tried too, and what the file names lies in a folder below it."""
    file = tmp_path / "my knife.yaml"
    text = KNIFE.read_text("utf-8")
    if named:
        (tmp_path / "pictures").mkdir()
        (tmp_path / "pictures" / "logo.svg").write_text(
            '<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9"><path d="M0 0h9v9z"/></svg>'
        )
        (tmp_path / "pictures" / "steels.yaml").write_text("{}\n")
        text = text.replace("press:", "report: {logo: pictures/logo.svg}\nmaterials: pictures/steels.yaml\npress:", 1)
    file.write_text(text, "utf-8")
    assert main(["report", str(file), "-o", str(tmp_path), "--format", "html", "--quiet"]) == 0
    session = LiveSession(file, Discovery([]))
    assert session.machine is not None, session.faults
    served = asyncio.run(asyncio.wait_for(reports.LiveReports((), None).made(session.machine.config, "html"), 60))
    assert served == file.with_suffix(".html").read_bytes()


@pytest.mark.nightly
def test_full_passes_over_what_stays_do_not_stop_the_page(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    kept = list[int]()
    monkeypatch.setattr(server._Server, "run", lambda *_, **__: kept.append(gc.get_freeze_count()))
    file = tmp_path / "knife.yaml"
    file.write_bytes(KNIFE.read_bytes())
    session = LiveSession(file, Discovery([]))
    before = gc.get_freeze_count()
    server.serve(LiveApplication(session, (), None), 0, lambda _: None)
    assert kept[0] > before


def endless(*_: object) -> None:
    """A plugin that does not come back."""
    while True:
        time.sleep(0.01)


def test_an_effect_gives_way_to_a_change_and_is_made_again_after_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = tmp_path / "knife.yaml"
    file.write_bytes(KNIFE.read_bytes())
    session, began, depths = LiveSession(file, Discovery([])), threading.Event(), []

    def slow(machine: Any, name: str, tell: Callable[[str], None]) -> dict[str, str]:
        depths.append(machine.inputs[name].present)
        began.set()
        while len(depths) == 1:  # the first ends by giving way, or never
            tell("knife")
            time.sleep(0.005)
        return {"input": name}

    monkeypatch.setattr(server, "effect", slow)

    async def asked() -> tuple[int, Any]:
        transport = ASGITransport(LiveApplication(session, (), None).starlette)
        async with AsyncClient(transport=transport, base_url="http://page") as page:
            found = asyncio.create_task(page.get("/effect", params={"input": "knife.depth"}))
            await asyncio.to_thread(began.wait, 20)
            changed = await page.post("/change", json={"changes": {"knife.depth": "111 mm"}})
            return changed.status_code, (await found).json()

    assert asyncio.run(asyncio.wait_for(asked(), 60)) == (200, {"input": "knife.depth"})
    assert depths == [pytest.approx(0.112), pytest.approx(0.111)]
