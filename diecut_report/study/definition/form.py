"""The form of a study file: its fixed keys, and the forms in which the values of a varied path may be given."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field, create_model

from diecut_report.config.model import ConfigDocument
from diecut_report.contract.inputs import Block, Quantity, Text
from diecut_report.study.definition.base_inputs import Input

DRAWN = ("latin_hypercube", "sobol")
LISTED = ("grid", "zip")
DISTRIBUTIONS = ("uniform", "normal", "triangular")

COUNT = Quantity("n", "1", "Number of variants of latin_hypercube and sobol", ge=1, le=1e12, integer=True)
SEED = Quantity(
    "", "1", "Seed of latin_hypercube and sobol; equal seeds give equal samples", ge=0, le=2**53, integer=True
)


class SampleForm(Block):
    """Declare how the variants are taken from what is varied."""

    method: Annotated[
        Literal["grid", "zip", "latin_hypercube", "sobol", "table"],
        Text(
            "grid: each value with each; zip: the first values together, the second together …; "
            "latin_hypercube, sobol: count variants spread over all; table: the rows of a file"
        ),
    ]
    count: Annotated[int | None, COUNT] = None
    seed: Annotated[int | None, SEED] = None
    indices: Annotated[
        bool, Text("For sobol: count groups of variants from which first and total Sobol indices follow")
    ] = False
    file: Annotated[
        str | None, Text("For table: a CSV, Parquet or XLSX file with paths and units as heads, `PATH [rpm]`")
    ] = None


class ObjectiveForm(Block):
    """Declare an output that is to be as small or as great as can be."""

    minimise: Annotated[str | None, Text("An output, such as cylinder.mass, that is to be small")] = None
    maximise: Annotated[str | None, Text("An output that is to be great")] = None


SEARCH_SEED = Quantity("", "1", "Seed of the search; equal seeds search alike", ge=0, le=2**53, integer=True)


class OptimiseForm(Block):
    """Declare what `optimise` searches for, and how long."""

    objectives: Annotated[
        list[ObjectiveForm] | None,
        Text("What is to be small or great: outputs, or varied inputs such as press.productivity; without it those of the study"),
    ] = None  # fmt: skip
    evaluations: Annotated[
        int, Quantity("", "1", "Machines that are tried", ge=1, le=1e8, integer=True)
    ] = 2000  # fmt: skip
    population: Annotated[
        int | None, Quantity("", "1", "Machines of a generation; without it a fortieth of all, 40 to 500", ge=4, le=1e5, integer=True)
    ] = None  # fmt: skip
    seed: Annotated[int, SEARCH_SEED] = 1
    passing: Annotated[bool, Text("Only machines of which no check fails")] = True
    points: Annotated[
        int, Quantity("", "1", "Points of the front that are listed, and calculated again one by one", ge=1, le=1000, integer=True)
    ] = 20  # fmt: skip


Texts = Annotated[list[Annotated[str, Field(min_length=1)]], Field(default_factory=list)]


class StudyDocument(Block):
    """Declare the whole study file; what is varied is judged path by path."""

    schema_version: Annotated[Literal[1], BeforeValidator(ConfigDocument.a_number)]
    base: Annotated[str, Text("The config that is varied, beside the study file"), Field(min_length=1)]
    sample: Annotated[SampleForm | None, Text("How the variants are taken; not needed beside optimise")] = None
    vary: Annotated[
        dict[str, Any], Text("For each varied path its values: a list, a range or a distribution"),
        Field(default_factory=dict),
    ]  # fmt: skip
    constraints: Annotated[
        Texts, Text("What must hold between inputs, and of outputs; variants where it does not are dropped")
    ]
    outputs: Annotated[
        list[str] | None, Text("The outputs to keep, such as drive.crank_torque_peak; without it all")
    ] = None
    curves: Annotated[Texts, Text("The curves to keep; without it none")]
    objectives: Annotated[list[ObjectiveForm], Text("What is to be small or great"), Field(default_factory=list)]
    optimise: Annotated[OptimiseForm | None, Text("What the command optimise searches for in what is varied")] = None
    reports: Annotated[  # judged as a whole where the sample is known: of each kind of value two faults would be told
        Any,
        Text("The variants that get a full report: none, failed, best N, all, or a list of numbers"),
    ] = None


def value_form(asked: Input) -> type[Block]:
    """Return one value of a list."""
    return create_model("One", __base__=Block, value=(asked.declared_as, ...))


def range_form(asked: Input) -> type[Block]:
    """Return values from … to."""
    keys: dict[str, Any] = {"from": (asked.declared_as, ...), "to": (asked.declared_as, ...)}
    keys["count"] = (
        Annotated[int | None, Quantity("", "1", "Number of values", ge=1, le=1e9, integer=True)],
        None,
    )
    keys["spacing"] = (Annotated[Literal["linear", "log"], Text("Equal steps, or equal ratios")], "linear")
    return create_model("Range", __base__=Block, **keys)


def distribution_form(asked: Input, name: str) -> type[Block]:
    """Return a distribution with its limits; its standard deviation has the input's unit, but not its bounds."""
    assert isinstance(asked.meta, Quantity)
    value = asked.declared_as
    limit = (Annotated[float | None, *asked.metadata], None)
    deviation = Annotated[float, Quantity("", asked.meta.unit, "Standard deviation", gt=0)]
    mean = Annotated[float, replace(asked.meta, integer=False)]
    keys: dict[str, dict[str, Any]] = {
        "uniform": {"low": (value, ...), "high": (value, ...)},
        "normal": {"mean": (mean, ...), "sd": (deviation, ...), "low": limit, "high": limit},
        "triangular": {"low": (value, ...), "mode": (value, ...), "high": (value, ...)},
    }
    given: Any = (Annotated[Literal["uniform", "normal", "triangular"], Text("Form of the distribution")], ...)
    return create_model(name.capitalize(), __base__=Block, **({"distribution": given} | keys[name]))


class TableForm(Block):
    """Declare the values of a column of a file."""

    table: Annotated[str, Text("A CSV, Parquet or XLSX file beside the study file"), Field(min_length=1)]
    column: Annotated[str | None, Text("The column; without it the one named as the path")] = None
