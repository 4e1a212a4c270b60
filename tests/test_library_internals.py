"""What the program needs of libraries beside their documented interfaces; here it shows where a new version changes it."""

from __future__ import annotations

from concurrent.futures import ProcessPoolExecutor
from inspect import signature, unwrap
from multiprocessing.connection import Connection
from typing import Any

import weasyprint
from weasyprint.layout import block

ADVICE = "pin the version before, or find another way"


class Drawn:
    """A picture that notes how it is asked for."""

    def __init__(self) -> None:
        self.sizes: list[tuple[float, float]] = []

    def get_intrinsic_size(self, _resolution: float, font_size: float) -> tuple[float, float, float]:
        return 2 * font_size, font_size, 2.0

    def draw(self, stream: Any, width: float, height: float, style: Any) -> None:
        stream.transform(1, 0, 0, 1, 0, 0)
        stream.set_color(style["color"])
        stream.stream.append("0 0 1 1 re f")
        self.sizes.append((width, height))


def test_weasyprint_takes_pictures_from_the_cache_that_it_is_given() -> None:
    picture = Drawn()
    page = '<p style="font-size: 12pt"><img src="data:formula,0" alt="formula"></p>'
    weasyprint.HTML(string=page).write_pdf(cache={"data:formula,0": picture})
    assert picture.sizes == [(32, 16)], (  # CSS pixels: two ems and one of 12 pt
        f"WeasyPrint {weasyprint.__version__} does not draw objects of its image cache any more, by which report/pages/pdf.py gives it "
        f"the outlines of formulas (pdf_math.Picture): {ADVICE}."
    )


def test_the_pool_of_processes_has_a_pipe_of_results_that_can_be_closed() -> None:
    with ProcessPoolExecutor(1) as executor:
        queue = getattr(executor, "_result_queue", None)
        assert isinstance(getattr(queue, "_writer", None), Connection), (
            "This Python's ProcessPoolExecutor has no _result_queue._writer any more, which study runs close to end a pool whose process died "
            f"in the middle of a result (study/execution/engines.py): {ADVICE}."
        )


def test_weasyprint_hands_on_where_a_block_is_to_stand_as_waiting_figures_take_it() -> None:
    taken = [*signature(unwrap(block.block_level_layout)).parameters]
    assert taken[2:] == [
        "bottom_space", "skip_stack", "containing_block", "page_is_empty", "absolute_boxes", "fixed_boxes", "adjoining_margins",
        "first_letter_style", "first_line_style", "discard", "max_lines",
    ], (
        f"WeasyPrint {weasyprint.__version__} lays out a block by other arguments, which report/pages/frames.py names by their order "
        f"(BlockPlace): figures would no longer wait for the next sheet. {ADVICE}."
    )  # fmt: skip
