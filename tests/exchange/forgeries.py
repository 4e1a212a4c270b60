"""The known ways of changing a report, each with the line of ``verify`` that finds it.

They are tried by ``test_forgeries`` and listed in docs/trust.md, which ``python -m tests.exchange.forgeries`` writes anew.
"""

from __future__ import annotations

import io
import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pikepdf
from pyhanko.pdf_utils.generic import DictionaryObject, NameObject, NumberObject

from diecut_report.exchange.signatures import Additions
from diecut_report.text.phrases import message_data
from tests.exchange.reports import added_at, removed_at, saved_pdf, set_at

Data = dict[str, Any]
TRUST = Path(__file__).parents[2] / "docs" / "trust.md"
BEGIN, END = "<!-- forgeries: written by python -m tests.exchange.forgeries -->", "<!-- end of forgeries -->"


@dataclass(frozen=True)
class Forgery:
    """A way of changing a report: in words, what it does, and the line of ``verify`` that finds it."""

    way: str
    change: Callable[[Any], Any]
    line: str


# --- results that a report carries, its pages made again of them by this program -----------------------------------------


def other_text(data: Data) -> None:
    """The text of a sentence in another language: its template, of which the translation is made."""
    check = data["mechanisms"]["knife"]["checks"][0]
    check["message"]["values"]["bounds:capital"]["values"]["first"] = "30.2 mm"


def without_check(data: Data) -> None:
    checks = data["mechanisms"]["knife"]["checks"]
    checks[:] = [check for check in checks if check["id"] != "torque"]


def curve_value(data: Data) -> None:
    curve = next(curve for curve in data["mechanisms"]["knife"]["curves"].values() if "abscissa" in curve)
    curve["values"][3] += 1.0


def printed_step(data: Data) -> None:
    section = data["mechanisms"]["knife"]["sections"][0]
    item = next(item for item in section["items"] if item.get("source"))
    item["source"] = "ISO 1"


def of_config(data: Data) -> None:
    data["config"]["source_text"] = data["config"]["source_text"].replace("1 N*m", "9 N*m")


def of_former(data: Data) -> None:
    data["former"]["source_text"] = data["former"]["source_text"].replace("20 mm", "21 mm")


NUMBERS = "✗ numbers"
REFUSED = "is not what stands there in results"
OF_RESULTS = (
    Forgery("the configuration that it carries", of_config, "✗ configuration"),
    Forgery("a number, as results", set_at("mechanisms/knife/outputs/torque_max/value", 0.9), NUMBERS),
    Forgery("a number, as it is printed alone", set_at("mechanisms/knife/outputs/torque_max/display/text", "0.9"), NUMBERS),
    Forgery("the unit of a number", set_at("mechanisms/knife/outputs/torque_max/display/unit", "kN·m"), NUMBERS),
    Forgery("a sentence, in the language of the report alone (its values)", other_text, REFUSED),
    Forgery("the verdict of a check", set_at("mechanisms/knife/checks/0/status", "warn"), NUMBERS),
    Forgery("a check, left out", without_check, REFUSED),
    Forgery("the verdict on the machine", set_at("status", "pass"), NUMBERS),
    Forgery("the counts of page 1", set_at("summary/fail", 0), NUMBERS),
    Forgery("the first line of page 1", set_at("summary/conclusion", message_data("All checks pass.")), NUMBERS),
    Forgery("what is assumed, left out of page 1", set_at("summary/assumed", []), NUMBERS),
    Forgery("what is open, left out (`summary.open`)", removed_at("summary", "open"), NUMBERS),
    Forgery("the verdict (`summary.verdict`)", set_at("summary/verdict", "pass"), NUMBERS),
    Forgery("what comes of the advice (`summary.advice`)", added_at("summary", "advice", {"changes": [], "failing": [], "error": None}), NUMBERS),
    Forgery("the influence of the inputs", set_at("influence/tornados", []), NUMBERS),
    Forgery("the influence of the inputs, left out", removed_at("", "influence"), NUMBERS),
    Forgery("the status of the document (draft, released)", set_at("report/status", "released"), NUMBERS),
    Forgery("the frame of its sheets", set_at("report/frame", "plain"), NUMBERS),
    Forgery("the units in which it shows numbers", set_at("report/units", {"length": "m"}), NUMBERS),
    Forgery("the title block", set_at("project/document_number", "D-2"), NUMBERS),
    Forgery("who prepared it", set_at("project/prepared_by", "Another designer"), NUMBERS),
    Forgery("the changes since the former revision, left out", removed_at("", "changes"), NUMBERS),
    Forgery("the former revision that it names", of_former, "✗ options"),
    Forgery("a value of a curve", curve_value, NUMBERS),
    Forgery("the title of a figure", set_at("mechanisms/knife/figures/0/title", "Another figure"), NUMBERS),
    Forgery("the source of a formula", printed_step, NUMBERS),
    Forgery("the basis of an input", set_at("mechanisms/knife/inputs/friction/basis", "measured"), NUMBERS),
    Forgery("that a plugin was found faulty (`plugin_check`)", added_at("mechanisms/knife", "plugin_check", "passed"), NUMBERS),
    Forgery("the version of the program", set_at("program/version", "0.9.0"), "✗ program"),
    Forgery("the source of the program", set_at("program/source_sha256", 64 * "0"), "✗ program"),
    Forgery("the source of a plugin", set_at("mechanisms/knife/plugin_sha256", 64 * "0"), "✗ plugins"),
    Forgery("that it was set with templates of a firm (`template_sha256`)", added_at("report", "template_sha256", 64 * "a"), "✗ pages"),
)  # fmt: skip


def without_changes(data: Data) -> None:
    del data["changes"], data["former"]


def in_another_file(data: Data) -> None:
    without_changes(data)
    data["config"]["file"] = "other.yaml"


OF_OPTIONS = (
    Forgery("its language (`--language`)", set_at("project/language", "en"), "✓ options        made with --language en "),
    Forgery("how much it shows (`--detail`)", set_at("report/detail", "brief"), "✓ options        made with --detail brief "),
    Forgery("which mechanisms alone it shows (`--only`)", added_at("report", "only", ["knife"]), "✓ options        made with --only knife "),
    Forgery("that it shows the changes since a former revision (`--previous`)", without_changes, "✓ options        none: "),
    Forgery("the name of the configuration's file, not what stands in it", in_another_file, "✓ configuration  other.yaml, SHA-256 "),
    Forgery("the version of a library that it names", set_at("program/libraries/NumPy", "9.9"), "the same; NumPy 9.9 then, "),
)  # fmt: skip
"""What may be chosen for a report beside its configuration: another choice is told, and is no fault."""


# --- pages that show something else than the results which they carry ---------------------------------------------------


def _replaced(old: bytes, new: bytes) -> Callable[[bytes], bytes]:
    def change(page: bytes) -> bytes:
        assert old in page, old
        return page.replace(old, new, 1)

    return change


PAGES = "✗ pages"
OF_PAGE = (
    Forgery("a number of the page", lambda page: re.sub(rb">2[.,]213<", b">0,913<", page, count=1), PAGES),
    Forgery("a style that hides or replaces text", _replaced(b"</style>", b".fail{display:none}</style>"), PAGES),
    Forgery("a script", _replaced(b"</body>", b"<script>document.title=''</script></body>"), PAGES),
    Forgery("a picture", _replaced(b"<svg ", b'<svg opacity="0" '), PAGES),
    Forgery("the policy that keeps it from loading anything", _replaced(b"default-src", b"default-data"), PAGES),
    Forgery("something behind its end", lambda page: page + b"<p>released</p>", PAGES),
    Forgery("other results beside its own", lambda page: page + page, "two results"),
)


# --- what is added to a PDF, or changed in it ------------------------------------------------------------------------------


def later(content: bytes, change: Callable[[Any], Any]) -> bytes:
    """Return a PDF with a later version of an object of it, as a program adds that."""
    writer = Additions(io.BytesIO(content))
    writer.update_container(change(writer.root))
    made = io.BytesIO()
    writer.write(made)
    return made.getvalue()


def added(change: Callable[[Any], Any]) -> Callable[[bytes], bytes]:
    return lambda content: later(content, change)


def painted(root: Any) -> Any:
    """The first sheet with other contents."""
    sheet = root["/Pages"]["/Kids"][0]
    while "/Kids" in sheet:
        sheet = sheet["/Kids"][0]
    return _written(sheet["/Contents"], b"1 1 1 rg 0 0 999 999 re f")


def _written(stream: Any, data: bytes) -> Any:
    """A stream with other contents."""
    stream._data, stream._encoded_data = data, None
    return stream


def turned(root: Any) -> Any:
    sheet = root["/Pages"]["/Kids"][0]
    sheet["/Rotate"] = NumberObject(90)
    return sheet


def turned_together(root: Any) -> Any:
    """The list of the sheets, whose turning all of them inherit."""
    root["/Pages"][NameObject("/Rotate")] = NumberObject(90)
    return root["/Pages"]


def cropped(root: Any) -> Any:
    sheet = root["/Pages"]["/Kids"][0]
    sheet["/MediaBox"][3] = NumberObject(300)
    return sheet


def without_sheet(root: Any) -> Any:
    root["/Pages"]["/Kids"].pop()
    return root["/Pages"]


def with_other_results(root: Any) -> Any:
    return _written(root["/Names"]["/EmbeddedFiles"]["/Names"][3]["/EF"]["/F"], b"{}")


def moved_field(root: Any) -> Any:
    field = root["/AcroForm"]["/Fields"][0]
    field["/Rect"][0] = NumberObject(0)
    return field


def filled_field(root: Any) -> Any:
    field = root["/AcroForm"]["/Fields"][0]
    field["/V"] = DictionaryObject({NameObject("/Type"): NameObject("/Sig")})
    return field


def with_action(root: Any) -> Any:
    root["/OpenAction"] = DictionaryObject({NameObject("/S"): NameObject("/JavaScript")})
    return root


def other_letters(root: Any) -> Any:
    """Letters of a font that read as others where they are copied or searched."""
    sheet = root["/Pages"]["/Kids"][0]
    return _written(next(iter(sheet["/Resources"]["/Font"].values())).get_object()["/ToUnicode"], b"begincmap endcmap")


def annotated(content: bytes) -> bytes:
    """A note over the first sheet, saved by another program."""
    with pikepdf.open(io.BytesIO(content)) as pdf:
        note = pikepdf.Dictionary(
            Type=pikepdf.Name.Annot, Subtype=pikepdf.Name.FreeText, Rect=[0, 0, 99, 99], Contents="pass"
        )
        pdf.pages[0].obj.Annots = pikepdf.Array([*pdf.pages[0].obj.get("/Annots", []), pdf.make_indirect(note)])
        return saved_pdf(pdf)


def saved_again(content: bytes) -> bytes:
    with pikepdf.open(io.BytesIO(content)) as pdf:
        return saved_pdf(pdf)


def with_second_results(content: bytes) -> bytes:
    """Another file of the name results.json, which some readers show in the place of the first."""
    with pikepdf.open(io.BytesIO(content)) as pdf:
        names = pdf.Root.Names.EmbeddedFiles.Names
        stream = pdf.make_stream(b"{}")
        label = pikepdf.String("results.json")
        spec = pikepdf.Dictionary(Type=pikepdf.Name("/Filespec"), F=label, UF=label, EF=pikepdf.Dictionary(F=stream))
        names.extend([label, pdf.make_indirect(spec)])
        return saved_pdf(pdf)


def with_two_contents(content: bytes) -> bytes:
    """The first sheet written again, with contents twice: a reader shows the first of them or the last."""
    with pikepdf.open(io.BytesIO(content)) as pdf:
        sheet, size, root = pdf.pages[0].obj, int(pdf.trailer.Size), pdf.Root.objgen[0]
        number, written = sheet.objgen[0], sheet.unparse(resolved=True).removeprefix(b"<<")
    data = b"1 1 1 rg 0 0 999 999 re f"
    first = b"\n%d 0 obj\n<< /Contents %d 0 R%s\nendobj\n" % (number, size, written)
    second = b"%d 0 obj\n<< /Length %d >>\nstream\n%s\nendstream\nendobj\n" % (size, len(data), data)
    places = len(content) + 1, len(content) + len(first)
    table = b"xref\n%d 1\n%010d 00000 n \n%d 1\n%010d 00000 n \n" % (number, places[0], size, places[1])
    previous = re.findall(rb"startxref\s+(\d+)", content)[-1]
    trailer = b"trailer\n<< /Size %d /Root %d 0 R /Prev %s >>" % (size + 1, root, previous)
    end = b"\nstartxref\n%d\n%%%%EOF\n" % (places[1] + len(second))
    return content + first + second + table + trailer + end


def _hidden(content: bytes, table: str) -> bytes:
    """The contents of the first sheet, painted over, behind the end, and a table that tells where those of before are.

    ``{first}`` stands there, ``{later}`` where the others are, ``{number}`` is what both are called.
    """
    with pikepdf.open(io.BytesIO(content)) as pdf:
        number, size, root = pdf.pages[0].obj.Contents.objgen[0], int(pdf.trailer.Size), pdf.Root.objgen[0]
    data = b"1 1 1 rg 0 0 999 999 re f"
    later = b"\n%d 0 obj\n<< /Length %d >>\nstream\n%s\nendstream\nendobj\n" % (number, len(data), data)
    begins = re.search(rb"(?<=\n)%d 0 obj" % number, content)
    assert begins
    told = table.format(number=number, first=f"{begins.start():010d} 00000 n", later=f"{len(content) + 1:010d} 00000 n")
    previous = re.findall(rb"startxref\s+(\d+)", content)[-1]
    trailer = b"trailer\n<< /Size %d /Root %d 0 R /Prev %s >>" % (size, root, previous)
    end = b"\nstartxref\n%d\n%%%%EOF\n" % (len(content) + len(later))
    return content + later + told.encode() + trailer + end


def told_by(table: str) -> Callable[[bytes], bytes]:
    return lambda content: _hidden(content, table)


OF_PDF = (
    Forgery("what a sheet shows, painted over", added(painted), PAGES),
    Forgery("contents of a sheet that only some readers show", with_two_contents, PAGES),
    Forgery("contents of a sheet that the table of objects names twice: some programs show the first, some the last",
            told_by("xref\n{number} 1\n{first} \n{number} 1\n{later} \n"), PAGES),
    Forgery("the same, in a table that some programs do not take, and search the file instead",
            told_by("xref\n{number} 1\n{first}\n"), PAGES),
    Forgery("the same, which no table names", told_by("xref\n0 1\n0000000000 65535 f \n"), PAGES),
    Forgery("a sheet, turned", added(turned), PAGES),
    Forgery("all sheets, turned in their list", added(turned_together), PAGES),
    Forgery("a sheet, cut smaller", added(cropped), PAGES),
    Forgery("a sheet, taken out", added(without_sheet), PAGES),
    Forgery("letters that are copied and found as others", added(other_letters), PAGES),
    Forgery("an action that runs when it is opened", added(with_action), PAGES),
    Forgery("a signature field, moved", added(moved_field), PAGES),
    Forgery("a signature field, filled without a signature", added(filled_field), PAGES),
    Forgery("a note upon a sheet", annotated, PAGES),
    Forgery("saved by another program, all else alike", saved_again, PAGES),
    Forgery("something behind its end", lambda content: content + b"\n% more\n%%EOF\n", PAGES),
    Forgery("the results that are attached", added(with_other_results), "refused"),
    Forgery("a second results file, attached", with_second_results, "refused"),
)  # fmt: skip


# --- what a signature adds, by hand: the revision behind the end of a PDF --------------------------------------------------

DRAWING = b"/Type /XObject /Subtype /Form /BBox [0 0 9 9]"
OVER = b"1 1 1 rg -999 -999 9999 9999 re f"
SIGNATURE = b"<< /Type /Sig /ByteRange [0 0 0 0] /Contents <00> >>"
START = b"startxref\n%d\n%%%%EOF\n"


def _stream(data: bytes, told: bytes = b"") -> bytes:
    return b"<< /Length %d %b >>\nstream\n%b\nendstream" % (len(data), told, data)


class _Report:
    """The objects of a report that forgeries change."""

    def __init__(self, content: bytes) -> None:
        with pikepdf.open(io.BytesIO(content)) as pdf:
            field, sheet = pdf.Root.AcroForm.Fields[0], pdf.pages[0].obj
            self.content, self.size = content, int(pdf.trailer.Size)
            self.value = self.size + 2  # the number of the signature
            self.named = b"/Root %d 0 R /Info %d 0 R" % (pdf.Root.objgen[0], pdf.trailer.Info.objgen[0])
            self.field, self.sheet = field.objgen[0], sheet.objgen[0]
            self.number_of_root, self.root = pdf.Root.objgen[0], pdf.Root.unparse(resolved=True)
            self.contents, self.painted = sheet.Contents.objgen[0], _stream(OVER)
            self.written = _stream(sheet.Contents.read_raw_bytes(), b"/Filter /FlateDecode")
            former, signature = field.unparse(resolved=True).removesuffix(b">>"), b"/V %d 0 R >>" % self.value
            self.signed = re.sub(rb"/AP <<[^>]*>>", b"", former) + signature
            self.shown = re.sub(rb"(?<=/N )\d+ 0 R", b"%d 0 R" % self.size, former) + signature
            self.as_it_was, second = sheet.unparse(resolved=True), pdf.Root.AcroForm.Fields[1]
            self.second = second.objgen[0]
            self.signed_too = second.unparse(resolved=True).removesuffix(b">>") + signature
            self.annotated = re.sub(rb"/Annots \[[^]]*", rb"\g<0> %d 0 R " % (self.size + 1), self.as_it_was)
        self.former = int(re.findall(rb"startxref\s+(\d+)", content)[-1])

    def revision(
        self, objects: dict[int, bytes] | None = None, *, drawing: bytes = b"", hidden: bytes = b"", told: bytes = b"",
        start: bytes = START, packed: bytes = b"", over: bytes = OVER, more: bytes = b"",
    ) -> bytes:  # fmt: skip
        """The report with its first field signed, these objects, some that no table names, and more that the table tells.

        With ``packed`` a stream of objects, of which that says more, holds the first sheet as it was.
        """
        head, holder = b"%d 0 " % self.sheet, self.size + 1
        if packed:
            told_of_it = b"/Type /ObjStm /N 1 /First %d %b" % (len(head), packed)
            objects = {holder: _stream(head + self.as_it_was, told_of_it)}
        whole, places = self.content + hidden, dict[int, int]()
        own = {self.field: self.signed, self.value: SIGNATURE}
        own |= {self.size + 1: more} if more else {}
        if drawing:
            own |= {self.field: self.shown, self.size: _stream(over, drawing)}
        for number, written in (own | (objects or {})).items():
            places[number] = len(whole) + 1
            whole += b"\n%d 0 obj\n%b\nendobj\n" % (number, written)
        place = len(whole)
        places[number := max(places) + 1] = place
        rows = b"".join(b"\x01" + each.to_bytes(4, "big") for each in places.values())
        if packed:
            places[self.sheet], rows = holder, rows + b"\x02" + holder.to_bytes(4, "big")
        index = b" ".join(b"%d 1" % each for each in places)
        table = b"/Type /XRef /W [1 4 0] /Index [%b] /Size %d /Prev %d %b " % (
            index,
            number + 1,
            self.former,
            self.named,
        )
        return whole + b"%d 0 obj\n%b\nendobj\n" % (number, _stream(rows, table + told)) + start % place

    def hidden(self, head: bytes) -> bytes:
        return b"\n%b\n%b\nendobj\n" % (head % self.contents, self.painted)


def signed_by_hand(content: bytes) -> bytes:
    """With a signature as it may be added, but that nobody has signed."""
    return _Report(content).revision()


def _hides(head: bytes) -> Callable[[bytes], bytes]:
    def change(content: bytes) -> bytes:
        report = _Report(content)
        return report.revision(hidden=report.hidden(head))

    return change


def _noted(content: bytes) -> bytes:
    report = _Report(content)
    note = b"<< /Type /Annot /Subtype /Text /FT /Sig /T (Approved) /Rect [99 99 99 99] /V << /Type /DocTimeStamp /ByteRange [0 0 0 0] >> >>"
    return report.revision({report.sheet: report.annotated, report.size + 1: note})


def _taken_back(content: bytes) -> bytes:
    report = _Report(content)
    later = _Report(report.revision({report.contents: report.painted}))
    later.signed = report.signed
    return later.revision({report.contents: report.written})


def _packed(content: bytes) -> bytes:
    """A stream that holds the first sheet with other contents; its table tells of the stream alone."""
    report = _Report(content)
    head = b"%d 0 " % report.contents
    held = _stream(head + b"[]", b"/Type /ObjStm /N 1 /First %d" % len(head))
    return report.revision({report.size + 1: held})


def _sheet_with(given: bytes, written: bytes) -> Callable[[bytes], bytes]:
    """The first sheet as it was, with another way of writing a part of it."""

    def change(content: bytes) -> bytes:
        report = _Report(content)
        assert given in report.as_it_was
        return report.revision({report.sheet: report.as_it_was.replace(given, written, 1)})

    return change


def _unpacked(content: bytes) -> bytes:
    """The contents of the first sheet, the same bytes, but as what is not packed."""
    report = _Report(content)
    return report.revision({report.contents: report.written.replace(b"/Filter /FlateDecode", b"")})


def _signed_twice(content: bytes) -> bytes:
    """One signature in two fields."""
    report = _Report(content)
    return report.revision({report.second: report.signed_too})


def _signed_again(content: bytes) -> bytes:
    """The signature of one field in another one, in a revision that nobody has signed, with what proves certificates."""
    report = _Report(content)
    later = _Report(report.revision())
    later.signed, later.value = report.signed, report.value
    proofs = report.root.removesuffix(b">>") + b"/DSS << /Type /DSS >> >>"
    return later.revision({report.second: report.signed_too, report.number_of_root: proofs})


def _hidden_trailer(content: bytes) -> bytes:
    """A signature whose reason is a trailer for some programs, behind a comment."""
    report = _Report(content)
    said = b"/Reason (\ntrailer %%\n<</Root %d 0 R>>\n) >>" % report.number_of_root
    return report.revision({report.value: SIGNATURE.removesuffix(b">>") + said})


def _stamped(content: bytes) -> bytes:
    """A field that somebody signs, with a document timestamp in it."""
    report = _Report(content)
    return report.revision({report.value: SIGNATURE.replace(b"/Sig", b"/DocTimeStamp")})


def _of_revision(**options: Any) -> Callable[[bytes], bytes]:
    return lambda content: _Report(content).revision(**options)


SEARCHED = "contents that only a program finds which searches the file for objects"
OF_REVISION = (
    Forgery("a drawing of a signature without a box: some programs let it reach over the sheet", _of_revision(drawing=b"/Subtype /Form"), PAGES),
    Forgery("the same, with a box that is none", _of_revision(drawing=b"/Subtype /Form /BBox << >>"), PAGES),
    Forgery("a note on a sheet that is called a document timestamp", _noted, PAGES),
    Forgery("contents of a sheet in one revision, taken back in the next", _taken_back, PAGES),
    Forgery(f"{SEARCHED}, under a number of 21 figures", _hides(b"%021d 0 obj"), PAGES),
    Forgery(f"{SEARCHED}, with white space of its own", _hides(b"%d\x0b0\xffobj"), PAGES),
    Forgery(f"{SEARCHED}, with a sign or a point", _hides(b"+%d 0. obj"), PAGES),
    Forgery(f"{SEARCHED}, with a comment", _hides(b"%d 0 %%x\nobj"), PAGES),
    Forgery(f"{SEARCHED}, in a stream whose objects no table names", _packed, PAGES),
    Forgery("a sheet with a blank that only some programs take for one", _sheet_with(b"/Contents ", b"/Contents\x0b"), PAGES),
    Forgery("the same, in a comment", _sheet_with(b"/Contents ", b"%\r/Contents "), PAGES),
    Forgery("a box of a signature, behind such a blank", _of_revision(drawing=DRAWING.replace(b"/BBox ", b"/BBox\x0b")), PAGES),
    Forgery("a sheet in a stream of objects that only some programs unpack further", _of_revision(packed=b"/DP << /Predictor 2 >>"), PAGES),
    Forgery("the same, by a way of packing that each does in its own way",
            _of_revision(packed=b"/DecodeParms << /Predictor 2 /Colors 2 /BitsPerComponent 4 >>"), PAGES),
    Forgery("a table that is packed so", _of_revision(told=b"/DecodeParms << /Predictor 2 /Columns 5 >> "), PAGES),
    Forgery("contents of a sheet, unpacked otherwise: the bytes are the same, and what is said of them is not", _unpacked, PAGES),
    Forgery("the signature of somebody in a second field", _signed_twice, PAGES),
    Forgery("the same, later, where nobody signs", _signed_again, PAGES),
    Forgery("a part of a sheet that refers to another generation of an object: nothing for some, something for others",
            _sheet_with(b"/Contents ", b"/CropBox 9 1 R /Contents "), PAGES),
    Forgery("a number so long that some programs read its beginning", _sheet_with(b"/Contents ", b"/Contents " + 300 * b"0"), PAGES),
    Forgery("a drawing of a signature that takes back the box that cuts it", _of_revision(drawing=DRAWING, over=b"Q " + OVER), PAGES),
    Forgery("a drawing of a signature that saves what it takes back only for some programs", _of_revision(
        drawing=DRAWING, over=b"[ q ] Q " + OVER), PAGES),
    Forgery("a drawing of a signature that says something else than the signature, within its box", _of_revision(
        drawing=DRAWING, over=b"0 0 9 9 re f"), PAGES),
    Forgery("a document timestamp in the field of somebody who signs", _stamped, PAGES),
    Forgery("another catalogue, which a program finds that searches the file", _hidden_trailer, PAGES),
    Forgery("an object that nothing takes which is added", _of_revision(more=b"<< /Type /Catalog /Pages 1 0 R >>"), PAGES),
    Forgery("a drawing of a signature that is moved, by numbers that programs round", _of_revision(
        drawing=DRAWING + b" /Matrix [1 0 0 1 9999999999 -9999999999]"), PAGES),
    Forgery("where the last table stands, in letters that some programs do not take", _of_revision(start=b"startxref\x0b\n%d\n%%%%EOF\n"), PAGES),
    Forgery("the same, further from the end than some programs look", _of_revision(start=START + b"%%" + 1002 * b" "), PAGES),
    Forgery("a second table that a first one names (hybrid files)", _of_revision(told=b"/XRefStm 9 "), PAGES),
)  # fmt: skip
"""Each is a signature as it may be added, with something beside that a program may show."""


# --- docs/trust.md --------------------------------------------------------------------------------------------------------

OF_SIGNED = (
    ("any of these, before somebody signs it by another program (`sign` refuses it)", PAGES),
    ("any of these, after it was signed", "✗ signature"),
    *((each.way, each.line) for each in OF_REVISION),
    ("a field that grows over the sheet where it is shown small, by another program that signs", PAGES),
    ("a byte of what was signed", "✗ signature"),
    ("signed by a certificate that was not valid then, or is not now and no timestamp proves it", "✗ signature"),
    ("signed with SHA-1, or with a key of RSA-1024", "✗ signature"),
    ("signed by somebody whom `--trust` does not name", "✗ signature"),
    ("a name of a signer or a file that looks like a line of `verify`", "written with its control characters escaped"),
)


def table() -> str:
    """Return the list for docs/trust.md."""
    groups = (
        ("the results in a report of any form, its pages made again of them by this program", [(f.way, f.line) for f in OF_RESULTS]),
        ("what is chosen beside the configuration, its pages made again by this program; reported, and no fault",
         [(f.way, _told(f.line)) for f in OF_OPTIONS]),
        ("the name of a file",
         [("a results file with a page in a comment, named `.html`; any form with the ending of another one", "refused: rename it")]),
        ("an HTML page", [(f.way, f.line) for f in OF_PAGE]),
        ("a PDF", [(f.way, f.line) for f in OF_PDF]),
        ("a signed PDF", list(OF_SIGNED)),
    )  # fmt: skip
    lines = [BEGIN, "", "| what is changed | line of `verify` |", "| --- | --- |"]
    for head, rows in groups:
        lines += [f"| **{head}** | |", *(f"| {way} | {_shown(line)} |" for way, line in rows)]
    return "\n".join([*lines, "", END])


def _told(line: str) -> str:
    return line[: line.index("  ")] if line.startswith("✓") else "✓ program"


def _shown(line: str) -> str:
    words = {"refused": "refused as no report of this program", "two results": "refused: it carries two results"}
    return words.get(line, f"`{line}`" if line.startswith(("✗", "✓")) else line)


def page(text: str) -> str:
    """Return docs/trust.md with the list as it is now."""
    return text[: text.index(BEGIN)] + table() + text[text.index(END) + len(END) :]


if __name__ == "__main__":
    TRUST.write_text(page(TRUST.read_text("utf-8")), "utf-8")
