"""Example of a pair of gears: from the main shaft to the crank's, with which a configuration begins."""

from __future__ import annotations

from diecut_report.api import ExampleBlock, Wired

EXAMPLE = ExampleBlock(
    "main_gears",
    {
        "module": "5 mm",
        "teeth_1": 24,
        "teeth_2": 48,
        "face_width": "50 mm",
        "torque": Wired("${<cylinder_drive>.crank_torque}", otherwise="500 N*m"),
        "torque_on": "wheel",
        "application_factor": Wired(1, needs=("cylinder_drive",), otherwise=1.25),  # a curve holds the dynamics
        "dynamic_factor": 1.1,
        "face_load_factor": 1.3,
        "transverse_load_factor": 1.1,
        "sigma_h_lim_1": "767 MPa",
        "sigma_h_lim_2": "767 MPa",
        "sigma_f_lim_1": "314 MPa",
        "sigma_f_lim_2": "314 MPa",
    },
)
