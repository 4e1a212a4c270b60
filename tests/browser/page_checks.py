"""The HTML report in headless Chromium, as a reader meets it. Run by scripts/browser.sh, which brings the driver and axe-core."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from collections.abc import Iterator
from itertools import combinations
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, Page

CONFIGS = os.environ.get("BROWSER_CONFIGS", "").split() or [
    "benchmarks/two_mechanisms.yaml", "configs/circular_knife.yaml", "configs/flat_cylinder_mechanisms.yaml",
]  # fmt: skip
WIDE, NARROW = {"width": 1280, "height": 900}, {"width": 390, "height": 844}
TOO_WIDE = """() => Array.from(document.querySelectorAll("main table, main .scroll:not(.fig)"))
    .filter(e => e.getClientRects().length && (e.scrollWidth > e.clientWidth + 1 || e.getBoundingClientRect().right > innerWidth + 1))
    .map(e => e.className + " " + e.textContent.trim().slice(0, 60))"""
OUT_OF_BOX = """() => Array.from(document.querySelectorAll("math")).filter(e => e.getBoundingClientRect().right > innerWidth
    && !e.closest(".math, .why")).map(e => e.textContent.slice(0, 60))"""
SERIOUS = {"serious", "critical"}
ALL_LAID_OUT = ".math, main .scroll, figure { content-visibility: visible !important; }"


@pytest.fixture(scope="module", params=CONFIGS)
def report(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A report as HTML, with its results beside it."""
    folder, config = tmp_path_factory.mktemp("page"), Path(request.param)
    _reported(config, folder)
    return folder / f"{config.stem}.html"


def _reported(config: Path, folder: Path) -> None:
    command = [
        sys.executable,
        "-m",
        "diecut_report",
        "report",
        config,
        "-o",
        folder,
        "--format",
        "html,json",
        "--quiet",
    ]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode in (0, 1), done.stderr


class Opened:
    """A page with what it said and asked for."""

    def __init__(self, browser: Browser, file: Path, **options: Any) -> None:
        context = browser.new_context(**{"viewport": WIDE, **options})
        context.grant_permissions(["clipboard-read", "clipboard-write"])
        self.page: Page = context.new_page()
        self.said: list[str] = []
        self.asked: list[str] = []
        self.page.on("console", lambda message: self.said.append(message.text))
        self.page.on("pageerror", lambda error: self.said.append(str(error)))
        self.page.on("dialog", lambda dialog: (self.said.append(dialog.message), dialog.dismiss()))
        self.page.on("request", lambda request: self.asked.append(request.url))
        self.page.goto(file.resolve().as_uri())

    def scrolled(self) -> None:
        """Go to every figure that is read, until it is drawn."""
        self.page.evaluate("""async () => { const data = JSON.parse(document.getElementById("reader-data").textContent);
            for (const number of Object.keys(data.figures)) { const figure = document.getElementById("fig-" + number);
                figure.scrollIntoView();
                while (!figure.querySelector(".r-chart canvas")) { await new Promise(done => setTimeout(done, 20)); } }
            scrollTo(0, 0); }""")
        self.settled()

    def settled(self) -> None:
        """Wait until the page has measured what scrolls."""
        self.page.evaluate("""async () => { await new Promise(done => setTimeout(done, 100));
            while (!document.documentElement.dataset.reached) { await new Promise(done => setTimeout(done, 20)); } }""")


def _results(report: Path) -> dict[str, Any]:
    found: dict[str, Any] = json.loads(report.with_suffix(".json").read_text("utf-8"))
    return found


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("size", [WIDE, NARROW], ids=["1280", "390"])
def test_the_page_breaks_nothing_asks_for_nothing_and_axe_finds_nothing_serious(
    browser: Browser, report: Path, size: Any, scheme: Any
) -> None:
    opened = Opened(browser, report, viewport=size, color_scheme=scheme)
    opened.scrolled()
    opened.page.locator("#all-checks > summary").click()
    opened.settled()
    opened.page.add_style_tag(
        content=ALL_LAID_OUT
    )  # axe takes what is far away, and not laid out, to lie over what follows it
    assert opened.said == []
    assert [url for url in opened.asked if not url.startswith(("data:", "file:"))] == []
    assert opened.page.evaluate("document.documentElement.scrollWidth") <= size["width"]
    opened.page.evaluate(Path(os.environ["AXE"]).read_text("utf-8"))
    found = opened.page.evaluate("axe.run(document, {resultTypes: ['violations']})")
    serious = [rule for rule in found["violations"] if rule["impact"] in SERIOUS]
    assert [
        (rule["id"], len(rule["nodes"]), [node["html"][:200] for node in rule["nodes"][:3]]) for rule in serious
    ] == []


def test_at_390_px_no_table_scrolls_sideways_and_formulas_scroll_in_boxes_of_their_own(
    browser: Browser, report: Path
) -> None:
    page = Opened(browser, report, viewport=NARROW).page
    page.evaluate("document.getElementById('all-checks').open = true")
    assert page.evaluate(TOO_WIDE) == []
    assert page.evaluate(OUT_OF_BOX) == []
    first = page.locator("table.checks tbody tr").first
    if first.count():
        places = first.locator("td").evaluate_all(
            "cells => cells.map(c => [c.getBoundingClientRect().top, !!c.querySelector('.badge')])"
        )
        assert min(place for place in places if place[0])[1], "the verdict stands first"


def test_at_390_px_cells_are_named_in_words_with_their_units(browser: Browser, report: Path) -> None:
    """No symbol stands among the words without its index, as in "Margin at the start m1"."""
    page = Opened(browser, report, viewport=NARROW).page
    named = page.evaluate("""() => [...document.querySelectorAll("td[data-label]")].map(cell => {
        const table = cell.closest("table"), head = [...table.tHead.rows[0].cells][cell.cellIndex], sign = head.querySelector(".whole i.sy");
        return [cell.dataset.label, head.textContent.trim(), sign ? sign.textContent + sign.nextSibling?.textContent : ""]; })""")
    signs = {label: sign for label, head, sign in named if len(sign) > 2 and head != label and "_" not in sign}
    assert named and not [label for label, sign in signs.items() if sign.split(",")[0] in label.split()]
    assert not [label for label, *_ in named if "  " in label or " ," in label]


def test_without_scripts_everything_is_there(browser: Browser, report: Path) -> None:
    page = Opened(browser, report, java_script_enabled=False).page
    content = report.read_text("utf-8")
    assert page.locator("figure .fig svg:visible").count() == content.count('<div class="scroll fig">')
    assert page.locator("nav.toc li:visible").count() == content.count('<li class="d')
    assert page.locator(".tools:visible, .filters:visible, .reading, .copy").count() == 0


def test_the_list_of_checks_is_filtered(browser: Browser, report: Path) -> None:
    page = Opened(browser, report).page
    page.locator("#all-checks > summary").click()
    results = _results(report)
    every = [check for part in (*results["mechanisms"].values(), *results.get("comparisons", {}).values()) for check in part.get("checks", ())
             if check.get("class") != "numerical"]  # fmt: skip
    rows = page.locator("#all-checks tbody tr:visible")
    for status in {check["status"] for check in every}:
        button = page.locator(f'#all-checks button[data-status="{status}"]')
        button.click()
        assert rows.count() == sum(check["status"] == status for check in every)
        button.click()
    assert rows.count() == len(every)
    page.locator("#all-checks .filters input").fill(every[-1]["title"].lower())
    assert 1 <= rows.count() < len(every)


def test_search_finds_headings_quantities_and_symbols_and_goes_there(browser: Browser, report: Path) -> None:
    page = Opened(browser, report).page
    mechanism = next(part for part in _results(report)["mechanisms"].values() if part.get("outputs"))
    row = next(iter(mechanism["outputs"].values()))
    page.keyboard.press("/")
    page.keyboard.type(row["description"][:25])
    page.keyboard.press("ArrowDown")
    page.keyboard.press("Enter")
    found = page.locator(".found").first
    assert row["description"][:25].lower() in found.inner_text().lower()
    assert found.evaluate("e => e.getBoundingClientRect().top >= 0 && e.getBoundingClientRect().top < innerHeight")
    page.locator("#reader-search").fill("no such thing in this report")
    assert page.locator("#reader-found button").count() == 0


def test_a_number_is_copied_with_its_unit_by_mouse_and_by_keyboard(browser: Browser, report: Path) -> None:
    page = Opened(browser, report).page
    cell = page.locator(
        "table.quantities td.num:has(+ td.unit:not(:empty)), table.keys td.num:has(+ td.unit:not(:empty))"
    ).first
    expected = cell.evaluate("e => e.firstChild.textContent + ' ' + e.nextElementSibling.textContent").replace(
        "\u2212", "-"
    )
    button = cell.locator(".copy")
    assert button.get_attribute("aria-label").startswith("Copy ")
    for press in (lambda: (cell.hover(), button.click()), lambda: (button.focus(), page.keyboard.press("Enter"))):
        page.evaluate(
            "navigator.clipboard.writeText('').then(() => document.getElementById('reader-told').textContent = '')"
        )
        press()
        page.locator("#reader-told:not(:empty)").wait_for(
            state="attached"
        )  # the page's policy lets no text be evaluated there
        assert page.evaluate("navigator.clipboard.readText()").replace(" ", "") == re.sub(r"\s", "", expected)


def test_light_and_dark_follow_the_system_and_the_switch(browser: Browser, report: Path) -> None:
    ground = "getComputedStyle(document.documentElement).backgroundColor"
    page = Opened(browser, report, color_scheme="dark").page
    dark = page.evaluate(ground)
    page.locator("#reader-theme").click()
    light = page.evaluate(ground)
    assert dark != light == "rgb(255, 255, 255)"
    page.reload()
    assert page.evaluate(ground) == light, "the choice is kept"


def test_the_sign_of_a_verdict_has_the_colour_of_its_words(browser: Browser, report: Path) -> None:
    colours = Opened(browser, report).page.evaluate(
        """() => Array.from(document.querySelectorAll(".badge > .mk"),
            sign => [getComputedStyle(sign).color, getComputedStyle(sign.parentElement).color])"""
    )
    assert colours and all(sign == words for sign, words in colours)


def test_the_contents_say_where_the_reader_is(browser: Browser, report: Path) -> None:
    page = Opened(browser, report).page
    for head in page.locator("main h2[id]").all()[1:3]:
        name = head.get_attribute("id")
        page.evaluate("name => document.getElementById(name).scrollIntoView()", name)
        page.wait_for_function(
            "name => document.querySelector('nav [aria-current]').getAttribute('href') === '#' + name", arg=name
        )


def _curves(report: Path) -> Iterator[tuple[str, dict[str, Any], dict[str, Any]]]:
    for mechanism in _results(report)["mechanisms"].values():
        for figure in mechanism.get("figures", ()):
            if figure["type"] == "plot" and mechanism["curves"][figure["abscissa"]]["unit"] == "rad":
                yield figure["title"], figure, mechanism["curves"]


def test_all_curves_of_a_mechanism_are_read_at_the_place_of_the_slider(browser: Browser, report: Path) -> None:
    """Held against the results: what stands beside a curve is its value at the angle, within what is printed."""
    opened = Opened(browser, report)
    opened.scrolled()
    page, read = opened.page, 0
    for title, figure, curves in list(_curves(report))[:6]:
        box = page.locator(
            "figure.read", has=page.locator("figcaption strong", has_text=re.compile(f"^{re.escape(title)}"))
        )
        if not box.count():
            continue
        over = curves[figure["abscissa"]]["values"]
        place = len(over) // 3
        slider = box.first.locator("input[type=range]").first
        slider.evaluate(
            "(e, x) => { e.step = 'any'; e.value = x; e.dispatchEvent(new Event('input')); }",
            over[place] * 57.29577951308232,
        )
        shown = box.first.locator(".r-value").all_text_contents()
        names = [series["curve"] for panel in figure["panels"] for series in panel["series"]]
        for text, name in zip(shown, names, strict=True):
            number = float(re.sub(r"[^\d.−]", "", text.split("×")[0].split("\u00a0")[0]).replace("−", "-"))
            if (
                curves[name]["display_unit"] == curves[name]["unit"]
                and "×" not in text
                and name not in curves[name].get("left", ())
            ):
                greatest = max(map(abs, curves[name]["values"]))
                assert number == pytest.approx(curves[name]["values"][place], abs=2e-3 * greatest)
                read += 1
        at = {output for output in page.locator("figure.read output").all_text_contents() if output}
        assert box.first.locator("output").first.text_content() in at
    assert read or not list(_curves(report))


def test_diagrams_of_a_mechanism_follow_the_mouse_over_one_of_them(browser: Browser, report: Path) -> None:
    opened = Opened(browser, report)
    opened.scrolled()
    page = opened.page
    groups = page.evaluate("""() => { const data = JSON.parse(document.getElementById('reader-data').textContent), found = {};
        Object.entries(data.figures).forEach(([n, f]) => f.panels.forEach(p => (found[p.group] = found[p.group] || new Set()).add(n)));
        return Object.values(found).map(s => Array.from(s)).filter(s => s.length > 1); }""")
    for first, *others in groups[:2]:
        chart = page.locator(f'[id="fig-{first}"] .u-over').first
        chart.scroll_into_view_if_needed()
        box = chart.bounding_box()
        page.mouse.move(box["x"] + box["width"] * 0.6, box["y"] + box["height"] / 2)
        place = page.locator(f'[id="fig-{first}"] output').first.text_content()
        assert place
        for other in others:
            assert place in page.locator(f'[id="fig-{other}"] output').all_text_contents()


def test_a_figure_is_shown_as_printed_on_demand_and_on_paper(browser: Browser, report: Path) -> None:
    page = Opened(browser, report).page
    numbers = page.evaluate("Object.keys(JSON.parse(document.getElementById('reader-data').textContent).figures)")
    if not numbers:
        return
    page.evaluate("name => document.getElementById(name).scrollIntoView()", f"fig-{numbers[0]}")
    figure = page.locator("figure.read").first
    figure.wait_for()
    assert not figure.locator(".fig svg").is_visible()
    figure.locator(".as-printed").click()
    assert figure.locator(".fig svg").is_visible() and not figure.locator(".reading").is_visible()
    figure.locator(".as-printed").click()
    page.emulate_media(media="print")
    assert figure.locator(".fig svg").is_visible() and not figure.locator(".reading").is_visible()


DRAWN_TEXTS = """() => { window.outside = []; const draw = CanvasRenderingContext2D.prototype.fillText;
    CanvasRenderingContext2D.prototype.fillText = function (text, x, y) {
        const wide = this.measureText(text).width, at = this.textAlign === "right" ? x - wide : this.textAlign === "center" ? x - wide / 2 : x;
        if (at < -1 || at + wide > this.canvas.width + 1) { window.outside.push(text); }
        draw.call(this, text, x, y); }; }"""
POSES = """figure => Array.from(document.getElementById(figure).querySelectorAll(".moving")).map(s => Array.from(s.children).map(e =>
    e.tagName === "g" ? e.getAttribute("transform") :
    e.getAttribute("points") || e.getAttribute("d") || [e.getAttribute("cx"), e.getAttribute("cy")].join(" ")))"""


def _moving(report: Path) -> Iterator[tuple[str, dict[str, Any]]]:
    for mechanism in _results(report)["mechanisms"].values():
        yield from (
            (figure["title"], figure["moving"]) for figure in mechanism.get("figures", ()) if "moving" in figure
        )


def _figure_of(page: Page, title: str) -> str:
    """The id of the figure of a title, on the page."""
    strong = page.locator("figure figcaption strong", has_text=re.compile(f"^{re.escape(title)}")).first
    found: str = strong.evaluate("e => e.closest('figure').id")
    return found


def _set(page: Page, figure: str, place: float) -> None:
    slider = page.locator(f'[id="{figure}"] input[type=range]').first
    slider.evaluate("(e, x) => { e.step = 'any'; e.value = x; e.dispatchEvent(new Event('input')); }", place)


def test_the_drawings_of_a_mechanism_move_with_the_cursor_as_the_results_tell(browser: Browser, report: Path) -> None:
    """Held against the numbers of the results at a place; what turns is turned the other way, as a page's ordinate points down."""
    opened = Opened(browser, report)
    opened.scrolled()
    for title, moving in _moving(report):
        figure, k = _figure_of(opened.page, title), len(moving["places"]) // 3
        _set(opened.page, figure, moving["places"][k] * 57.29577951308232)
        shown = opened.page.evaluate(POSES, figure)[0]
        greatest = max(
            abs(number) for shape in moving["shapes"] if "moves" in shape for number in shape["moves"][k][:2]
        )
        for text, shape in zip(shown, moving["shapes"], strict=True):
            if "moves" not in shape:
                continue
            numbers = [float(number) for number in re.findall(r"-?[\d.]+(?:e-?\d+)?", text)]
            expected = shape["moves"][k]
            if shape["shape"] == "rigid":
                assert numbers[2] == pytest.approx(-expected[2] * 57.29577951308232, abs=0.05)
                numbers, expected = numbers[:2], expected[:2]
            if shape.get("role") == "ground":  # its first point, then the way and the strokes of the frame
                numbers, expected = numbers[:2], expected[:2]
            signs = [1, -1] * (len(numbers) // 2)
            assert numbers == pytest.approx([s * n for s, n in zip(signs, expected, strict=False)], abs=1e-3 * greatest)


def test_the_lines_of_a_cyclogram_move_on_one_sheet_as_in_their_own_drawings(browser: Browser, report: Path) -> None:
    """At a main-shaft angle each stands as its own drawing does at the angle that follows from the line's offset and rate."""
    opened = Opened(browser, report)
    opened.scrolled()
    every, angle = list(_moving(report)), 4.0
    mechanisms = _results(report)["mechanisms"]
    for title, moving in every:
        for index, drive in enumerate(moving.get("drives", ())):
            own = next(each for each in mechanisms[drive["mechanism"]]["figures"] if "moving" in each)
            figure, alone = _figure_of(opened.page, title), _figure_of(opened.page, own["title"])
            _set(opened.page, figure, angle * 57.29577951308232)
            together = opened.page.evaluate(POSES, figure)[2 + index]
            share = (angle - drive["offset"]) / drive["period"] % 1
            _set(opened.page, alone, share * own["moving"]["places"][-1] * 57.29577951308232)
            apart = opened.page.evaluate(POSES, alone)[0]
            numbers = [
                [float(n) for n in re.findall(r"-?[\d.]+(?:e-?\d+)?", " ".join(texts))] for texts in (together, apart)
            ]
            assert numbers[0] == pytest.approx(numbers[1], abs=1e-3 * max(map(abs, numbers[1])))


def test_a_turn_plays_and_stops_and_the_curves_go_with_it(browser: Browser, report: Path) -> None:
    opened = Opened(browser, report)
    opened.scrolled()
    page = opened.page
    for title, _ in list(_moving(report))[:1]:
        box = page.locator(f'[id="{_figure_of(page, title)}"]')
        before, button = box.locator("output").text_content(), box.locator(".r-play")
        button.focus()
        page.keyboard.press("Enter")
        page.wait_for_function("([id, text]) => document.getElementById(id).querySelector('output').textContent !== text",
                               arg=[box.get_attribute("id"), before])  # fmt: skip
        assert button.get_attribute("aria-pressed") == "true"
        page.keyboard.press("Enter")
        assert button.get_attribute("aria-pressed") == "false"
        place = box.locator("output").text_content()
        page.wait_for_timeout(200)
        assert box.locator("output").text_content() == place
        assert (
            page.locator("figure.read output", has_text=place).count() >= 1 or not page.locator("figure.read").count()
        )


def test_polar_figures_are_read_beside_what_is_printed_at_the_same_angle(browser: Browser, report: Path) -> None:
    opened = Opened(browser, report)
    opened.scrolled()
    page = opened.page
    polar = page.evaluate("""Object.entries(JSON.parse(document.getElementById('reader-data').textContent).figures)
        .filter(([n, f]) => f.beside).map(([n]) => 'fig-' + n)""")
    for figure in polar:
        box = page.locator(f'[id="{figure}"]')
        box.scroll_into_view_if_needed()
        assert box.locator(".fig svg").is_visible() and box.locator(".as-printed").count() == 0
        _set(page, figure, 123.0)
        value = box.locator(".r-value").first.text_content()
        same = page.locator("figure.read", has=page.locator("output", has_text="123°")).locator(".r-value")
        assert re.search(r"\d", value) and value in same.all_text_contents()


def test_texts_in_charts_stay_inside_and_every_curve_has_a_value_where_it_begins(
    browser: Browser, report: Path
) -> None:
    opened = Opened(browser, report)
    opened.page.evaluate(DRAWN_TEXTS)
    opened.scrolled()
    opened.page.wait_for_timeout(300)
    assert opened.page.evaluate("outside") == []
    for head in opened.page.locator("figure.read .r-head").all():
        values = head.locator(".r-value").all_text_contents()
        assert len(values) > 1 or re.search(r"\d", values[0]), head.text_content()


LEVELS = """() => [1, 4, 9, 15, 40].map(apart => levelNames([200, 100, 100 + apart, 100 + 2 * apart].map(y => ({ y: y, width: 90 })),
    { left: 50, top: 80, width: 400, height: 140 }, 13))"""


def test_names_of_near_levels_stand_apart_and_inside(browser: Browser, report: Path) -> None:
    for places in Opened(browser, report).page.evaluate(LEVELS):
        assert all(50 <= place["x"] <= 360 and 93 <= place["y"] <= 220 for place in places), places
        for one, other in combinations(places, 2):
            assert abs(one["x"] - other["x"]) >= 90 or abs(one["y"] - other["y"]) >= 13, places


def test_the_tab_key_stops_only_where_something_is_seen(browser: Browser, report: Path) -> None:
    page = Opened(browser, report).page
    for _ in range(40):
        page.keyboard.press("Tab")
        state = page.evaluate("""() => { const e = document.activeElement, r = e.getBoundingClientRect();
            return [e.outerHTML.slice(0, 80), r.width > 0 && r.height > 0 && r.bottom > 0 && r.top < innerHeight,
                    getComputedStyle(e).outlineStyle]; }""")
        assert state[1] and state[2] != "none", state


def test_without_scripts_a_phone_scrolls_wide_tables_in_boxes_of_their_own(browser: Browser, report: Path) -> None:
    page = Opened(browser, report, java_script_enabled=False, viewport=NARROW).page
    assert page.evaluate("document.documentElement.scrollWidth") <= NARROW["width"]
    lost = """() => Array.from(document.querySelectorAll("main table")).filter(e => e.getBoundingClientRect().right > innerWidth + 1
        && !e.closest(".scroll")).map(e => e.textContent.trim().slice(0, 60))"""
    assert page.evaluate(lost) == []


def test_a_page_opens_without_laying_out_what_is_far_away(browser: Browser, report: Path) -> None:
    """Its own work, not the machine's clock: most formulas have not been laid out when the page stands."""
    page = Opened(browser, report).page
    hidden = page.evaluate("""() => { const all = Array.from(document.querySelectorAll(".math math"));
        return [all.filter(e => !e.checkVisibility({contentVisibilityAuto: true})).length, all.length]; }""")
    assert hidden[1] < 40 or hidden[0] > 0.6 * hidden[1]


HOSTILE = "</script><img src=x onerror=alert(1)><script>alert(2)</script>"


def test_texts_of_a_stranger_stay_texts_in_everything_that_the_scripts_build(browser: Browser, tmp_path: Path) -> None:
    text = Path("benchmarks/two_mechanisms.yaml").read_text("utf-8")
    file = tmp_path / "bad.yaml"
    file.write_text(re.sub(r"title: .*", lambda _: f"title: {json.dumps(HOSTILE)}", text), "utf-8")
    _reported(file, tmp_path)
    opened = Opened(browser, tmp_path / "bad.html")
    opened.scrolled()
    opened.page.locator("#reader-search").fill("onerror")
    assert opened.said == []
    assert opened.page.locator("img").count() == 0
