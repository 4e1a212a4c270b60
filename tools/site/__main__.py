"""Writes the sources of the site: ``python -m tools.site FOLDER [--quick]``."""

from __future__ import annotations

import argparse
import gc
from pathlib import Path

from diecut_report.config.plugins import Discovery
from diecut_report.mechanism.mechanism import Mechanism
from tools.site.documents import Links, add_documents, add_notebooks, places
from tools.site.examples import add_reports, examples, shown_kinds
from tools.site.gallery import add_gallery
from tools.site.reference import add_reference
from tools.site.sources import Sources, add_frame


def mechanisms() -> list[Mechanism]:
    """Return the built-in mechanisms, and those that compare them."""
    discovery = Discovery()
    own = [discovery.mechanism(kind) for kind in discovery.origins]
    return [*own, *(comparison.mechanism for each in own for comparison in each.comparisons)]


def site(*, quick: bool) -> Sources:
    """Return all that the site is made of."""
    sources, found = Sources(), examples(quick=quick)
    add_gallery(sources, mechanisms(), shown_kinds(found))
    add_notebooks(sources, Links(places()))
    add_reports(sources, found)
    add_reference(sources)
    add_documents(sources)
    add_frame(sources)
    return sources


def main() -> None:
    """Write the sources into the folder that is named."""
    parser = argparse.ArgumentParser(prog="python -m tools.site", description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--quick", action="store_true", help="with the reports of the small examples alone")
    asked = parser.parse_args()
    gc.disable()  # it is a short life
    site(quick=asked.quick).write(asked.folder)


if __name__ == "__main__":
    main()
