"""Figures of the drive train."""

from __future__ import annotations

from diecut_report.api import Level, Mark, Panel, Plot, Series
from diecut_report.plugins.drive_train.chain_figure import CHAIN
from diecut_report.plugins.drive_train.toothed_belt_figure import TOOTHED_BELT_FIGURES
from diecut_report.plugins.drive_train.vbelt_figure import VBELT_LAYOUT

TURN = Plot(
    id="energy",
    title="Torque and energy over a turn",
    caption="Torque at the flywheel shaft, negative where the load drives, with its mean, which the motor delivers; and the excess energy that "
    "the load has taken since the start of the revolution. The fluctuation ΔE is the height between the dashed lines.",
    abscissa="output_angle",
    needs=("torque_curve",),
    panels=(
        Panel(
            title="Torque at the flywheel's shaft",
            unit="N*m",
            series=(Series(curve="flywheel_torque", label="torque"),),
            levels=(Level(value="flywheel_torque_mean", label="mean"),),
        ),
        Panel(
            title="Energy from the flywheel",
            unit="J",
            series=(Series(curve="excess_energy", label="energy"),),
            levels=(
                Level(value="excess_energy_max", label="upper end of ΔE"),
                Level(value="excess_energy_min", label="lower end of ΔE"),
            ),
            marks=(
                Mark(x="excess_energy_max_at", y="excess_energy_max", label="flywheel slowest"),
                Mark(x="excess_energy_min_at", y="excess_energy_min", label="flywheel fastest"),
            ),
        ),
    ),
)

FIGURES = (CHAIN, VBELT_LAYOUT, TURN, *TOOTHED_BELT_FIGURES)
