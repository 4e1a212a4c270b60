"""The server of the live page: who is let in, what is told when the file changes, and how it ends."""

from __future__ import annotations

import asyncio
import gc
import json
import signal
import socket
import stat
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Generator, Iterator
from contextlib import closing
from http.client import HTTPConnection
from pathlib import Path
from threading import Event
from typing import Any, Self
from urllib.parse import urlsplit
from urllib.request import url2pathname

import pytest
from httpx import ASGITransport, AsyncClient

from diecut_report.cli.main import main
from diecut_report.config.loader import load_config
from diecut_report.config.plugins import Discovery
from diecut_report.errors import UserError
from diecut_report.live import server as live_server
from diecut_report.live import session as live_session
from diecut_report.live import session as reports
from diecut_report.live.page import page_data
from diecut_report.live.server import LiveApplication
from diecut_report.live.session import LiveSession
from diecut_report.text.translation import spoken_language
from tests.cli.test_cli import Capture, run
from tests.examples import every, few
from tests.live.conftest import KNIFE

SECONDS = 120


class Server:
    """The command as a process, with its address."""

    def __init__(self, file: Path, *options: str) -> None:
        self.file = file
        command = [sys.executable, "-m", "diecut_report", "live", str(file), "--no-open", "--quiet", *options]
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8")
        assert self.process.stdout is not None
        address = urlsplit(self.process.stdout.readline().strip())
        self.host, self.path = address.netloc, address.path

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        with self.process:  # which closes its pipes and waits
            self.process.kill()

    def asked(self, method: str, path: str, body: object = None, **headers: str) -> tuple[int, str]:
        connection = HTTPConnection(self.host, timeout=SECONDS)
        own = {"Host": self.host} | ({"Origin": f"http://{self.host}"} if method == "POST" else {})
        given = {name.replace("_", "-").title(): value for name, value in headers.items()}
        connection.request(method, path, None if body is None else json.dumps(body), {**own, **given})
        answer = connection.getresponse()
        found = answer.status, answer.read().decode()
        connection.close()
        return found

    def events(self) -> Generator[dict[str, object], None, None]:
        with closing(HTTPConnection(self.host, timeout=SECONDS)) as connection:
            connection.request("GET", f"{self.path}events")
            with connection.getresponse() as answer:
                named, end = False, time.monotonic() + SECONDS
                for line in answer:  # a silent server says now and then that it is there
                    assert time.monotonic() < end, "nothing was told of the machine"
                    if line.startswith(b"data: ") and not named:  # of the machine; others have a name, as "busy"
                        yield json.loads(line[6:])
                        end = time.monotonic() + SECONDS
                    named = line.startswith(b"event: ")


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Server]:
    file = tmp_path_factory.mktemp("live") / "knife.yaml"
    file.write_bytes(KNIFE.read_bytes())
    with Server(file) as made:
        yield made


@pytest.mark.nightly
def test_states_are_kept_undone_saved_and_compared_by_whoever_has_the_secret(file: Path, tmp_path: Path) -> None:
    server = Server(file)
    try:
        own, changed = server.path, {"changes": {"knife.shear_resistance": "50 N/mm**2"}, "stroke": "one"}
        acts = {
            "change": changed, "state/keep": {"name": "soft"}, "undo": {}, "redo": {}, "state/save": {"name": "soft"},
            "state/return": {"name": "soft"},
        }  # fmt: skip
        assert {act: server.asked("POST", f"{own}{act}", body)[0] for act, body in acts.items()} == dict.fromkeys(
            acts, 200
        )
        assert "50 N/mm**2" in (tmp_path / "soft.yaml").read_text("utf-8")
        wrong = [{"name": 3}, {}, [], {"name": ["soft"]}]
        assert {server.asked("POST", f"{own}state/keep", body)[0] for body in wrong} == {400}
        assert server.asked("POST", f"{own}state/rename", {"name": "soft"})[0] == 400
        assert server.asked("POST", f"{own}change", {**changed, "stroke": 3})[0] == 400
        assert server.asked("POST", f"{own}state/keep", {"name": "../soft"})[0] == 422
        assert server.asked("GET", f"{own}state/save?name=soft")[0] == 405
        status, compared = server.asked("GET", f"{own}comparison?state=Initially&state=soft&state=nothing")
        assert status == 200
        assert "knife.shear_resistance" in compared
        assert compared.index('data-machine="Initially"') < compared.index('data-machine="soft"')
        assert server.asked("GET", f"{own}comparison?state=nothing")[0] == 409
        assert sorted(each.name for each in tmp_path.iterdir()) == ["knife.yaml", "soft.yaml"]
    finally:
        server.process.send_signal(signal.SIGINT)
        _, told = server.process.communicate(timeout=SECONDS)
    assert "changed on the page but not saved: knife.shear_resistance: 50 N/mm**2" in told and "Traceback" not in told


def test_only_pages_of_its_own_with_the_secret_are_let_in(server: Server) -> None:
    own = server.path
    assert server.asked("GET", own)[0] == 200
    assert server.asked("GET", "/")[0] == server.asked("GET", f"/{'x' * 32}/")[0] == 404
    assert server.asked("GET", own, host="evil.example")[0] == 421  # a name that leads here from elsewhere
    assert server.asked("GET", f"{own}events", origin="http://evil.example")[0] == 403
    assert server.asked("GET", own, sec_fetch_site="cross-site")[0] == 403
    assert (
        server.asked("GET", own, sec_fetch_site="cross-site", sec_fetch_mode="navigate", sec_fetch_dest="iframe")[0]
        == 403
    )
    assert (
        server.asked("GET", own, sec_fetch_site="cross-site", sec_fetch_mode="navigate", sec_fetch_dest="document")[0]
        == 200
    )
    assert server.asked("POST", f"{own}write", origin="http://evil.example")[0] == 403
    assert server.asked("POST", f"{own}write", origin="null")[0] == 403
    assert server.asked("POST", f"{own}change", {"changes": {"a": "b" * 300_000}})[0] == 413


def test_no_path_of_the_page_is_opened(server: Server) -> None:
    for name in ("../live/live.js", "..%2f..%2fpyproject.toml", "%2Fetc%2Fpasswd", "live.html.j2"):
        assert server.asked("GET", f"{server.path}assets/{name}")[0] == 404
    assert server.asked("GET", f"{server.path}assets/live.js")[0] == 200
    assert server.asked("GET", f"{server.path}figure/..%2f..%2fetc/0")[0] in (404, 422)
    assert server.asked("GET", f"{server.path}figure/knife/{'1' * 5000}")[0] == 404
    assert server.asked("GET", f"{server.path}report/..%2fjson")[0] in (404, 422)


def test_what_is_not_asked_in_the_right_form_is_refused(server: Server) -> None:
    for body in ([], {"changes": []}, {"changes": {"knife.depth": 5}}, "x", None):
        assert server.asked("POST", f"{server.path}change", body)[0] == 400
    status, told = server.asked("POST", f"{server.path}change", {"changes": {"knife.depth": "5 kg"}})
    assert status == 422 and "mass" in json.loads(told)["refused"]


def raw(server: Server, text: bytes) -> socket.socket:
    host, port = server.host.split(":")
    made = socket.create_connection((host, int(port)), timeout=30)
    made.sendall(text)
    return made


def test_a_body_without_a_length_is_bounded_too(server: Server) -> None:
    head = f"POST {server.path}change HTTP/1.1\r\nHost: {server.host}\r\nOrigin: http://{server.host}\r\nTransfer-Encoding: chunked\r\n\r\n"
    taken = 0
    with raw(server, head.encode()) as connection:
        try:
            for _ in range(2000):  # 20 MB, of which a hundredth is allowed
                connection.sendall(b"2710\r\n" + b"x" * 10_000 + b"\r\n")
                taken += 10_000
        except OSError:  # closed, as it should be
            pass
    assert taken < 15_000_000
    assert server.asked("GET", server.path)[0] == 200


@pytest.mark.parametrize("begun", few([b"", b"GET / HTTP/1.1\r\nHost: x\r\nX: "], keep=bool))
@pytest.mark.nightly
def test_a_connection_that_asks_nothing_is_closed(server: Server, begun: bytes) -> None:
    with raw(server, begun) as connection:
        start = time.monotonic()
        assert connection.recv(1000) == b""  # by the server
        assert time.monotonic() - start < 15


def test_tabs_that_close_while_the_file_changes_hold_up_nothing(server: Server) -> None:
    text = server.file.read_text("utf-8")
    with closing(server.events()) as events:
        next(events)
        for count in range(20):
            tabs = [
                raw(server, f"GET {server.path}events HTTP/1.1\r\nHost: {server.host}\r\n\r\n".encode())
                for _ in range(5)
            ]
            server.file.write_text(f"{text}\n# {count}\n", encoding="utf-8")
            time.sleep(0.02)
            for tab in tabs:
                tab.close()
        server.file.write_text(text.replace("friction:", "frictoin:"), encoding="utf-8")
        while not next(events)["faults"]:
            pass
        server.file.write_text(text, encoding="utf-8")
        while next(events)["faults"]:
            pass


def test_each_change_is_told_to_whoever_looks(server: Server) -> None:
    with closing(server.events()) as events:
        _follow(server, events)


def _follow(server: Server, events: Iterator[dict[str, object]]) -> None:
    assert next(events)["faults"] == []
    text = server.file.read_text("utf-8")
    server.file.write_text(text.replace("friction:", "frictoin:"), encoding="utf-8")
    told = next(each for each in events if each["faults"])  # the file may have been looked at just before
    assert "friction" in json.dumps(told["faults"])
    server.file.write_text(text, encoding="utf-8")
    assert next(events)["faults"] == []
    server.asked("POST", f"{server.path}change", {"changes": {"knife.depth": "111 mm"}})
    assert next(events)["edits"] == {"knife.depth": "111 mm"}
    server.asked("POST", f"{server.path}write")
    assert next(events)["edits"] == {} and "111 mm" in server.file.read_text("utf-8")


def test_page_script_numbers_and_refusals_are_in_the_language_that_is_asked_for(file: Path) -> None:
    with Server(file, "--language", "uk") as server:
        _, page = server.asked("GET", server.path)
        with closing(server.events()) as events:
            told = json.dumps(next(events)["machine"], ensure_ascii=False)
        _, refused = server.asked("POST", f"{server.path}change", {"changes": {"knife.depth": "5 kg"}})
    assert '<html lang="uk">' in page and "Записати у файл" in page and "Програма не відповідає" in page
    assert "Рух протягом розрізу" in told and "маса" in json.loads(refused)["refused"]


@pytest.mark.parametrize("ending", every(2, [signal.SIGINT, signal.SIGTERM]))
def test_it_tells_what_is_not_written_when_it_is_ended(file: Path, ending: signal.Signals) -> None:
    server = Server(file)
    with closing(server.events()) as events:
        next(events)
        server.asked("POST", f"{server.path}change", {"changes": {"knife.depth": "111 mm"}})
        server.process.send_signal(ending)
        _, told = server.process.communicate(timeout=SECONDS)
    assert (server.process.returncode, told) == (0, "changed on the page but not saved: knife.depth: 111 mm\n")


def test_a_port_in_use_and_a_file_that_is_none_end_with_words(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    with socket.socket() as other:
        other.bind(("127.0.0.1", 0))
        other.listen()
        port = other.getsockname()[1]
        assert main(["live", str(KNIFE), "--port", str(port), "--no-open"]) == 2
    assert f"Port {port} of this machine is not available: another program is using it" in capfd.readouterr().err
    stored = f"{tmp_path}#17"
    for given, words in ((str(tmp_path), "This is a folder."), (str(tmp_path / "none.yaml"), "There is no such file."),
                         ("-", "standard input is read only once"), (stored, f"diecut-report take {stored} -o my_press.yaml")):  # fmt: skip
        assert main(["live", given, "--no-open"]) == 2
        assert words in capfd.readouterr().err


# The command of the live page: what it refuses before it serves, and the language of its page.


STUDIES = sorted(KNIFE.parent.glob("*_study.yaml"))


@pytest.mark.parametrize("study", STUDIES, ids=lambda path: path.stem)
def test_a_study_ends_it_at_once_with_what_to_give(study: Path, capfd: Capture) -> None:
    assert run("live", study, "--no-open") == 2
    told = capfd.readouterr()
    command = "optimise" if "knife" in study.stem else "batch"
    assert (
        f"This is a study: calculate it with diecut-report {command} {study}, or give its base, {study.parent}"
        in told.err
    )
    assert told.out == ""


def test_the_address_stands_on_no_command_line_and_the_page_waits_for_no_browser(
    file: Path, monkeypatch: pytest.MonkeyPatch, capfd: Capture
) -> None:
    opened: list[str] = []
    address, is_opened, is_closed = "http://127.0.0.1:1/secret/", Event(), Event()

    def browser(url: str) -> bool:
        opened.append(url)
        is_opened.set()
        assert is_closed.wait(20), (
            "the page waits for the browser"
        )  # which comes back when it is closed, as one in a terminal does
        return True

    def serve(_application: object, _port: int, ready: Callable[[str], None]) -> None:
        ready(address)
        assert is_opened.wait(60) and not is_closed.is_set()
        is_closed.set()
        page = Path(url2pathname(urlsplit(opened[0]).path))
        assert stat.S_IMODE(page.stat().st_mode) == 0o600 and address in page.read_text("utf-8")

    monkeypatch.setattr("webbrowser.open", browser)
    monkeypatch.setattr("diecut_report.live.server.serve", serve)
    assert run("live", file) == 0
    assert "secret" not in opened[0] and opened[0].startswith("file:")
    assert not Path(url2pathname(urlsplit(opened[0]).path)).exists()


@pytest.mark.parametrize(
    ("given", "options", "language"),
    [("uk", (), "uk"), ("uk", ("--language", "en"), "en"), ("en", ("--language", "uk"), "uk"), ("en", (), "en")],
)
def test_the_page_has_the_language_that_is_asked_for_else_that_of_the_project(
    given: str, options: tuple[str, ...], language: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = tmp_path / "knife.yaml"
    file.write_text(KNIFE.read_text("utf-8").replace("language: en", f"language: {given}"), "utf-8")
    found: list[str] = []

    def serve(application: LiveApplication, *_: object) -> None:
        found.extend((spoken_language(), json.dumps(page_data(application.session), ensure_ascii=False)))

    monkeypatch.setattr("diecut_report.live.server.serve", serve)
    assert run("live", file, "--no-open", "--quiet", *options) == 0
    assert found[0] == language
    assert ("Тривалість розрізу" in found[1]) == (language == "uk")
    assert ("Time of the cut" in found[1]) == (language == "en")


@pytest.mark.nightly
def test_a_view_that_is_not_there_is_refused(server: Server) -> None:
    assert server.asked("GET", f"{server.path}view/0")[0] == 422
    for odd in ("x", "-1", "1e3", "0/1", "9" * 10):
        assert server.asked("GET", f"{server.path}view/{odd}")[0] == 404


# What the live page's one thread does first: an effect, which takes long, gives way to what a hand waits for.


def test_a_page_is_told_that_a_saved_file_is_being_calculated(
    file: Path, session: LiveSession, monkeypatch: pytest.MonkeyPatch
) -> None:
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
    file: Path, session: LiveSession, monkeypatch: pytest.MonkeyPatch
) -> None:
    made, marks, looks = LiveApplication(session, (), None), session.marks, 0

    def filled_at_the_third_look() -> dict[Path, object]:
        nonlocal looks
        if (looks := looks + 1) == 3:
            file.write_bytes(KNIFE.read_bytes() + b"\n")
        return marks()

    file.write_bytes(b"")
    monkeypatch.setattr(session, "marks", filled_at_the_third_look)
    monkeypatch.setattr(live_server, "SETTLED", 1)
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
    session: LiveSession, monkeypatch: pytest.MonkeyPatch
) -> None:
    made = LiveApplication(session, (), None)
    monkeypatch.setattr(live_session, "MECHANISM_SECONDS", 0.2)

    async def told() -> tuple[int, bytes]:
        with monkeypatch.context() as patch:
            patch.setattr(LiveSession, "_made", endless)
            patch.setattr(live_server, "effect", endless)
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
def test_full_passes_over_what_stays_do_not_stop_the_page(
    session: LiveSession, monkeypatch: pytest.MonkeyPatch
) -> None:
    kept = list[int]()
    monkeypatch.setattr(live_server._Server, "run", lambda *_, **__: kept.append(gc.get_freeze_count()))
    before = gc.get_freeze_count()
    live_server.serve(LiveApplication(session, (), None), 0, lambda _: None)
    assert kept[0] > before


def endless(*_: object) -> None:
    """A plugin that does not come back."""
    while True:
        time.sleep(0.01)


def test_an_effect_gives_way_to_a_change_and_is_made_again_after_it(
    file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    session, began, depths = LiveSession(file, Discovery([])), threading.Event(), []

    def slow(machine: Any, name: str, tell: Callable[[str], None]) -> dict[str, str]:
        depths.append(machine.inputs[name].present)
        began.set()
        while len(depths) == 1:  # the first ends by giving way, or never
            tell("knife")
            time.sleep(0.005)
        return {"input": name}

    monkeypatch.setattr(live_server, "effect", slow)

    async def asked() -> tuple[int, Any]:
        transport = ASGITransport(LiveApplication(session, (), None).starlette)
        async with AsyncClient(transport=transport, base_url="http://page") as page:
            found = asyncio.create_task(page.get("/effect", params={"input": "knife.depth"}))
            await asyncio.to_thread(began.wait, 20)
            changed = await page.post("/change", json={"changes": {"knife.depth": "111 mm"}})
            return changed.status_code, (await found).json()

    assert asyncio.run(asyncio.wait_for(asked(), 60)) == (200, {"input": "knife.depth"})
    assert depths == [pytest.approx(0.112), pytest.approx(0.111)]
