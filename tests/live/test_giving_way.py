"""What the live page's one thread does first: an effect, which takes long, gives way to what a hand waits for."""

from __future__ import annotations

import asyncio
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from httpx import ASGITransport, AsyncClient

from diecut_report.config.discovery import Discovery
from diecut_report.live import application
from diecut_report.live.application import LiveApplication
from diecut_report.live.session import LiveSession
from tests.configs import EXAMPLES

KNIFE = next(path for path in EXAMPLES if path.stem == "circular_knife")


def test_an_effect_gives_way_to_a_change_and_is_made_again_after_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = tmp_path / "knife.yaml"
    file.write_bytes(KNIFE.read_bytes())
    session, began, depths = LiveSession(file, Discovery([])), threading.Event(), []

    def slow(machine: Any, name: str, tell: Callable[[str], None]) -> dict[str, str]:
        depths.append(machine.inputs[name].today)
        began.set()
        while len(depths) == 1:  # the first ends by giving way, or never
            tell("knife")
            time.sleep(0.005)
        return {"input": name}

    monkeypatch.setattr(application, "effect", slow)

    async def asked() -> tuple[int, Any]:
        transport = ASGITransport(LiveApplication(session, (), None).starlette)
        async with AsyncClient(transport=transport, base_url="http://page") as page:
            found = asyncio.create_task(page.get("/effect", params={"input": "knife.depth"}))
            await asyncio.to_thread(began.wait, 20)
            changed = await page.post("/change", json={"changes": {"knife.depth": "111 mm"}})
            return changed.status_code, (await found).json()

    assert asyncio.run(asyncio.wait_for(asked(), 60)) == (200, {"input": "knife.depth"})
    assert depths == [pytest.approx(0.112), pytest.approx(0.111)]
