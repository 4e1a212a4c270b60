"""The documentation site in headless Chromium, as a reader meets it: every page, wide and on a phone. Run by scripts/browser.sh,
which builds the site and brings the driver and axe-core."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, Page

SITE = Path("build/site").resolve()
PAGES = sorted(
    file.relative_to(SITE).as_posix() for file in SITE.rglob("*.html") if file.parent.name not in ("reports", "_static")
)
LOOKED_AT = ("index.html", "gallery/circular_knife.html", "reference/figures.html", "validation.html", "search.html")
WIDE, NARROW = {"width": 1280, "height": 900}, {"width": 390, "height": 844}
SERIOUS = {"serious", "critical"}


class Opened:
    """A page of the site with what its console said, what it asked for elsewhere and what it did not get."""

    def __init__(self, browser: Browser, name: str, **options: Any) -> None:
        self.page: Page = browser.new_context(**{"viewport": WIDE, **options}).new_page()
        self.said: list[str] = []
        self.page.on("console", lambda message: self.said.append(message.text))
        self.page.on("pageerror", lambda error: self.said.append(str(error)))
        self.page.on("requestfailed", lambda request: self.said.append(f"not got: {request.url}"))
        self.page.on("request", lambda request: self._asked(request.url))
        self.page.goto(f"{SITE.as_uri()}/{name}")
        self.page.wait_for_load_state()

    def _asked(self, address: str) -> None:
        if not address.startswith(("file:", "data:", "blob:")):
            self.said.append(f"asked for {address}")

    def close(self) -> None:
        self.page.context.close()


@pytest.mark.parametrize("size", [WIDE, NARROW], ids=["wide", "phone"])
def test_no_page_says_anything_or_goes_beyond_its_side(browser: Browser, size: dict[str, int]) -> None:
    wrong = {}
    for name in PAGES:
        opened = Opened(browser, name, viewport=size)
        fits = opened.page.evaluate("() => document.documentElement.scrollWidth <= innerWidth")
        if opened.said or not fits:
            wrong[name] = [*opened.said, *([] if fits else ["it is wider than the window"])]
        opened.close()
    assert len(PAGES) > 40 and wrong == {}


@pytest.mark.parametrize("name", LOOKED_AT)
@pytest.mark.parametrize(
    "options", [{}, {"color_scheme": "dark"}, {"viewport": NARROW}], ids=["light", "dark", "phone"]
)
def test_axe_finds_nothing_serious(browser: Browser, name: str, options: dict[str, Any]) -> None:
    opened = Opened(browser, name, bypass_csp=True, **options)
    opened.page.evaluate(Path(os.environ["AXE"]).read_text("utf-8"))
    found = opened.page.evaluate("() => axe.run()")["violations"]
    told = [(each["id"], [node["target"] for node in each["nodes"]][:5]) for each in found if each["impact"] in SERIOUS]
    opened.close()
    assert told == [], json.dumps(told, indent=1)


def test_figures_and_formulas_are_set_in_the_fonts_of_the_site(browser: Browser) -> None:
    opened = Opened(browser, "gallery/circular_knife.html")
    opened.page.evaluate("() => document.fonts.ready")
    loaded = opened.page.evaluate("() => [...document.fonts].filter(f => f.status === 'loaded').map(f => f.family)")
    assert {name.strip('"') for name in loaded} >= {"Report Sans", "Report Math"}
    assert opened.page.locator("figure.drawn svg").count() == 1 and opened.page.locator(".eq math").count() > 20
    opened.close()


def test_a_key_is_found_by_the_search(browser: Browser) -> None:
    opened = Opened(browser, "search.html?q=sharpening_angle")
    opened.page.wait_for_selector("ul.search li")
    assert "Circular knife" in opened.page.locator("ul.search").inner_text()
    opened.close()


def test_a_reader_comes_from_the_start_to_a_chapter_of_a_report(browser: Browser) -> None:
    opened = Opened(browser, "index.html")
    opened.page.get_by_role("link", name="circular_knife").first.click()
    opened.page.get_by_role("link", name="Its chapter in the report").click()
    opened.page.wait_for_selector("h1")
    assert "reports/circular_knife.html" in opened.page.url and opened.said == []
    opened.close()
