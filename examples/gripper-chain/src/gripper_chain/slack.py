"""Chapter on the slack strand: it hangs as a catenary, whose parameter is a root."""

from __future__ import annotations

import numpy as np

from diecut_report.api import GRAVITY, Chapter, inner, m, root

# fmt: off

slack = Chapter(
    "Slack strand",
    text="The part of the chain that is neither on the upper strand nor on the sprockets hangs below, level between the sprockets. Its shape is "
    "a catenary y = c·cosh(x/c); the parameter c is the horizontal pull divided by the weight per unit length. Running changes its pull, "
    "not its shape.",
)
slack.line_mass = (m.mass_per_length + m.bar_mass / (2 * m.bar_spacing),
    "q_t", "kg/m", "Mass per length of a chain with its half of the bars")
slack.slack_length = (m.links * m.pitch * (1 + m.elongation) - m.teeth * m.pitch - m.centre_distance,
    "s", "mm", "Length of the slack strand", "geometry")
slack.links_around = (inner((2.0001 * m.centre_distance / m.pitch + m.teeth) / (1 + m.elongation)),
    "X_a", "1", "Links of two straight strands and the sprockets")
slack.links_least = (inner(m.bar_links * np.ceil(m.links_around / m.bar_links), whole=True),
    "X_min", "1", "Minimum number of links with which the chain goes round")
slack.require("goes_round", m.slack_length > 1.00001 * m.centre_distance, key="links",
    message="is {links}, which leaves {slack_length} for a strand between axes {centre_distance} apart; take at least {links_least} links, or "
    "move the sprockets together")
slack.require("does_not_fall", m.slack_length < 1.3 * m.centre_distance, key="links",
    message="is {links}, which leaves {slack_length} for a strand between axes {centre_distance} apart: it would hang down by more than a third "
    "of that; take fewer links, or move the sprockets apart")
# The sag c·(cosh u − 1) with u = a/(2c), written so that nothing cancels where the strand is nearly straight. By it s² = 4·f·(f + 2c), which
# holds no arc length in itself and so proves the root.
sag = 2 * m.catenary * np.sinh(m.centre_distance / (4 * m.catenary)) ** 2
longer = m.slack_length / m.centre_distance
slack.catenary = (root(2 * m.catenary * np.sinh(m.centre_distance / (2 * m.catenary)) - m.slack_length,
        low=m.centre_distance / (4 * np.sqrt(6 * (longer - 1))), high=m.centre_distance / np.sqrt(6 * np.log(longer)),
        left=m.slack_length, right=2 * np.sqrt(sag * (sag + 2 * m.catenary))),
    "c", "mm", "Parameter of the catenary", "statics")
slack.sag = sag, "f", "mm", "Sag of the slack strand", "statics"
slack.sag_share = m.sag / m.centre_distance, "ζ", "%", "Ratio of the sag to the centre distance"
slack.slack_tension = (m.line_mass * GRAVITY * (m.catenary + m.sag),
    "F_s", "N", "Pull of the slack strand at the sprockets, of each chain", "statics")
slack.parabola_tension = (m.line_mass * GRAVITY * m.centre_distance**2 / (8 * m.sag),
    "F_p", "N", "Its horizontal component by the parabola formula", "Roloff/Matek")
slack.parabola_error = (1 - m.parabola_tension / (m.line_mass * GRAVITY * m.catenary),
    "e_p", "%", "Error of the parabola formula")
