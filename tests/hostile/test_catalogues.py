"""A catalogue beside a plugin of others may hold anything: it is read, or refused in words."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from diecut_report.cli.main import main
from diecut_report.errors import UserError
from diecut_report.text.catalogues import TextCatalogue
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
    "an open translation": (
        TEXT.replace(b'x"', b"x"),
        "line 2 is 'msgstr \"x'; write msgid or msgstr, and a text that begins and ends",
    ),
    "an open text": (TEXT.replace(b'Force"', b"Force"), "line 1 is 'msgid \"Force'"),
    "an open end of lines": (TEXT + b'"y\n', "line 3 is '\"y'"),
    "a quotation mark within": (TEXT.replace(b'"x"', b'"x" y"'), "line 2 is"),
    "no text": (TEXT + b"\nForce\n", "line 4 is 'Force'"),
    "a text twice": (
        TEXT + b'\nmsgid "Force"\nmsgstr "y"\n',
        "line 4 translates 'Force', as line 1 does; keep one of them",
    ),
    "another name": (
        b'msgid "is {force}"\nmsgstr "x {forse}"\n',
        "line 1: the translation of 'is {force}' is filled with {forse}, the text itself with {force}; write the same names",
    ),
    "a name that is lost": (
        b'msgid "is {force}"\nmsgstr "x"\n',
        "is filled with nothing, the text itself with {force}",
    ),
    "two translations of one text": (
        b'msgid "Force"\nmsgstr "F"\nmsgstr "G"\n',
        "line 3 is a second msgstr of one text; keep one of them",
    ),
    "a brace too many": (b'msgid "Force"\nmsgstr "x {."\n', "holds a brace that its text has not; take it away"),
    "a name too many": (b'msgid "Force"\nmsgstr "x {y}"\n', "is filled with {y}, the text itself with nothing"),
    "rounded otherwise": (
        b'msgid "is {force:up}"\nmsgstr "x {force}"\n',
        "is filled with {force}, the text itself with {force:up}",
    ),
    "a name lost in a form": (
        plural("n>1", 2)
        + b'msgid "{n} of {all}"\nmsgid_plural "{n} of {all} all"\nmsgstr[0] "{all}"\nmsgstr[1] "{n} {all}"\n',
        "is filled with {all}, the text itself with {all}, {n}",
    ),
    **{
        f"U+{ord(letter):04X}": (
            head("X: y") + f'msgid "Force"\nmsgstr "{letter}"\n'.encode(),
            f"holds U+{ord(letter):04X}",
        )
        for letter in "\0\x1b\x85\u2028\u202e\u2066"
    },
}


SOUND = {
    "each once": TEXT + b'\nmsgid "is {force}"\nmsgstr "{force} x"\n\n#~ msgid "Force"\n#~ msgstr "z"\n',
    "another context": TEXT + b'\nmsgctxt "c"\nmsgid "Force"\nmsgstr "y"\n',
    "one without its number": plural("n>1", 2)
    + b'msgid "one"\nmsgid_plural "{n} all"\nmsgstr[0] "x"\nmsgstr[1] "{n} x"\n',
    "not translated": b'msgid "is {force}"\nmsgstr ""\n',
    "guessed": b'#, fuzzy\nmsgid "is {force}"\nmsgstr "x"\n',
    "several lines": b'msgid ""\n"is {force}"\nmsgstr "x "\n  "{force} \\"y\\" \\\\"\r\n',
}


@pytest.mark.parametrize("name", SOUND)
def test_what_is_a_catalogue_is_read(name: str, tmp_path: Path) -> None:
    file = tmp_path / "lever.uk.po"
    file.write_bytes(SOUND[name])
    TextCatalogue(file, "uk")


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
