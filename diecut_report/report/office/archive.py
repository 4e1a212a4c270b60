"""What office files of all kinds need: archives that bear no time, and texts that such a file can hold."""

from __future__ import annotations

import os
import re
from io import BytesIO
from typing import Any
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

_UNHOLDABLE = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff\ufffe\uffff]")  # characters that XML has not


class UndatedArchive(ZipFile):
    """An archive of which no member bears the time: one before 1980 cannot be written, and a clock may be wrong."""

    def __init__(self, file: Any) -> None:
        super().__init__(file, "w", ZIP_DEFLATED, strict_timestamps=False)

    def writestr(
        self,
        zinfo_or_arcname: str | ZipInfo,
        data: Any,
        compress_type: int | None = None,
        compresslevel: int | None = None,
    ) -> None:
        """Write a member, dated as early as can be."""
        member = ZipInfo(zinfo_or_arcname) if isinstance(zinfo_or_arcname, str) else zinfo_or_arcname
        if member is not zinfo_or_arcname:
            member.compress_type, member.external_attr = self.compression, 0o600 << 16
        super().writestr(member, data, compress_type, compresslevel)

    def write(
        self, filename: Any, arcname: Any = None, compress_type: int | None = None, compresslevel: int | None = None
    ) -> None:
        """Write a file as a member, dated as early as can be."""
        os.utime(filename, (0, 0))
        super().write(filename, arcname, compress_type, compresslevel)


def undated(content: bytes) -> bytes:
    """Return an archive with the same members, none of which bears the time."""
    made = BytesIO()
    with ZipFile(BytesIO(content)) as given, UndatedArchive(made) as archive:
        for name in given.namelist():
            archive.writestr(name, given.read(name))
    return made.getvalue()


def holdable(text: str) -> str:
    """Return a text with the characters replaced that XML cannot hold."""
    return _UNHOLDABLE.sub("\N{REPLACEMENT CHARACTER}", text)
