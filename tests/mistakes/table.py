"""Mistakes of authors: what each is, the text that it puts in place of another, where it is told, and in which words."""

from __future__ import annotations

from tests.mistakes.rows_chapters import CALLS, CHAPTERS, LAMBDAS
from tests.mistakes.rows_declared import DECLARED
from tests.mistakes.rows_formulas import FORMULAS
from tests.mistakes.rows_inputs import INPUTS, MODULE
from tests.mistakes.rows_names import NAMES, TWICE
from tests.mistakes.rows_numbers import DIMENSIONS, NUMBERS
from tests.mistakes.rows_silent import SILENT
from tests.mistakes.runner import Mistake

TABLE: tuple[Mistake, ...] = (
    *NAMES,
    *TWICE,
    *LAMBDAS,
    *CALLS,
    *CHAPTERS,
    *DECLARED,
    *INPUTS,
    *MODULE,
    *FORMULAS,
    *DIMENSIONS,
    *NUMBERS,
    *SILENT,
)
