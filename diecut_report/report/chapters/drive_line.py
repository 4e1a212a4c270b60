"""The drive line as page 1 shows it: its views, and of each part how it looks, what is said of it, and where it leads."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

from diecut_report.report.model import utilisation
from diecut_report.report.text import Catalogue, tidy
from diecut_report.results.mechanism_record import CheckRecord
from diecut_report.results.model import DriveLineRecord, RatingRecord

LOW, MIDDLE = 0.5, 0.8  # utilisations up to which a part has its colours
TONES = ("low", "middle", "high", "fail")
"""How much of a part is used, the least first; the last one does not hold."""
VIEWS = ("front_view", "side_view")
Key = tuple[str, str]
"""Kind and name of a shaft, a part or a join."""


class PartLook(NamedTuple):
    """Hold how a part looks: its tone (empty where nothing judges it), its state, its utilisation, what is said of it, where it leads."""

    tone: str
    state: str
    used: str
    ratio: float
    text: str
    link: str


@dataclass(frozen=True)
class DriveLineFigure:
    """Hold a view of the drive line; ``checks`` by the calculations that the results hold, ``links`` are their addresses."""

    type: str
    line: DriveLineRecord
    checks: Mapping[str, Sequence[CheckRecord]]
    links: Mapping[str, str]
    words: Catalogue
    error: str = ""

    @property
    def title(self) -> str:
        """Return what stands below it."""
        return self.words[self.type]

    @property
    def caption(self) -> str:
        """Return what is to be seen in it, and how."""
        return self.words[f"{self.type}_caption"]

    @cached_property
    def looks(self) -> dict[Key, PartLook]:
        """Return how each shaft, part and join looks, by kind and name."""
        every: list[tuple[Key, RatingRecord]] = [(("shaft", each.name), each.rating) for each in self.line.shafts]
        every += [((each.kind, each.name), each.rating) for shaft in self.line.shafts for each in shaft.parts]
        every += [((each.kind, each.name), each.rating) for each in self.line.joins]
        return {key: self._look(key[1], rating) for key, rating in every}

    def _look(self, name: str, rating: RatingRecord) -> PartLook:
        own = self.checks.get(rating.calculation, ())
        check = next((each for each in own if each.id == rating.check), None)
        words, state = self.words, self.words[f"part_{rating.state}"]
        link = self.links.get(rating.calculation, "")
        if check is None:
            return PartLook("", rating.state, "", -1.0, f"{name}: {state}", link)
        used = utilisation(check.utilisation, check.status, words["decimal"])
        said = [f"{tidy(check.title)} {used}", words[check.status]]
        said += [] if rating.state == "rated" else [state]
        ratio = (check.utilisation or 0.0) + 1e6 * (check.status == "fail")
        return PartLook(_tone(check), rating.state, used, ratio, f"{name}: {', '.join(said)}", link)


def _tone(check: CheckRecord) -> str:
    ratio = check.utilisation or 0.0
    if check.status != "pass":
        return "fail" if check.status == "fail" else "high"
    return "low" if ratio <= LOW else "middle" if ratio <= MIDDLE else "high"


def drive_line_figures(
    line: DriveLineRecord | None, checks: Mapping[str, Sequence[CheckRecord]], links: Mapping[str, str], words: Catalogue
) -> list[DriveLineFigure]:  # fmt: skip
    """Return the views of a drive line; none where there is none. Of a frame without axes there is no front view."""
    if line is None:
        return []
    shown = VIEWS if any(each.axis for each in line.shafts) else VIEWS[1:]
    return [DriveLineFigure(view, line, checks, links, words) for view in shown]
