"""The calculation of the rubber damper, chapter by chapter."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from diecut_report.api import Case, Chapter, Choice, Require, Value, Words, bind
from diecut_report.mechanics import common
from diecut_report.plugins.damper import advice
from diecut_report.plugins.damper import formulas as f

ENERGY = Chapter(
    "Energy and rubber",
    steps=(
        Value(id="kinetic_energy", symbol="W_k", unit="J", description="Kinetic energy at contact: as given", source="input",
              needs=("kinetic_energy",), formula=bind(common.same, quantity="inputs.kinetic_energy")),
        Value(id="kinetic_energy", symbol="W_k", unit="J", description="Kinetic energy at contact", source="energy",
              lacks=("kinetic_energy",), formula=f.rolling_energy),
        Value(id="elastic_modulus", symbol="E", unit="MPa", description="Elastic modulus of the rubber: as given", source="input",
              needs=("elastic_modulus",), formula=bind(common.same, quantity="inputs.elastic_modulus")),
        Value(id="elastic_modulus", symbol="E", unit="MPa", description="Elastic modulus from the hardness, with p_G = 0.0981 MPa",
              source="Gent 1958", lacks=("elastic_modulus",), formula=f.gent_modulus),
    ),
)  # fmt: skip

LENGTH = Chapter(
    "Length",
    text="The n dampers that act at once take up the energy as linear springs: W_k = n·P·h/2 (002 eq. 18–22). At the allowed stress "
    "this gives the length.",
    steps=(
        Value(id="area", symbol="S", unit="mm**2", description="Compressed area of one damper", source="002, after eq. 22",
              formula=f.pad_area),
        Value(id="free_length", symbol="H", unit="mm", description="Length of the free damper at the allowed stress",
              source="002 eq. 23, for n dampers", formula=f.free_length),
        Value(id="adopted_length", symbol="H_a", unit="mm", description="Adopted length: as given", source="input",
              needs=("adopted_length",), formula=bind(common.same, quantity="inputs.adopted_length")),
        Value(id="adopted_length", symbol="H_a", unit="mm", description="Adopted length: rounded up to the step", source="this method",
              lacks=("adopted_length",), formula=bind(f.whole_steps_above, length="free_length")),
    ),
)  # fmt: skip

LOAD = Chapter(
    "Load at the adopted length",
    steps=(
        Value(id="stress", symbol="σ", unit="MPa", description="Greatest compression stress", source="002 eq. 22", formula=f.stress),
        Value(id="strain", symbol="ε", description="Greatest strain", source="002 eq. 19", formula=f.strain),
        Value(id="peak_force", symbol="P", unit="N", description="Greatest force on one damper", source="002 eq. 20", formula=f.force),
        Value(id="deflection", symbol="h", unit="mm", description="Greatest deflection", source="002 eq. 21", formula=f.deflection),
    ),
)  # fmt: skip

LOSS = Chapter(
    "Loss of an impact",
    steps=(
        Require(id="one_loss", needs=("loss_fraction", "loss_tangent"), key="loss_tangent",
                condition=bind(f.is_missing, share="inputs.loss_fraction"),
                message="is given, and so is a loss_fraction of {inputs.loss_fraction}, but one follows from the other; leave one of them "
                "out"),
        Value(id="loss_fraction", symbol="ψ", description="Share of the energy that one impact loses: as given", source="input",
              needs=("loss_fraction",), lacks=("loss_tangent",), formula=bind(common.same, quantity="inputs.loss_fraction")),
        Value(id="loss_fraction", symbol="ψ", description="Share of the energy that one impact loses: usual for rubber",
              source="this method", lacks=("loss_fraction", "loss_tangent"), formula=bind(common.same, quantity=f.USUAL_LOSS)),
        Value(id="loss_fraction", symbol="ψ", description="Share of the energy that one impact loses: half a cycle",
              source="this method", needs=("loss_tangent",), formula=f.loss_of_half_cycle),
    ),
)  # fmt: skip

STOP = Chapter(
    "Stop and rebound",
    needs=("velocity",),
    absent="not calculated: velocity is not given",
    text="Mass and dampers swing as mass and spring: the stop is a quarter of the period.",
    steps=(
        Value(id="reduced_mass", symbol="m_red", unit="kg", description="Mass that has the energy at the speed of contact",
              source="energy", formula=f.reduced_mass),
        Value(id="stop_time", symbol="t_s", unit="ms", description="Time from contact to rest", source="this method",
              formula=f.stop_time),
        Value(id="peak_deceleration", symbol="a_max", unit="m/s**2", description="Greatest deceleration", source="this method",
              formula=f.peak_deceleration),
        Value(id="rebound_velocity", symbol="v_r", unit="m/s", description="Speed of the rebound", source="energy",
              formula=f.rebound_velocity),
    ),
)  # fmt: skip

HEAT = Chapter(
    "Heat",
    needs=("impacts_per_hour",),
    absent="not calculated: neither impacts_per_hour nor the press's productivity is given",
    steps=(
        Value(id="heat_power", symbol="N_h", unit="W", description="Heat that the dampers of one end give off", source="energy",
              formula=f.heat_power),
    ),
)  # fmt: skip

BUCKLING = Chapter(
    "Buckling",
    text="A block with clamped ends stays straight up to a length of three times its smaller side. Beside the slenderness stand the "
    "changes with which it does, each by itself; a wider pad or more dampers need a shorter length for the same energy.",
    steps=(
        Value(id="smaller_side", symbol="b", unit="mm", description="Smaller side of the pad", output=False,
              formula=bind(common.smaller_of, first="ring_width", second="pad_height")),
        Value(id="slenderness", symbol="λ", description="Length over the smaller side", source="this method",
              formula=bind(common.quotient, quantity="adopted_length", by="smaller_side")),
        Choice(id="length_limit", symbol="H_λ", unit="mm", description="Length up to which this pad does not buckle", source="this method",
               cases=(Case(f.whole_steps, "in whole steps", f.has_room_for),
                      Case(bind(f.three_sides, side="smaller_side"), "less than a step"))),
        Value(id="least_side", symbol="b_0", unit="mm", description="Least side of a square pad at this length", output=False,
              needs=("adopted_length",), formula=f.third),
        Value(id="least_side", symbol="b_0", unit="mm", description="Side of the square pad whose length is three sides", output=False,
              lacks=("adopted_length",), formula=f.side_of_square),
        Value(id="steady_pad_side", symbol="b_λ", unit="mm", description="Least side of a square pad that does not buckle",
              source="this method", formula=bind(f.whole_steps_above, length="least_side")),
        Value(id="steady_damper_count", whole=True, symbol="n_λ", description="Least number of dampers of this pad that does not buckle",
              source="this method", formula=f.steady_count),
        Value(id="steady_modulus", symbol="E_λ", unit="MPa", description="Greatest modulus with which this pad does not buckle",
              source="this method", formula=f.steady_modulus),
    ),
)  # fmt: skip

DRIVE = Chapter(
    "Drive still pushing",
    needs=("drive",),
    absent="not calculated: drive is not given",
    text="A drive that is not let go before the stop pushes on with a constant force. Its work over the deflection adds to the energy, "
    "½k·h² = W_k + F·h, and the dampers are pressed further.",
    steps=(
        Value(id="driving_force", symbol="F", unit="N", description="Force of the drive: as given", source="input",
              needs=("drive.force",), formula=bind(common.same, quantity="drive.force")),
        Value(id="driving_force", symbol="F", unit="N", description="Force of the drive", source="statics", lacks=("drive.force",),
              formula=bind(f.force_of_torque, torque="drive.torque", rolling_radius="drive.rolling_radius")),
        Value(id="stiffness", symbol="k", unit="N/mm", description="Stiffness of the dampers together", source="002 eq. 21",
              formula=f.stiffness),
        Value(id="driven_deflection", symbol="h_d", unit="mm", description="Greatest deflection with the drive", source="energy",
              formula=f.driven_deflection),
        Value(id="driving_work", symbol="A_d", unit="J", description="Work of the drive until the stop", source="energy",
              formula=f.driving_work),
        Value(id="driven_strain", symbol="ε_d", description="Greatest strain with the drive", source="002 eq. 18",
              formula=f.driven_strain),
        Value(id="driven_stress", symbol="σ_d", unit="MPa", description="Greatest stress with the drive", source="002 eq. 19",
              formula=f.driven_stress),
        Value(id="driven_peak_force", symbol="P_d", unit="N", description="Greatest force on one damper with the drive",
              source="002 eq. 20", formula=bind(f.force, stress="driven_stress")),
        Value(id="driven_peak_deceleration", symbol="a_d", unit="m/s**2", description="Greatest deceleration with the drive",
              source="dynamics", needs=("velocity",), formula=f.driven_deceleration),
        Value(id="driven_stop_time", symbol="t_d", unit="ms", description="Time from contact to rest with the drive",
              source="dynamics", needs=("velocity",), formula=f.driven_stop_time),
        Value(id="resting_deflection", symbol="h_0", unit="mm", description="Deflection in which the drive holds the dampers at rest",
              source="statics", formula=bind(common.quotient, quantity="driving_force", by="stiffness")),
        Value(id="stress_limit", symbol="σ_lim", unit="MPa", description="Stress within the allowed one and the linear law", output=False,
              formula=f.stress_limit),
        Value(id="force_limit", symbol="F_lim", unit="N", description="Force from which no length helps", source="energy",
              formula=f.force_limit),
        Value(id="driven_free_length", symbol="H_d", unit="mm", description="Least length that bears the drive",
              source="energy", formula=f.driven_length,
              exists=bind(common.is_below, smaller="driving_force", greater="force_limit")),
        Value(id="driven_length", symbol="H_da", unit="mm", description="Least length that bears the drive, rounded up to the step",
              source="this method", formula=bind(f.whole_steps_above, length="driven_free_length"),
              exists=bind(common.is_below, smaller="driving_force", greater="force_limit")),
        Value(id="driven_damper_count", whole=True, symbol="n_d", description="Least number of dampers of this pad and length that bears the drive",
              source="energy", formula=f.driven_count),
    ),
)  # fmt: skip

KNOWN = ("kinetic_energy", "elastic_modulus", "ring_width", "pad_height", "damper_count", "allowable_stress", "max_strain",
         "length_step")  # fmt: skip
"""What advice is made of, whatever is given."""


def advice_steps() -> Iterator[Words]:
    """The advice of failing checks, for each choice of what may be given beside: it is judged for all checks together."""
    optional = {"drive": "driving_force", "adopted_length": "adopted_length", "shore_hardness": "shore_hardness"}
    for count in range(len(optional) + 1):
        for given in combinations(optional, count):
            takes = (*KNOWN, *(optional[key] for key in given))
            lacks = tuple(key for key in optional if key not in given)
            yield Words(id="advice", output=False, needs=given, lacks=lacks, function=advice.advice(takes), takes=takes)


ADVICE = Chapter("Changes", steps=tuple(advice_steps()))

SECTIONS = (ENERGY, LENGTH, LOAD, LOSS, STOP, HEAT, BUCKLING, DRIVE, ADVICE)
