"""One of several groups of inputs: the torque, or the power with the speed."""

from __future__ import annotations

from diecut_report.api import Chapter, Inputs, Mechanism, OneOf, Quantity, m, value


class Motor(Inputs):
    one_of = (OneOf(("torque",), ("power", "speed")),)

    torque = Quantity("M", "N*m", "Torque", gt=0, optional=True)
    power = Quantity("P", "kW", "Power", gt=0, optional=True)
    speed = Quantity("n", "rpm", "Speed", gt=0, optional=True)
    ratio = Quantity("i", "1", "Ratio of the gear", gt=0)


torques = Chapter("Torques")
torques.motor_torque = value(m.torque, needs=("torque",)), "M_m", "N*m", "Torque of the motor"
torques.motor_torque = value(m.power / m.speed, needs=("power", "speed")), "M_m", "N*m", "Torque of the motor"
torques.gear_torque = m.motor_torque * m.ratio, "M_g", "N*m", "Torque behind the gear"

MECHANISM = Mechanism(
    kind="motor", version="1.0", title="Motor", summary="Torque behind a gear.", inputs=Motor, chapters=(torques,)
)

PRESS = """
mechanisms:
  by_torque: {kind: motor, torque: 10 N*m, ratio: 5}
  by_power: {kind: motor, power: 1.5 kW, speed: 1432 rpm, ratio: 5}
"""
GIVES = {"by_torque.gear_torque": "50 N*m", "by_power.gear_torque": "50.01 N*m"}
