"""Chapter on the slack strand: it hangs as a catenary, whose parameter is a root."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import GRAVITY, Chapter, formula


@formula
def catenary_sag(catenary: Any, centre_distance: Any) -> Any:
    """Sag in the middle, c·(cosh u − 1) with u = a/(2c), written so that nothing cancels where the strand is nearly straight."""
    return 2 * catenary * np.sinh(centre_distance / (4 * catenary)) ** 2


@formula
def length_by_sag(catenary: Any, centre_distance: Any) -> Any:
    """Length of a catenary by its sag: s² = 4·f·(f + 2c), which holds no arc length in itself."""
    sag = catenary_sag(catenary, centre_distance)
    return 2 * np.sqrt(sag * (sag + 2 * catenary))


slack = Chapter(
    "Slack strand",
    text="The part of the chain that is neither on the upper strand nor on the sprockets hangs below, level between the sprockets. Its shape is "
    "a catenary y = c·cosh(x/c); the parameter c is the horizontal pull divided by the weight per unit length. Running changes its pull, "
    "not its shape.",
)
slack.value(
    "line_mass",
    "q_t",
    "kg/m",
    "Mass per length of a chain with its half of the bars",
    lambda mass_per_length, bar_mass, bar_spacing: mass_per_length + bar_mass / (2 * bar_spacing),
)
slack.value(
    "slack_length",
    "s",
    "mm",
    "Length of the slack strand",
    lambda links, pitch, elongation, teeth, centre_distance: (
        links * pitch * (1 + elongation) - teeth * pitch - centre_distance
    ),
    source="geometry",
)
slack.value(
    "links_around",
    "X_a",
    "1",
    "Links of two straight strands and the sprockets",
    lambda centre_distance, pitch, teeth, elongation: (2.0001 * centre_distance / pitch + teeth) / (1 + elongation),
    output=False,
)
slack.value(
    "links_least",
    "X_min",
    "1",
    "Minimum number of links with which the chain goes round",
    lambda links_around, bar_links: bar_links * np.ceil(links_around / bar_links),
    output=False,
    whole=True,
)
slack.require(
    "goes_round",
    lambda slack_length, centre_distance: slack_length > 1.00001 * centre_distance,
    key="links",
    message="is {links}, which leaves {slack_length} for a strand between axes {centre_distance} apart; take at least {links_least} links, or "
    "move the sprockets together",
)
slack.require(
    "does_not_fall",
    lambda slack_length, centre_distance: slack_length < 1.3 * centre_distance,
    key="links",
    message="is {links}, which leaves {slack_length} for a strand between axes {centre_distance} apart: it would hang down by more than a third "
    "of that; take fewer links, or move the sprockets apart",
)
slack.root(
    "catenary",
    "c",
    "mm",
    "Parameter of the catenary",
    lambda catenary, centre_distance, slack_length: (
        2 * catenary * np.sinh(centre_distance / (2 * catenary)) - slack_length
    ),
    low=lambda centre_distance, slack_length: centre_distance / (4 * np.sqrt(6 * (slack_length / centre_distance - 1))),
    high=lambda centre_distance, slack_length: centre_distance / np.sqrt(6 * np.log(slack_length / centre_distance)),
    left=lambda slack_length: slack_length,
    right=length_by_sag,
    source="statics",
)
slack.value("sag", "f", "mm", "Sag of the slack strand", catenary_sag, source="statics")
slack.value(
    "sag_share", "ζ", "%", "Ratio of the sag to the centre distance", lambda sag, centre_distance: sag / centre_distance
)
slack.value(
    "slack_tension",
    "F_s",
    "N",
    "Pull of the slack strand at the sprockets, of each chain",
    lambda line_mass, catenary, sag: line_mass * GRAVITY * (catenary + sag),
    source="statics",
)
slack.value(
    "parabola_tension",
    "F_p",
    "N",
    "Its horizontal component by the parabola formula",
    lambda line_mass, centre_distance, sag: line_mass * GRAVITY * centre_distance**2 / (8 * sag),
    source="Roloff/Matek",
)
slack.value(
    "parabola_error",
    "e_p",
    "%",
    "Error of the parabola formula",
    lambda parabola_tension, line_mass, catenary: 1 - parabola_tension / (line_mass * GRAVITY * catenary),
)
