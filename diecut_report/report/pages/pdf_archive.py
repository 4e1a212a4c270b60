"""What makes a PDF one for archives: it says that it is PDF/A-3 and PDF/UA-1, and has a field for each signature."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Any

from diecut_report.report.document import SIGNERS
from diecut_report.report.pages.page_engine import Array, Dictionary, Stream, String, say_once
from diecut_report.report.pages.pdf_math import Letters, add_font

POINT = 0.75  # of a pixel
INSET = 1.0  # points between a field and its box
PRINTED = 4  # the flag of what shows on paper too
ANCHOR = "sign-"  # before the name of a signer: the box in which he signs
ACCESSIBLE = (
    b'<rdf:Description rdf:about="" xmlns:pdfuaid="http://www.aiim.org/pdfua/ns/id/"><pdfuaid:part>1</pdfuaid:part></rdf:Description>'
    b'<rdf:Description rdf:about="" xmlns:pdfaExtension="http://www.aiim.org/pdfa/ns/extension/" '
    b'xmlns:pdfaSchema="http://www.aiim.org/pdfa/ns/schema#" xmlns:pdfaProperty="http://www.aiim.org/pdfa/ns/property#">'
    b'<pdfaExtension:schemas><rdf:Bag><rdf:li rdf:parseType="Resource">'
    b"<pdfaSchema:schema>PDF/UA identification schema</pdfaSchema:schema>"
    b"<pdfaSchema:namespaceURI>http://www.aiim.org/pdfua/ns/id/</pdfaSchema:namespaceURI><pdfaSchema:prefix>pdfuaid</pdfaSchema:prefix>"
    b'<pdfaSchema:property><rdf:Seq><rdf:li rdf:parseType="Resource"><pdfaProperty:name>part</pdfaProperty:name>'
    b"<pdfaProperty:valueType>Integer</pdfaProperty:valueType><pdfaProperty:category>internal</pdfaProperty:category>"
    b"<pdfaProperty:description>PDF/UA version identifier</pdfaProperty:description></rdf:li></rdf:Seq></pdfaSchema:property>"
    b"</rdf:li></rdf:Bag></pdfaExtension:schemas></rdf:Description>"
)
"""That a document is PDF/UA-1, and what that property is, as PDF/A wants it declared."""


def complete(document: Any, pdf: Any, words: Mapping[str, str], letters: Letters, formulas: Collection[str]) -> None:
    """Complete a document as it is written (the page engine's ``finisher``); ``pdf`` holds its objects."""
    _declare_accessible(pdf)
    shared = _object(pdf, _object(pdf, pdf.page_references[0])["Resources"])  # one and the same for all sheets
    add_font(pdf, _object(pdf, shared["Font"]))
    letters.add_forms(pdf, shared["XObject"])
    pdf.catalog["AF"] = Array(dict.fromkeys(pdf.catalog["AF"]))
    for number, page in enumerate(document.pages):
        for name in SIGNERS:
            if ANCHOR + name in page.anchors:
                _add_field(pdf, name, f"{words['signature']}: {words[name]}", number, page)
    for each in pdf.objects:
        # the page engine knows pictures of formulas as figures, with the formula as their text
        told = each.get("Alt") if isinstance(each, Dictionary) and each.get("S") == "/Figure" else None
        if told is not None and told.string in formulas:
            each["S"] = "/Formula"
    say_once(pdf)


def _add_field(pdf: Any, name: str, told: str, number: int, page: Any) -> None:
    x1, y1, x2, y2 = (each * POINT for each in page.anchors[ANCHOR + name])
    height = page.height * POINT
    box = x1 + INSET, height - y2 + INSET, x2 - INSET, height - y1 - INSET
    size = Array((0, 0, box[2] - box[0], box[3] - box[1]))
    empty = Stream([], {"Type": "/XObject", "Subtype": "/Form", "BBox": size})
    pdf.add_object(empty)
    sheet = pdf.page_references[number]
    field = Dictionary({
        "Type": "/Annot", "Subtype": "/Widget", "FT": "/Sig", "T": String(name), "TU": String(told), "F": PRINTED,
        "Rect": Array(box), "P": sheet, "AP": Dictionary({"N": empty.reference}),
    })  # fmt: skip
    pdf.add_object(field)
    _tag(pdf, field, sheet)
    _object(pdf, sheet).setdefault("Annots", Array()).append(field.reference)
    form = pdf.catalog.setdefault("AcroForm", Dictionary({"Fields": Array()}))
    form["Fields"].append(field.reference)


def _declare_accessible(pdf: Any) -> None:
    """Say in the metadata, which readers must find unpacked, that the document is PDF/UA too."""
    metadata = _object(pdf, pdf.catalog["Metadata"])
    metadata.stream = [part.replace(b"</rdf:RDF>", ACCESSIBLE + b"</rdf:RDF>") for part in metadata.stream]
    metadata.compress = False


def _tag(pdf: Any, field: Any, sheet: bytes) -> None:
    root = _object(pdf, pdf.catalog["StructTreeRoot"])
    whole, numbers = _object(pdf, root["K"][0]), _object(pdf, root["ParentTree"])["Nums"]
    place = Dictionary({"Type": "/OBJR", "Obj": field.reference, "Pg": sheet})
    pdf.add_object(place)
    element = Dictionary(
        {"Type": "/StructElem", "S": "/Form", "K": Array([place.reference]), "Pg": sheet, "P": whole.reference}
    )
    pdf.add_object(element)
    whole["K"].append(element.reference)
    field["StructParent"] = numbers[-2] + 1
    numbers.extend([field["StructParent"], element.reference])


def _object(pdf: Any, reference: bytes) -> Any:
    return pdf.objects[int(reference.split()[0])]
