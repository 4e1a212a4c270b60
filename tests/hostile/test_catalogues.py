"""A catalogue beside a plugin of others may hold anything: it is read, or refused in words."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from diecut_report.cli.main import main
from diecut_report.errors import UserError
from diecut_report.languages.catalogues import TextCatalogue
from tests.configs import GOOD, LEVER, saved

TEXT = b'msgid "Force"\nmsgstr "x"\n'


def head(line: str) -> bytes:
    """The head of a catalogue with a line of its own."""
    return f'msgid ""\nmsgstr ""\n"Content-Type: text/plain; charset=utf-8\\n"\n"{line}\\n"\n\n'.encode()


def plural(form: str, count: int = 3) -> bytes:
    """A catalogue whose forms of words for numbers are chosen so."""
    return head(f"Plural-Forms: nplurals={count}; plural={form};") + TEXT


FAULTS = {
    "bytes": (b"\0\xff\xfe", "can't decode byte 0xff"),
    "letters": (head("X: y") + b'msgid "Force"\nmsgstr "\xff"\n', "can't decode byte 0xff"),
    "by nothing": (plural("n/0"), "by zero"),
    "code": (plural("__import__('os').abort()"), "invalid token in plural form: __import__"),
    "brackets": (plural("(" * 500 + "n" + ")" * 500), "too long"),
    "below": (plural("0-9"), "have none for 0"),
    "above": (plural("n"), "have none for 3"),
    "forms": (plural("n", 10**11), "at most 10 forms"),
    "encoding": (b'msgid ""\nmsgstr ""\n"Content-Type: text/plain; charset=xyz\\n"\n\n' + TEXT, "unknown encoding"),
    "clock": (head("PO-Revision-Date: 99999-99-99 99:99+9999") + TEXT, "does not match format"),
    "language": (head("Language: ../../x") + TEXT, "expected only letters"),
    "many forms": (plural("0") + b'msgid "a"\nmsgid_plural "b"\nmsgstr[999999999] "c"\n', "more translations than"),
    **{
        f"U+{ord(letter):04X}": (
            head("X: y") + f'msgid "Force"\nmsgstr "{letter}"\n'.encode(),
            f"holds U+{ord(letter):04X}",
        )
        for letter in "\0\x1b\x85\u2028\u202e\u2066"
    },
}


@pytest.mark.parametrize("name", FAULTS)
def test_what_is_no_catalogue_is_told(name: str, tmp_path: Path) -> None:
    content, words = FAULTS[name]
    file = tmp_path / "lever.uk.po"
    file.write_bytes(content)
    with pytest.raises(UserError) as error:
        TextCatalogue(file, "uk")
    assert str(error.value).startswith(f"{file}: This catalogue of texts cannot be read: ") and words in str(
        error.value
    )


def test_a_report_is_refused_with_the_name_of_the_file(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    shutil.copy(GOOD / "lever.py", tmp_path)
    (tmp_path / "lever.uk.po").write_bytes(FAULTS["code"][0])
    config, out = saved(tmp_path, LEVER), tmp_path / "out"
    asked = ["report", config, "-o", out, "--format", "html", "--language", "uk", "--plugins", tmp_path]
    assert main(list(map(str, asked))) == 2
    assert f"{tmp_path / 'lever.uk.po'}: Цей каталог" in capfd.readouterr().err and not out.exists()
