"""Looks at the built site in a headless browser, as a reader without a network would: ``python -m tools.site.look build/site``.

A few pages of each sort are opened: their scripts run without a complaint, and what a reader comes for is there. ``scripts/browser.sh`` looks
at all of them, wide and on a phone, with axe-core.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

PAGES = {  # each with what must be in it once its scripts have run
    "index.html": r'<nav[^>]*sidebar-tree|class="sidebar-tree"',
    "gallery/circular_knife.html": r"<figure[^>]*>.*?<svg.*?<math",
}
SAID = re.compile(r":CONSOLE[:(]\d+\)?\] (.*)")
PROGRAMS = ("chromium", "chromium-browser", "google-chrome")
SECONDS = 120


def browser() -> str | None:
    """Return the browser that ``CHROMIUM`` names, or one that is installed."""
    return os.environ.get("CHROMIUM") or next(filter(None, map(shutil.which, PROGRAMS)), None)


def faults(program: str, site: Path) -> Iterator[str]:
    """Yield what is wrong with the pages in a browser."""
    for name, wanted in PAGES.items():
        html, said = opened(program, (site / name).resolve().as_uri())
        yield from (f"{name}: {each}" for each in SAID.findall(said))
        if not re.search(wanted, html, re.DOTALL):
            yield f"{name}: what a reader comes for is not shown ({wanted})"


def opened(program: str, address: str) -> tuple[str, str]:
    """Return a page as it stands once its scripts have run, and what the browser said; nothing is asked of a network."""
    options = ("--headless", "--no-sandbox", "--disable-gpu", "--enable-logging=stderr", "--virtual-time-budget=3000")
    alone = ("--host-resolver-rules=MAP * ~NOTFOUND", "--disable-background-networking", "--no-first-run")
    command = [program, *options, *alone, "--dump-dom", address]
    ran = subprocess.run(command, capture_output=True, timeout=SECONDS, check=True)
    return ran.stdout.decode("utf-8", "replace"), ran.stderr.decode("utf-8", "replace")


def main(site: Path) -> int:
    """Look at a site; 1 where a page is not as it should be."""
    program = browser()
    if program is None:
        print("not looked at in a browser: chromium is not installed (CHROMIUM names another program)")
        return 0
    found = list(faults(program, site))
    print(*(found or [f"looked at in a browser: {', '.join(PAGES)}"]), sep="\n")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
