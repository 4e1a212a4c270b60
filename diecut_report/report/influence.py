"""What matters, as the report prints it: a tornado for each number, with its table, and how probable it is that the checks hold."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

from diecut_report.quantities.formatting import number_text
from diecut_report.report.i18n import Catalogue
from diecut_report.report.number_format import quantity

Data = Mapping[str, Any]
DIGITS = 4
NUMBER = "1.{n}"  # of a figure: those of mechanisms begin with a letter


@dataclass(frozen=True)
class PrintedTornado:
    """Hold a number, its figure with the number of that, and a row for each input: its name, lowered and raised, and what comes of both."""

    title: str
    number: str
    figure: Data
    rows: list[tuple[str, str, str, str, str]]
    rest: str


@dataclass(frozen=True)
class ChanceRow:
    """Hold a check, how probable it is that it holds, with its interval, and in how many machines it did."""

    title: str
    probability: str
    interval: str
    held: str


@dataclass(frozen=True)
class PrintedInfluence:
    """Hold the chapter: its words, its tornados, and what tolerances do."""

    lead: str
    tornados: list[PrintedTornado]
    scatter: str = ""
    chances: list[ChanceRow] = field(default_factory=list)
    sure: str = ""

    @property
    def figures(self) -> list[tuple[str, Data]]:
        """The figures with their numbers; none of a number that nothing moves."""
        return [(each.number, each.figure) for each in self.tornados if each.rows]


def printed_influence(results: Data, words: Catalogue) -> PrintedInfluence | None:
    """Return the chapter as it is printed; None where the results hold none."""
    found = results.get("influence")
    if not found:
        return None
    lead = words.say("influence_lead", by=_percent(found["by"], words))
    tornados = [_tornado(results, each, index, words) for index, each in enumerate(found["tornados"], 1)]
    drawn = found.get("tolerances")
    if not drawn:
        return PrintedInfluence(lead, tornados)
    unsure = [drawn["whole"], *(each for each in drawn["checks"] if each["held"] < each["count"])]
    chances = [_chance(results, each, words) for each in unsure]
    sure = words.say("influence_sure", n=len(drawn["checks"]) - len(unsure) + 1)
    return PrintedInfluence(lead, tornados, _scatter(drawn, words), chances, sure)


def _tornado(results: Data, found: Data, index: int, words: Catalogue) -> PrintedTornado:
    title, unit = _title(results, found["name"], words), found["unit"]
    rows = [
        (bar["name"], _told(bar["lowered"], bar["unit"], words), _told(bar["low"], unit, words), _told(bar["raised"], bar["unit"], words),
         _told(bar["high"], unit, words))
        for bar in found["bars"]
    ]  # fmt: skip
    said = title + (f" ({_unit(unit)})" if _unit(unit) else "")
    figure = {"type": "tornado", "title": words.say("influence_on", what=said), "today": found["today"],
              "bars": [{"label": bar["name"], "low": bar["low"], "high": bar["high"]} for bar in found["bars"]]}  # fmt: skip
    now = words.say("influence_today", value=_told(found["today"], unit, words))
    return PrintedTornado(title, NUMBER.format(n=index), figure, rows, " ".join([now, *_rest(found, words)]))


def _rest(found: Data, words: Catalogue) -> Iterator[str]:
    if found["more"]:
        yield words.say("influence_more", n=found["more"])
    if found["still"]:
        yield words.say("influence_still", n=found["still"])
    if found.get("at_default"):
        yield words.say("influence_at_default", n=found["at_default"])


def _title(results: Data, name: str, words: Catalogue) -> str:
    """What a number is called: a check's utilisation, a result, or an input, by its mechanism."""
    home, _, own = name.partition(".")
    data = results["mechanisms"].get(home)
    if data is None:
        return name
    check = next((each for each in data["checks"] if own == f"checks.{each['id']}.utilisation"), None)
    if check is not None:
        return f"{data['title']} · {check['title']}: {words['influence_utilisation']}"
    row = data["outputs"].get(own) or data["inputs"].get(own)
    return f"{data['title']} · {row['description']}" if row else name


def _chance(results: Data, found: Data, words: Catalogue) -> ChanceRow:
    home, _, own = found["check"].partition(".")
    data = results["mechanisms"].get(home)
    check = next((each["title"] for each in data["checks"] if each["id"] == own), own) if data else ""
    title = f"{data['title']} · {check}" if data else words["influence_all"]
    interval = f"{_percent(found['low'], words)} … {_percent(found['high'], words)}"
    return ChanceRow(
        title,
        _percent(found["probability"], words),
        interval,
        words.say("influence_of", n=found["held"], total=found["count"]),
    )


def _scatter(drawn: Data, words: Catalogue) -> str:
    inputs = ", ".join(
        f"{each['name']} {_told(each['value'], each['unit'], words)} ± {_told(each['tolerance'], each['unit'], words)}"
        for each in drawn["inputs"]
    )
    return words.say(f"influence_{drawn['distribution']}", inputs=inputs, n=drawn["count"], seed=drawn["seed"])


def _told(value: float | None, unit: str, words: Catalogue) -> str:
    if value is None:
        return words["influence_none"]
    return quantity(number_text(value, DIGITS), unit, words["decimal"])


def _percent(share: float, words: Catalogue) -> str:
    return quantity(number_text(100 * share, DIGITS), "%", words["decimal"])


def _unit(unit: str) -> str:
    return "" if unit == "1" else quantity("", unit).strip()
