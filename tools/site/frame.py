"""What the pages stand in: the settings of Sphinx, the style, and the fonts of the reports, in which figures and formulas are set."""

from __future__ import annotations

from tools.site.sources import ROOT, Sources

OWN = ROOT / "docs" / "site"
FONTS = ("report-sans-regular", "report-symbols", "report-math")


def add_frame(sources: Sources) -> None:
    """Add them: what stands in docs/site, and the fonts."""
    for file in sorted(OWN.rglob("*")):
        if file.is_file() and "__pycache__" not in file.parts:
            sources.add(file.relative_to(OWN).as_posix(), file.read_bytes())
    for name in FONTS:
        sources.add(f"_static/fonts/{name}.woff2", (ROOT / "templates" / "fonts" / f"{name}.woff2").read_bytes())
