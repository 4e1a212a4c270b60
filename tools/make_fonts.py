"""Make the fonts of the reports: subsets of Source Sans 3, IBM Plex Mono and STIX Two Math under names of their own.

    python tools/make_fonts.py FOLDER

FOLDER holds the unpacked wheels ``fontpkg-source-sans-3`` 3.52, ``fontpkg-ibm-plex-mono`` 2.3 and ``ziamath`` 0.13 (which
carries STIX Two Math 2.13). The subsets are renamed, as the licences' reserved font names ask for. "Report Symbols" is made
of the mathematical italic letters of STIX Two Math, put at the places of the plain letters: so a symbol in running text
looks as in the formulas, and is found and copied as plain letters.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

from fontTools import subset
from fontTools.ttLib import TTFont
from fontTools.varLib.instancer import instantiateVariableFont

TARGET = Path(__file__).parent.parent / "templates" / "fonts"
LATIN = "".join(map(chr, [*range(0x20, 0x7F), *range(0xA0, 0x180), 0x218, 0x219, 0x21A, 0x21B]))
GREEK = "".join(map(chr, [*range(0x391, 0x3A2), *range(0x3A3, 0x3AA), *range(0x3B1, 0x3CA)])) + "ϑϕϵϰϱϖ"
CYRILLIC = "".join(map(chr, range(0x400, 0x460))) + "Ґґ"
SIGNS = "–—‘’‚“”„†‡•…‰′″‹›€№™−×·÷±≤≥≠≈∞√∑∫∂∆∏∈∧∨¬⌈⌉⌊⌋|°→←↑↓↔⇒✓✗✔✘▲△▼●○■□◆⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻₀₁₂₃₄₅₆₇₈₉½¼¾⅓Ø⌀"
SPACES = "\u2002\u2003\u2007\u2008\u2009\u200a\u200b\u202f\u2060"
TEXT = LATIN + GREEK + CYRILLIC + SIGNS + SPACES
MATH_ALPHABETS = "".join(map(chr, [*range(0x1D400, 0x1D468), *range(0x1D6A8, 0x1D71C), 0x210E]))
MATH_SIGNS = "".join(
    map(chr, [*range(0x2061, 0x2065), *range(0x2190, 0x2200), *range(0x2200, 0x2300), 0x23B4, 0x23B5, 0x27E8, 0x27E9])
)


def main(folder: Path) -> None:
    """Write all fonts from the unpacked wheels in ``folder``."""
    TARGET.mkdir(parents=True, exist_ok=True)
    sans = folder / "fontpkg_source_sans_3/files"
    upright, slanted = sans / "SourceSans3[wght].ttf", sans / "SourceSans3-Italic[wght].ttf"
    write(static(upright, 400), TEXT, "Report Sans", "Regular", "report-sans-regular", plain=True)
    write(static(upright, 600), TEXT, "Report Sans", "Bold", "report-sans-bold", plain=True)
    write(static(slanted, 400), TEXT, "Report Sans", "Italic", "report-sans-italic", plain=True)
    write(
        opened(folder / "fontpkg_ibm_plex_mono/files/IBMPlexMono-Regular.ttf"),
        TEXT,
        "Report Mono",
        "Regular",
        "report-mono",
        plain=True,
    )
    stix = folder / "ziamath/fonts/STIXTwoMath-Regular.ttf"
    write(
        opened(stix),
        LATIN + GREEK + CYRILLIC + SIGNS + SPACES + MATH_ALPHABETS + MATH_SIGNS,
        "Report Math",
        "Regular",
        "report-math",
    )
    letters = "".join(map(chr, set(italics()) | set(map(ord, "′'"))))
    write(
        with_italics(opened(stix)),
        letters,
        "Report Symbols",
        "Italic",
        "report-symbols",
        plain=True,
        drop=("MATH", "GSUB"),
    )


def opened(path: Path) -> TTFont:
    """A font file whose dates stay as they are, so that the same files give the same bytes."""
    return TTFont(path, recalcTimestamp=False)


def static(path: Path, weight: int) -> TTFont:
    """One weight of a variable font."""
    return instantiateVariableFont(opened(path), {"wght": weight})


def italics() -> dict[int, int]:
    """Plain letters to their mathematical italic."""
    latin = {ord("A") + i: 0x1D434 + i for i in range(26)} | {ord("a") + i: 0x1D44E + i for i in range(26)}
    greek = {0x391 + i: 0x1D6E2 + i for i in range(25) if i != 17} | {0x3B1 + i: 0x1D6FC + i for i in range(25)}
    return latin | {ord("h"): 0x210E} | greek | {ord("ϑ"): 0x1D717, ord("ϕ"): 0x1D719, ord("ϵ"): 0x1D716}


def with_italics(font: TTFont) -> TTFont:
    """The font with its mathematical italic at the places of the plain letters."""
    known = font.getBestCmap()
    moved = {plain: known[italic] for plain, italic in italics().items()}
    for table in font["cmap"].tables:
        if table.isUnicode():
            table.cmap.update(moved)
    return font


def write(
    font: TTFont, text: str, family: str, style: str, name: str, *, plain: bool = False, drop: tuple[str, ...] = ()
) -> None:
    """Subset a font to ``text``, rename it, and write it as WOFF2 (and as TTF where figures or sheets are set with it)."""
    options = subset.Options(
        layout_features=["kern", "mark", "mkmk", "liga", "ccmp", "locl", "case", "ssty", "dtls", "flac"]
    )
    options.drop_tables += list(drop)
    options.hinting = False
    options.notdef_outline = True
    subsetter = subset.Subsetter(options)
    subsetter.populate(text=text)
    subsetter.subset(font)
    rename(font, family, style)
    if plain:
        font.save(TARGET / f"{name}.ttf")
    font.flavor = "woff2"
    font.save(TARGET / f"{name}.woff2")


def rename(font: Any, family: str, style: str) -> None:
    """The font's names, without the reserved ones of its origin; copyright and licence stay."""
    texts = {
        1: family,
        2: style,
        3: f"{family} {style}",
        4: f"{family} {style}",
        6: f"{family}-{style}".replace(" ", ""),
    }
    for record in list(font["name"].names):
        if record.nameID in (16, 17, 18, 21, 22, 25) or record.nameID >= 256:
            font["name"].removeNames(nameID=record.nameID)
    for number, text in texts.items():
        font["name"].setName(text, number, 3, 1, 0x409)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
