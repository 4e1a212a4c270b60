"""The option ``--template`` of all commands that set a report: the folder of a firm's own templates."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from diecut_report.report.house_style import HouseStyle


def _read(_: click.Context, __: click.Parameter, given: Path | None) -> HouseStyle | None:
    if given is None:
        return None
    from diecut_report.house_folder import house_style

    return house_style(given)


template_option = click.option(
    "--template",
    "house",
    metavar="DIR",
    type=click.Path(path_type=Path),
    callback=_read,
    help="A folder with templates of your own, which override blocks of HTML and PDF.",
)
