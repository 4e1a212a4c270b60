"""What a signature shows in its field: who signed, when and why, as outlines, so that no font is needed that the document has not embedded."""

from __future__ import annotations

import re
from collections.abc import Iterator
from datetime import UTC, datetime, timedelta, timezone

from diecut_report.config.yaml import printable
from diecut_report.report.symbols import LINE, MILLIMETRE, drawn, fitted

SMALLEST, LARGEST = 2.5, 8.0  # points of the letters in a field
PAD = 1.0  # points between a field's edge and its letters
LIFTED = 0.3  # of a line: its baseline above its lower edge
MOST_LETTERS = 1000
TIME = re.compile(r"D:(\d{14})(?:Z|([+-])(\d\d)'(\d\d)'?)")


def drawing(name: str, time: datetime, reason: str | None, width: float, height: float) -> bytes:
    """Return the operators that draw who signed, when (UTC) and why, in a field of so many points."""
    told = printable(f"{name}, {time:%Y-%m-%d %H:%M} UTC" + (f", {reason}" if reason else ""))
    room = (width - 2 * PAD) / MILLIMETRE, (height - 2 * PAD) / MILLIMETRE
    lines, size = fitted(told, *room, LARGEST, SMALLEST)
    top = (height + len(lines) * size * LINE) / 2
    return "\n".join(
        f"q {size:.3f} 0 0 {size:.3f} {PAD:.3f} {top - (number + 1 - LIFTED) * size * LINE:.3f} cm {drawn(line)} Q"
        for number, line in enumerate(lines)
    ).encode()


def drawings(name: str, time: str, reason: str | None, width: float, height: float) -> Iterator[bytes]:
    """Give what a signature with these entries may show; ValueError where its time is none. It is drawn before its time is taken."""
    found = TIME.fullmatch(time)
    if found is None or len(name) + len(reason or "") > MOST_LETTERS:
        raise ValueError
    away = timedelta(hours=int(found[3] or 0), minutes=int(found[4] or 0)) * (-1 if found[2] == "-" else 1)
    told = datetime.strptime(found[1], "%Y%m%d%H%M%S").replace(tzinfo=timezone(away)).astimezone(UTC)
    for earlier in (0, 1):
        yield drawing(name, told - timedelta(minutes=earlier), reason, width, height)
