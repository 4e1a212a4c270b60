"""A mechanism that names the shaft it is driven by, so that a part of the machine can stand for it: the shaft's loads and speed follow from there."""

from __future__ import annotations

import numpy as np

from diecut_report.api import Chapter, Inputs, Mechanism, Port, Quantity, abscissa, m, reduction, samples


class Stamp(Inputs):
    radius = Quantity("r", "mm", "Radius of the crank", gt=0)
    force = Quantity("F", "N", "Force on the stamp", gt=0)
    crank_speed = Quantity("ω", "rpm", "Speed of the crank", gt=0)
    n_points = samples(72)


turn = Chapter("Turn")
turn.angle = abscissa(2 * np.pi, speed="crank_speed"), "φ", "deg", "Angle of the crank"
turn.pin_force = m.force * np.sin(m.angle), "F_z", "N", "Force on the pin"
turn.torque = m.pin_force * m.radius * np.sin(m.angle), "T", "N*m", "Torque that the crank takes"
turn.mean_torque = reduction("mean", of="torque"), "T_m", "N*m", "Mean torque"

MECHANISM = Mechanism(
    kind="stamp", version="1.0", title="Stamp", summary="A stamp on a crank.", inputs=Stamp, chapters=(turn,),
    ports=(Port(name="crank", torque="torque", forces=("pin_force",), speed="crank_speed", radius=("radius",)),),
)  # fmt: skip

PRESS = """
press: {name: Example, productivity: 3600 1/h}
machine:
  {anchor: main, shaft_material: 42CrMo4+QT, required_life: 20000 h, stop: sleeve, frame: {main: [0, 0], motor: [0, 135]},
   gears: {sigma_h_lim: 767 MPa, sigma_f_lim: 314 MPa, grade: 8, hub_yield: 370 MPa}}
shafts:
  motor: {motor: {speed: 180 rpm}, parts: [{gear: pinion, at: 25, hub: 30}]}
  main:
    sections: 40x30 r1, 50x160 r1, 40x30
    parts:
      - {bearing: a, at: 21, designation: "6208"}
      - {gear: wheel, at: 90, hub: 40, key: 36}
      - {crank: disc, of: stamp.crank, at: 150, hub: 40, key: 36, plane: 10, mass: 1.5 kg}
      - {bearing: b, at: 199, designation: "6208", floating: true}
meshes:
  drive: {pair: [motor.pinion, main.wheel], teeth: 18/54, module: 3.75, width: 30}
mechanisms:
  stamp: {kind: stamp, radius: 40 mm, force: 800 N, crank_speed: 60 rpm}
"""
GIVES = {"stamp.mean_torque": "16 N*m", "machine_inertia.mass": "11.68 kg"}
