"""The live page in headless Chromium, as a designer works with it. Run by scripts/browser.sh, which brings the driver and axe-core."""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, Page, expect

CONFIG = Path("configs/circular_knife.yaml")
SECONDS = 60_000  # of patience with a machine that does other things as well, in milliseconds
SERIOUS = {"serious", "critical"}


class Live:
    """The program with a page of a copy of a configuration."""

    def __init__(self, folder: Path) -> None:
        self.file = folder / "knife.yaml"
        self.file.write_bytes(CONFIG.read_bytes())
        command = [sys.executable, "-m", "diecut_report", "live", str(self.file), "--no-open"]
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8")
        assert self.process.stdout is not None
        self.address = self.process.stdout.readline().strip()

    def end(self) -> tuple[int, str]:
        self.process.send_signal(signal.SIGINT)
        _, told = self.process.communicate(timeout=30)
        return self.process.returncode, told


@pytest.fixture
def live(tmp_path: Path) -> Iterator[Live]:
    made = Live(tmp_path)
    yield made
    if made.process.poll() is None:
        made.process.kill()
        made.process.communicate(timeout=30)


class Tab:
    """A page with what its console said."""

    def __init__(self, browser: Browser, address: str, **options: Any) -> None:
        self.page: Page = browser.new_context(**{"viewport": {"width": 1280, "height": 900}, **options}).new_page()
        self.page.context.set_default_timeout(SECONDS)
        self.said: list[str] = []
        self.page.on("console", lambda message: self.said.append(message.text))
        self.page.on("pageerror", lambda error: self.said.append(str(error)))
        self.page.goto(address)
        self.page.wait_for_selector("body[data-serial]")

    def input(self, name: str) -> Any:
        return self.page.locator(f'.input[data-name="{name}"]')

    def type(self, name: str, typed: str) -> None:
        field = self.input(name).locator("input[type=text]")
        field.fill(typed)
        field.press("Enter")

    def shown(self, output: str) -> Any:
        return self.page.locator(f'[data-output="{output}"] td').nth(1)

    def verdict(self) -> Any:
        return self.page.locator("#verdict")


def test_a_number_changed_on_the_page_changes_what_it_shows_and_goes_into_the_file(
    browser: Browser, live: Live
) -> None:
    tab, before = Tab(browser, live.address), live.file.read_text("utf-8")
    force = tab.shown("knife.force_max").inner_text()
    tab.type("knife.eccentricity", "22 mm")
    expect(tab.shown("knife.force_max")).not_to_have_text(force, timeout=SECONDS)
    expect(tab.page.locator('[data-output="knife.force_max"] td').nth(2)).to_have_text(force)
    tab.page.wait_for_selector("#checks svg.effect")  # what the chosen input does to a check
    assert live.file.read_text("utf-8") == before
    tab.page.get_by_role("button", name="Write 1 to file").click()
    expect(tab.page.get_by_role("button", name="Write to file")).to_be_disabled(timeout=SECONDS)
    changed = [
        pair
        for pair in zip(before.splitlines(), live.file.read_text("utf-8").splitlines(), strict=True)
        if len(set(pair)) == 2
    ]
    assert changed == [
        (line, line.replace("20 mm", "22 mm")) for line in before.splitlines() if "eccentricity: {value: 20 mm" in line
    ]
    assert tab.said == []


def test_a_slider_moves_a_number(browser: Browser, live: Live) -> None:
    tab = Tab(browser, live.address)
    force = tab.shown("knife.force_max").inner_text()
    tab.input("knife.shear_resistance").locator("input[type=range]").press("ArrowRight")
    expect(tab.shown("knife.force_max")).not_to_have_text(force, timeout=SECONDS)
    tab.page.get_by_role("button", name="Undo Shear").click()
    expect(tab.shown("knife.force_max")).to_have_text(force, timeout=SECONDS)


def test_faults_of_the_file_stand_on_the_page_and_the_last_machine_stays(browser: Browser, live: Live) -> None:
    tab, right = Tab(browser, live.address), live.file.read_text("utf-8")
    force = tab.shown("knife.force_max").inner_text()
    live.file.write_text(right.replace("    friction:", "    frictoin:"), encoding="utf-8")
    faults = tab.page.locator("#faults")
    expect(faults).to_contain_text("did you mean 'friction'?", timeout=SECONDS)
    line = next(number for number, text in enumerate(right.splitlines(), 1) if text.startswith("    friction:"))
    expect(faults).to_contain_text(f"knife.yaml:{line}:5")
    expect(tab.shown("knife.force_max")).to_have_text(force)
    live.file.write_text(right, encoding="utf-8")
    expect(faults).to_be_hidden(timeout=SECONDS)
    live.file.unlink()
    expect(faults).to_be_visible(timeout=SECONDS)
    live.file.mkdir()
    expect(faults).to_contain_text("folder", timeout=SECONDS)
    live.file.rmdir()
    live.file.write_text(right.replace("42 N/mm**2", "40 N/mm**2"), encoding="utf-8")
    expect(tab.shown("knife.force_max")).not_to_have_text(force, timeout=SECONDS)
    expect(faults).to_be_hidden()


def test_a_wrong_number_is_told_beside_it_and_changes_nothing(browser: Browser, live: Live) -> None:
    tab = Tab(browser, live.address)
    tab.type("knife.eccentricity", "5 kg")
    expect(tab.input("knife.eccentricity").locator(".wrong")).to_contain_text("mass", timeout=SECONDS)
    tab.type("knife.eccentricity", "-3 mm")  # a length, but none that the input may have
    expect(tab.page.locator("#faults")).to_contain_text("eccentricity", timeout=SECONDS)
    tab.page.get_by_role("button", name="Undo all changes").click()
    expect(tab.page.locator("#faults")).to_be_hidden(timeout=SECONDS)


def test_an_input_is_found_by_a_search_and_a_fault_stands_beside_what_gave_it(browser: Browser, live: Live) -> None:
    tab = Tab(browser, live.address)
    tab.page.get_by_role("button", name="press").click()
    tab.page.get_by_role("searchbox").fill("KNIFE.eccentr")
    expect(tab.page.locator(".input")).to_have_count(1)
    expect(tab.page.locator(".input .key")).to_have_text("knife.eccentricity")
    tab.type("knife.eccentricity", "2")
    expect(tab.input("knife.eccentricity").locator(".typed")).to_have_value("2 mm", timeout=SECONDS)
    tab.type("knife.eccentricity", "-3")
    expect(tab.input("knife.eccentricity").locator(".fault")).to_contain_text("out of range", timeout=SECONDS)
    other = Tab(browser, live.address)  # opened while there is a fault: the last machine is drawn
    expect(other.page.locator("#figures svg").first).to_be_visible(timeout=SECONDS)
    tab.type("knife.eccentricity", "2.1 cm")
    expect(tab.page.locator("#faults")).to_be_hidden(timeout=SECONDS)
    tab.page.get_by_role("button", name="Undo all changes").click()
    expect(tab.input("knife.eccentricity").locator(".typed")).to_have_value("20 mm", timeout=SECONDS)
    tab.page.locator("h1").click()
    tab.page.keyboard.press("Control+z")
    expect(tab.input("knife.eccentricity").locator(".typed")).to_have_value("2.1 cm", timeout=SECONDS)
    tab.page.get_by_role("searchbox").fill("no such thing")
    expect(tab.page.locator("#inputs .rows")).to_contain_text("No input in the file")


def test_why_a_check_fails_stands_open_and_leads_to_its_mechanism(browser: Browser, live: Live) -> None:
    tab = Tab(browser, live.address)
    tab.type("knife.eccentricity", "26 mm")
    tab.page.get_by_role("button", name="press", exact=True).click()
    tab.page.get_by_label("of all mechanisms").check()
    failing = tab.page.locator("#checks tr").filter(has=tab.page.locator(".s-fail")).first
    expect(failing.locator("details p")).to_be_visible(timeout=SECONDS)
    failing.locator("summary").click()
    tab.type("press.sheet.thickness", "0.6 mm")
    expect(tab.input("press.sheet.thickness").locator(".was")).to_contain_text("initially", timeout=SECONDS)
    expect(failing.locator("details p")).to_be_hidden()  # as a hand has left it
    failing.locator("button.to").click()
    expect(tab.page.locator("#mechanisms [aria-current]")).to_contain_text("knife")


def test_two_tabs_show_the_same_and_the_end_tells_what_is_not_written(browser: Browser, live: Live) -> None:
    one, two = Tab(browser, live.address), Tab(browser, live.address)
    one.type("knife.speed", "55 rpm")
    expect(two.input("knife.speed").locator("input[type=text]")).to_have_value("55 rpm", timeout=SECONDS)
    code, told = live.end()
    assert code == 0 and "changed on the page but not saved: knife.speed: 55 rpm" in told
    expect(one.page.locator("#told")).to_contain_text("does not respond", timeout=SECONDS)
    assert "Traceback" not in told


def test_the_report_of_what_is_shown(browser: Browser, live: Live) -> None:
    tab = Tab(browser, live.address)
    with tab.page.context.expect_page() as opened:
        tab.page.get_by_role("link", name="Report").click()
    expect(opened.value.locator("h1").first).to_contain_text("Circular knife", timeout=SECONDS)


@pytest.mark.parametrize(
    "options", [{}, {"color_scheme": "dark"}, {"viewport": {"width": 390, "height": 844}}], ids=str
)
def test_axe_finds_nothing_serious_and_all_fits(browser: Browser, live: Live, options: dict[str, Any]) -> None:
    tab = Tab(browser, live.address, bypass_csp=True, **options)
    tab.page.locator("#figures").scroll_into_view_if_needed()
    tab.page.wait_for_selector("#figures svg, #figures .uplot")
    tab.page.evaluate(Path(os.environ["AXE"]).read_text("utf-8"))
    found = tab.page.evaluate("() => axe.run()")["violations"]
    told = [(each["id"], [node["target"] for node in each["nodes"]]) for each in found if each["impact"] in SERIOUS]
    assert told == [], json.dumps(told, indent=1)
    assert tab.page.evaluate("() => document.documentElement.scrollWidth <= innerWidth")
    assert not re.search("undefined|NaN|null", tab.page.locator("body").inner_text())


def test_a_state_is_kept_and_numbers_stay_in_view(browser: Browser, live: Live) -> None:
    tab = Tab(browser, live.address)
    tab.page.locator('[data-output="knife.force_max"]').get_by_role("button").click()
    tab.page.get_by_role("button", name="press").click()
    pinned = tab.page.locator('[data-pinned="knife.force_max"] td').nth(1)
    force = pinned.inner_text()
    tab.page.get_by_role("searchbox").fill("shear_resistance")
    tab.type("knife.shear_resistance", "50")
    expect(pinned).not_to_have_text(force, timeout=SECONDS)
    tab.page.locator("#states summary").click()
    tab.page.get_by_role("textbox", name="Name of the present state").fill("tough board")
    tab.page.get_by_role("button", name="Keep", exact=True).click()
    kept = tab.page.locator('[data-state="tough board"]')
    expect(kept).to_be_visible(timeout=SECONDS)
    tab.page.get_by_role("button", name="Undo", exact=False).first.click()
    expect(pinned).to_have_text(force, timeout=SECONDS)
    kept.get_by_role("button", name="Return to").click()
    expect(pinned).not_to_have_text(force, timeout=SECONDS)
    kept.get_by_role("button", name="Save as file").click()
    expect(tab.page.locator("#told")).to_have_text("Written to tough board.yaml.", timeout=SECONDS)
    assert live.file.with_name("tough board.yaml").exists()
    with tab.page.context.expect_page(timeout=SECONDS) as opened:
        tab.page.get_by_role("link", name="Compare").click()
    expect(opened.value.locator("body")).to_contain_text("knife.shear_resistance", timeout=SECONDS)
    kept.get_by_role("button", name="Remove").click()
    expect(kept).to_have_count(0, timeout=SECONDS)
    assert tab.said == []


def test_the_inputs_stay_in_view_beside_the_figures(browser: Browser, live: Live) -> None:
    tab = Tab(browser, live.address)
    tab.page.evaluate("window.scrollTo(0, document.body.scrollHeight)")
    tab.page.wait_for_timeout(300)
    top = tab.page.evaluate("document.getElementById('inputs').getBoundingClientRect().top")
    assert 0 < top <= tab.page.evaluate("document.querySelector('header').getBoundingClientRect().bottom") + 1


def test_the_words_of_a_check_are_those_of_the_machine_that_is_shown(browser: Browser, live: Live) -> None:
    config = CONFIG.with_name("flat_cylinder_mechanisms.yaml").read_text("utf-8")
    live.file.write_text(config, encoding="utf-8")
    tab = Tab(browser, live.address)
    tab.page.get_by_role("button", name="cylinder", exact=False).first.click()
    wall = tab.page.locator('[data-check="cylinder.wall_at_flat"]')
    expect(wall).to_contain_text("Set bore_radius to at most 60 mm", timeout=SECONDS)  # the advice, which comes later
    live.file.write_text(config.replace("bore_radius: 70 mm", "bore_radius: 50 mm"), encoding="utf-8")
    expect(wall).to_contain_text("pass", timeout=SECONDS)
    expect(wall).not_to_contain_text("Set bore_radius", timeout=SECONDS)


def test_beside_the_press_alone_stands_what_of_the_whole_machine_does_not_hold(browser: Browser, live: Live) -> None:
    """The loads of a shaft have no checks either."""
    live.file.write_bytes((CONFIG.parent / "machines" / "flat_cylinder_corrected.yaml").read_bytes())
    tab = Tab(browser, live.address)
    rows, told = tab.page.locator("#checks tbody tr"), tab.page.locator("#open")
    tab.page.locator('[data-mechanism="press"]').click()
    expect(told).to_be_visible(timeout=SECONDS)
    expect(rows).not_to_have_count(0)
    tab.page.locator('[data-mechanism="shafts_main_loads"]').click()
    expect(told).to_be_hidden()
    expect(rows).to_have_count(0)


def test_the_whole_press_moves_and_stays_where_it_is_when_a_number_changes(browser: Browser, live: Live) -> None:
    live.file.write_bytes((CONFIG.parent / "flat_cylinder_press.yaml").read_bytes())
    tab = Tab(browser, live.address)
    tab.page.locator('[data-mechanism="press"]').click()
    figure = tab.page.locator('[data-figure="figure/press/0"]')
    figure.scroll_into_view_if_needed()
    expect(figure.locator(".driven > .moving")).to_have_count(2, timeout=SECONDS)
    slider, crank = figure.locator("input[type=range]"), figure.locator(".driven .m-link").first
    before = crank.get_attribute("points")
    slider.evaluate("e => { e.value = 180; e.dispatchEvent(new Event('input')); }")
    assert crank.get_attribute("points") != before
    tab.page.locator("#search").fill("drive.crank_length")
    field = tab.page.locator('.input[data-name="drive.crank_length"] .typed')
    moved = crank.get_attribute("points")
    field.fill("150 mm")
    field.press("Enter")
    figure.scroll_into_view_if_needed()
    expect(crank).not_to_have_attribute("points", moved or "", timeout=SECONDS)
    expect(figure.locator("output")).to_have_text("180 °")
    figure.locator(".r-play").click()
    expect(figure.locator("output")).not_to_have_text("180 °")
    assert tab.said == []


def test_a_bar_of_the_cyclogram_is_dragged_with_its_offset(browser: Browser, live: Live) -> None:
    live.file.write_bytes((CONFIG.parent / "flat_cylinder_press.yaml").read_bytes())
    tab = Tab(browser, live.address)
    tab.page.locator('[data-mechanism="timing"]').click()
    tab.page.locator('[data-figure="figure/timing/0"]').scroll_into_view_if_needed()
    bar = tab.page.locator(".grip").first
    expect(bar).to_be_attached(timeout=SECONDS)
    bar.scroll_into_view_if_needed()
    box = bar.bounding_box()
    assert box is not None
    at = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    tab.page.mouse.move(*at)
    tab.page.mouse.down()
    tab.page.mouse.move(at[0] + 40, at[1], steps=5)
    caption = tab.page.locator('[data-figure="figure/timing/0"] figcaption')
    expect(caption).to_have_attribute("data-moved", re.compile(r"timing\.lines\.0\.offset: \d+ deg"))
    told = (caption.get_attribute("data-moved") or "").partition(": ")[2]
    tab.page.mouse.up()
    expect(tab.page.locator('.input[data-name="timing.lines.0.offset"] .typed')).to_have_value(told, timeout=SECONDS)
    expect(caption).not_to_have_attribute(
        "data-moved", re.compile(".+"), timeout=SECONDS
    )  # with the figure of the new machine
    assert float(told.split()[0]) > 0 and tab.said == []
