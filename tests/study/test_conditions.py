"""The one language of conditions: what it means is the same on arrays, in the database and by plain Python; what it refuses."""

from __future__ import annotations

import math
import operator
import pickle
import time
from collections.abc import Callable, Iterator
from typing import Any

import duckdb
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from diecut_report.errors import UserError
from diecut_report.formulas.condition_numpy import judged, shortfall
from diecut_report.formulas.condition_parts import Name, read
from diecut_report.formulas.condition_tree import Node, names
from diecut_report.formulas.conditions import ConditionError
from diecut_report.formulas.tree import Node as Expression
from diecut_report.study.analysis.answers import SqlWriter, condition
from diecut_report.study.analysis.variants import StoredColumn
from diecut_report.study.definition.constraints import parse

COLUMNS = {
    column.name: column
    for column in (
        StoredColumn("n", "int"),
        StoredColumn("gap", "float", "m", "mm"),
        StoredColumn("my-drive.gap", "float", "m", "mm"),
        StoredColumn("mass", "float", "kg", "kg"),
        StoredColumn("speed", "float", "rad/s", "rpm"),
        StoredColumn("share", "float", "1", "%"),
        StoredColumn("ratio", "float"),
        StoredColumn("law", "text"),
        StoredColumn("slip", "bool"),
    )
}
ROWS: dict[str, list[Any]] = {
    "n": [0, 1, 2, 3, 4],
    "gap": [0.001, 0.002, 0.003, None, 0.005],
    "my-drive.gap": [0.002, 0.002, None, None, 0.002],
    "mass": [1.0, 4.0, 9.0, 16.0, None],
    "speed": [0.0, 1.0, 2.0, 10.0, -1.0],
    "share": [0.0, 0.05, 0.5, None, 1.0],
    "ratio": [-1.0, 0.0, 0.5, 2.0, None],
    "law": ["cycloidal", "harmonic", "5%_x", None, "sine_1"],
    "slip": [True, False, None, True, False],
}
TYPES = {"int": "BIGINT", "float": "DOUBLE", "text": "VARCHAR", "bool": "BOOLEAN"}


@pytest.fixture(scope="module")
def database() -> Iterator[duckdb.DuckDBPyConnection]:
    with duckdb.connect(":memory:") as made:
        columns = ", ".join(f"{column.sql} {TYPES[column.kind]}" for column in COLUMNS.values())
        made.execute(f"CREATE TABLE v ({columns})")
        made.executemany(f"INSERT INTO v VALUES ({', '.join('?' * len(ROWS))})", list(zip(*ROWS.values(), strict=True)))
        yield made


def name(called: str) -> Name:
    if called not in COLUMNS:
        raise ConditionError(f"{called!r} is unknown")
    column = COLUMNS[called]
    return Name(called, "number" if column.is_number else "truth" if column.kind == "bool" else "text", column.unit, column.display)  # fmt: skip


def tree(text: str) -> Node:
    return read(text, COLUMNS, name, "n > 1")


def on_arrays(node: Node) -> list[int]:
    return np.flatnonzero(judged(node, ROWS.__getitem__, 5).holds).tolist()


def in_database(node: Node, database: duckdb.DuckDBPyConnection) -> list[int]:
    sql = SqlWriter(COLUMNS).expression(node)
    found = database.execute(f"SELECT n FROM v WHERE {sql.text} ORDER BY n", list(sql.parameters)).fetchall()
    return [row[0] for row in found]


MEANINGS = [  # a condition, and the rows above that fulfil it, by hand
    ("n = 2", [2]),
    ("n == 2", [2]),
    ("n <> 2 AND n != 3", [0, 1, 4]),
    ("n ≠ 2 and n ≥ 1 And n ≤ 3", [1, 3]),
    ("gap = '1 mm'", [0]),
    ("gap < '2'", [0]),  # a bare number in quotes is in the unit that people read
    ("'1' < gap < '4'", [1, 2]),
    ("'1 mm' < gap < '5 mm'", [1, 2]),
    ("'0.1 cm' <= gap <= '2000 um'", [0, 1]),
    ("1 < n <= 3 != 2", [2, 3]),
    ("gap between '2 mm' and '3 mm'", [1, 2]),
    ("gap not between '2 mm' and '3 mm'", [0, 4]),
    ("not gap between '2 mm' and '3 mm' and n < 4", [0]),
    ("gap between '1 mm' + '1 mm' and 3 * '1 mm' or n = 0", [0, 1, 2]),
    ("n between 1 and 2 and n between (0) and (1)", [1]),
    ("(n between 1 and 2) = true", [1, 2]),
    ("gap in ('1 mm', '5', '7 m')", [0, 4]),
    ("gap not in ('1 mm', '5 mm')", [1, 2]),
    ("law in ('harmonic',)", [1]),
    ("law not in ('harmonic', 'sine_1')", [0, 2]),
    ("law = 'harmonic'", [1]),
    ("law != 'harmonic'", [0, 2, 4]),
    ('law = "harmonic"', [1]),
    ("law = 'it''s'", []),
    ("law > 'd'", [1, 4]),
    ("law = law", [0, 1, 2, 4]),
    ("law like '%cl%'", [0]),
    ("law like 'h%c' or law like '_y%'", [0, 1]),
    ("law like '5%'", [2]),
    ("law not like '%i%'", [2]),
    ("law is null", [3]),
    ("law is not null and n > 2", [4]),
    ("gap is null or slip is null", [2, 3]),
    ("slip", [0, 3]),
    ("not slip", [1, 4]),
    ("slip = false", [1, 4]),
    ("slip = (n > 2)", [1, 3]),
    ("slip < true", [1, 4]),
    ("(gap < '2 mm') is null", [3]),
    ("true", [0, 1, 2, 3, 4]),
    ("1 > 2", []),
    ("slip or n = 2", [0, 2, 3]),
    ("slip and n = 2 or n = 1", [1]),
    ("not (slip and n = 2)", [0, 1, 3, 4]),  # of the row 2 nobody knows
    ("not (gap > '2 mm')", [0, 1]),
    ("not not gap > '2 mm'", [2, 4]),
    ('"my-drive.gap" = gap', [1]),
    ("my-drive.gap = gap", [1]),
    ("gap-'1 mm' > 0", [1, 2, 4]),
    ("gap + my-drive.gap > '3.5 mm'", [1, 4]),
    ("gap * 2 <= '4'", [0, 1]),
    ("-gap < -'2 mm'", [2, 4]),
    ("--n = +2", [2]),
    ("2 ** n = 8", [3]),
    ("n ^ 2 = 9 or n**-1 = 1", [1, 3]),
    ("-n ** 2 = -4", [2]),  # as everywhere: the power comes first
    ("2 ** 3 ** n = 8", [1]),
    ("10 - 4 - n = 3", [3]),
    ("8 / 2 / (n + 1) = 2", [1]),
    ("sqrt(gap * gap) = gap and n < 2", [0, 1]),
    ("sqrt(mass) * sqrt(mass) < '5 kg'", [0, 1]),
    ("mass > 4 and mass <= 16", [2, 3]),  # people read kg, so a number stands alone
    ("abs(ratio) = 1", [0]),
    ("ABS(-n) = 1", [1]),
    ("max(gap, '3 mm') = gap", [2, 4]),
    ("min(n, 2, 3) = n", [0, 1, 2]),
    ("max(n) = 4", [4]),
    ("share < '10 %'", [0, 1]),
    ("share < '10'", [0, 1]),
    ("share * 2 >= '100 %'", [2, 4]),
    ("speed * gap > '1.5 mm/s'", [1, 2]),  # radians may be left out of a product
    ("speed > '9.55 rpm'", [2, 3]),
    ("speed > 0", [1, 2, 3]),
    ("speed > abs(0) or share = 1 - 1", [0, 1, 2, 3]),
    # what has no value decides nothing, and is null
    ("1 / n > 0", [1, 2, 3, 4]),
    ("1 / n < 5", [1, 2, 3, 4]),
    ("not 1 / n > 5", [1, 2, 3, 4]),
    ("1 / n is null", [0]),
    ("1 / (1 / n) = n", [1, 2, 3, 4]),
    ("min(1 / n, 5) = 5 or n = 1", [1]),
    ("max(ratio, 1) = 1", [0, 1, 2]),
    ("min(ratio, 1) is null", [4]),
    ("sqrt(ratio) >= 0", [1, 2, 3]),
    ("sqrt(ratio) is not null", [1, 2, 3]),
    ("ratio ** 0.5 is null", [0, 4]),
    ("ratio ** 0 = 1", [0, 1, 2, 3]),
    ("1 ** ratio = 1", [0, 1, 2, 3]),
    ("1 ** sqrt(ratio) = 1", [1, 2, 3]),
    ("(10 ** 300) * (10 ** n) ** 100 > 0", [0]),  # greater than any number
    ("0 * (1 / n) = 0", [1, 2, 3, 4]),
]


@pytest.mark.parametrize(("text", "rows"), MEANINGS, ids=[text for text, _ in MEANINGS])
def test_a_condition_means_the_same_everywhere(text: str, rows: list[int], database: duckdb.DuckDBPyConnection) -> None:
    node = tree(text)
    assert on_arrays(node) == rows
    assert in_database(node, database) == rows


# --- refused ---------------------------------------------------------------------------------------------------------

REFUSED = [
    ("gap < '1 N'", "gap is a length and '1 N' is a force; < needs the same kind on both sides", 7),
    ("n < 3 and mass < gap", "mass is a mass and gap is a length", 18),
    ("gap < 2", "gap is a length and 2 is a pure number; a number beside gap needs mm, for example '2 mm'", 7),
    ("gap < 2 / 3", "a number beside gap needs mm, for example '5 mm'", 7),
    ("share < 0.1", "a number beside share needs %, for example '0.1 %'", 9),
    ("gap < 2 mm", "“2 mm”: put a quantity in quotes: '2 mm'", 7),
    ("gap < 2e-3m*s", "put a quantity in quotes: '2e-3 m*s'", 7),
    ("share < 5%", "“5%”: put a quantity in quotes: '5 %'", 9),
    ("gap < '2,500 mm'", "2500 mm or 2.500 mm", 7),
    ("n < 2,5", "',' is not expected here", 6),
    ("speed < '1 Hz'", "speed is an angular speed and '1 Hz' is a frequency", 9),
    ("2 * speed < '1 Hz'", "an angular speed", 13),
    ("law = slip", "a text and a condition", 7),
    ("law + 1 < 2", "law is a text; a quantity is needed", 1),
    ("n like '3'", "a column of words", 8),
    ("law like law", "a pattern in quotes", 10),
    ("law like 'a' + 'b'", "'like' does not fit here", 5),
    ("n in (1) + 2", "does not fit here", 6),
    ("n in 3", "'(' is missing before '3'", 6),
    ("n in ()", "is missing before ')'", 7),
    ("n not = 3", "'in', 'between' or 'like' is missing after 'not'", 7),
    ("n is 3", "'null' is missing before '3'", 6),
    ("n = null", "is missing before 'null'", 5),
    ("n between 1 or 2", "'and' is missing before 'or': write between … and …", 13),
    ("n between 1", "'and' is missing before the end", 12),
    ("(n between 1) and 2", "'and' is missing before ')'", 13),
    ("n between not 1 and 2", "is missing before 'not'", 11),
    ("n < not 1", "is missing before 'not'", 5),
    ("1 < n in (2, 3)", "does not fit here; use brackets", 10),
    ("n between 1 and 2 < 3", "does not fit here; use brackets", 17),
    ("(n, 2) = 3", "',' is not expected here", 3),
    ("() = n", "is missing before ')'", 2),
    ("n < 3)", "')' is not expected here", 6),
    ("(n < 3", "')' is missing before the end", 7),
    ("law = 'a' 'b'", "'b' is not expected here", 11),
    ("gap and n = 1", "gap is not a condition; 'and' stands between conditions", 1),
    ("not gap", "gap is not a condition; 'not' stands before a condition", 5),
    ("n + 1", "the calculated side is not a condition; a comparison is needed, such as n > 1", 1),
    ("nn = 3", "'nn' is unknown", 1),
    ("sgrt(n) = 3", "there is no function 'sgrt' (did you mean 'sqrt'?); known: abs, min, max, sqrt", 1),
    ("abs() = 3", "abs takes one quantity; 0 given", 1),
    ("gap ** n > 0", "the exponent of gap must be a number between -20 and 20", 8),
    ("gap ** 21 > 0", "must be a number between -20 and 20", 8),
    ("gap ** (1 / 0) > 0", "must be a number between -20 and 20", 9),
    ("n < 1e999", "too large", 5),
    ("", "the condition is empty", 1),
]  # fmt: skip


@pytest.mark.parametrize(("text", "words", "character"), REFUSED, ids=[text for text, *_ in REFUSED])
def test_what_cannot_be_said_is_told_with_its_place(text: str, words: str, character: int) -> None:
    with pytest.raises(ConditionError) as caught:
        tree(text)
    assert words in caught.value.words
    assert caught.value.place == character - 1


HOSTILE = [
    "n = 1; DROP TABLE v",
    "n = 1 -- and so on",
    "n = 1 /* all */",
    "law = 'x' UNION SELECT 1",
    "n = (SELECT 1)",
    "read_text('/etc/passwd') = 'x'",
    'law = "v"."n"',
    "n = $1",
    "n = ?",
    "__import__('os').system('true') = 0",
    "n.__class__ = 1",
    "().__class__ = 1",
    "n = (x := 3)",
    "(lambda: n)() = 1",
    "law = f'{n}'",
    "law = b'x'",
    "law = '\\",
    "n = 1 \\\n",
    "n = 1 # and so on",
    "n = {1}",
    "n = [1]",
    "n[0] = 1",
    "n = 1 if n else 2",
    "n = *n",
    "max(*n) = 1",
    "max(**n) = 1",
    "max(n for n in n) = 1",
    "_0 = 1",
    "~n = 1",
    "n @ n = 1",
    "n // 2 = 1",
    "n & 1 = 1",
    "await n = 1",
    "yield = 1",
    "None is null",
    "n = 0x10",
    "n = 1j",
    "n = 1\0",
    "n\u200b = 1",
    "(" * 50 + "n" + ")" * 50 + " = 1",
    "(" * 20_000,
    "abs(" * 41 + "n" + ")" * 41 + " = 1",
    "(1 - 2 * " * 39 + "n" + ")" * 39 + " < 1 and (" * 3,
    "-" * 401 + "n = 1",
    "n = 1 and " * 4000 + "n = 1",
    "law = '" + "x" * 40_000 + "'",
    "'" * 39_999,
    "9" * 40_000 + " = n",
    "2 ** " * 150 + "2 = n",
]


def term(path: str) -> tuple[Name, Expression]:
    found = name(path)
    return found, Expression("sym", (path,))


@pytest.mark.parametrize("text", HOSTILE, ids=[text[:30] for text in HOSTILE])
def test_hostile_texts_are_refused_in_words_and_at_once(text: str) -> None:
    began = time.perf_counter()
    with pytest.raises(UserError) as asked:
        condition(text, COLUMNS)
    with pytest.raises(ConditionError) as held:
        parse(text, term, COLUMNS)
    assert time.perf_counter() - began < 1.0
    assert str(asked.value).startswith("The condition “") and len(str(asked.value)) < 2000
    assert len(str(held.value)) < 2000


def test_a_pattern_of_many_gaps_is_held_at_once() -> None:
    node = read(f"law like '{'%a' * 60}%b'", {"law"}, name, "n > 1")
    began = time.perf_counter()
    assert not judged(node, lambda _: ["a" * 200], 1).holds.any()
    assert time.perf_counter() - began < 1.0


@pytest.mark.parametrize("text", ["-" * 390 + "n = 1", "not " * 390 + "slip", "n" + " + n" * 190 + " > 5"])
def test_long_conditions_that_are_no_deep_ones_are_taken(text: str, database: duckdb.DuckDBPyConnection) -> None:
    node = pickle.loads(pickle.dumps(tree(text)))
    assert on_arrays(node) == in_database(node, database) != []


# --- any condition ---------------------------------------------------------------------------------------------------
# Each example is a text with the function that says of a row what it means: a number, True, False or None.

Row = dict[str, Any]
Meant = tuple[str, Callable[[Row], Any]]
Form = tuple[str, Callable[..., Any]]  # a text with places, and what it means by what stands there
SIGNS = {"<": operator.lt, "<=": operator.le, "=": operator.eq, "!=": operator.ne, ">": operator.gt, ">=": operator.ge}
ARITHMETIC = {"+": operator.add, "-": operator.sub, "*": operator.mul, "/": operator.truediv}


def of_numbers(made: Callable[..., Any]) -> Callable[..., Any]:
    """A function that is None where one of its numbers is, or what it makes of them is no finite number."""

    def value(*given: Any) -> Any:
        try:
            found = None if None in given else made(*given)
        except (ZeroDivisionError, ValueError):
            return None
        return found if found is None or math.isfinite(found) else None

    return value


def joined(decides: bool) -> Callable[[Any, Any], Any]:
    """What ``or`` means where true decides, ``and`` where false does; None where nobody knows."""
    return lambda *given: decides if decides in given else None if None in given else not decides


def chained(first: str, second: str) -> Callable[[Any, Any, Any], Any]:
    one, two = of_numbers(SIGNS[first]), of_numbers(SIGNS[second])
    return lambda low, middle, high: joined(False)(one(low, middle), two(middle, high))


MISSING: Form = ("({}) is null", lambda given: given is None)
CALCULATED: list[Form] = [
    *((f"({{}}) {sign} ({{}})", of_numbers(made)) for sign, made in ARITHMETIC.items()),
    *((f"{made.__name__}({{}}, {{}})", of_numbers(made)) for made in (min, max)),
]
COMPARED: list[Form] = [
    *((f"{{}} {sign} {{}}", of_numbers(made)) for sign, made in SIGNS.items()),
    *((f"{{}} {first} {{}} {second} {{}}", chained(first, second)) for first in SIGNS for second in SIGNS),
    ("{1} between {0} and {2}", chained("<=", "<=")),
    MISSING,
]
LOGIC: list[Form] = [
    ("({}) and ({})", joined(False)),
    ("({}) or ({})", joined(True)),
    ("not ({})", lambda given: None if given is None else not given),
    MISSING,
]


def made(forms: list[Form], inner: st.SearchStrategy[Meant]) -> st.SearchStrategy[Meant]:
    """One of the forms with anything in its places."""

    def filled(form: Form) -> st.SearchStrategy[Meant]:
        text, means = form
        return st.tuples(*[inner] * text.count("{")).map(
            lambda parts: (text.format(*(part for part, _ in parts)), lambda row: means(*(of(row) for _, of in parts)))
        )

    return st.sampled_from(forms).flatmap(filled)


def column(called: str) -> Meant:
    return called, lambda row: row[called]


def literal(value: int) -> Meant:
    return str(value), lambda _: float(value)


LEAVES = st.sampled_from(["n", "ratio"]).map(column) | st.integers(0, 4).map(literal)
VALUES = st.recursive(LEAVES, lambda inner: made(CALCULATED, inner), max_leaves=6)
COMPARISONS = made(COMPARED, VALUES) | st.just(column("slip"))
CONDITIONS = st.recursive(COMPARISONS, lambda inner: made(LOGIC, inner), max_leaves=5)


@settings(max_examples=60, deadline=None)
@given(CONDITIONS)
def test_any_condition_means_what_plain_python_says(database: duckdb.DuckDBPyConnection, meant: Meant) -> None:
    text, holds = meant
    expected = [n for n in range(5) if holds({key: values[n] for key, values in ROWS.items()}) is True]
    node = tree(text)
    assert on_arrays(node) == expected, text
    assert in_database(node, database) == expected, text
    assert set(names(node)) <= {"n", "ratio", "slip"}


@pytest.mark.parametrize("bound", [1.0, 0.0, -1.0])
@pytest.mark.parametrize("sides", ["n >= {}", "{} <= n"])
def test_a_row_that_is_nearer_to_where_a_condition_holds_falls_less_short(bound: float, sides: str) -> None:
    """On whichever side of zero row and bound lie."""
    values = {"n": np.array([-8.0, -5.0, -2.0, -1.5, bound, 4.0])}
    short = shortfall(tree(sides.format(f"{bound:g}")), lambda name: values[name], 6)
    assert (np.diff(short)[: 4 if bound > -1.5 else 3] < 0).all() and (short[:4] < 1).all()
    assert (short[4:] == 0).all()
