"""Loads of a shaft over one cycle of the machine, from the curves of the mechanisms that it drives or that drive it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from math import isclose
from typing import Any

import numpy as np
from numpy.typing import NDArray

from diecut_report.api import (
    Block,
    Chapter,
    ExampleBlock,
    GivenMechanism,
    Inputs,
    Mechanism,
    MechanismInput,
    Phrase,
    Quantity,
    Refusal,
    Text,
    Wired,
    abscissa,
    block,
    computed_curve,
    inner,
    m,
    parts,
    pi,
    samples,
)
from diecut_report.mechanics.timing.engagement import motor_response
from diecut_report.mechanics.timing.intervals import exact_turns
from diecut_report.mechanics.timing.shaft_curves import PIECES, PieceRows, ShaftCurve, with_losses

# fmt: off


class LoadCurve(Block):
    """A curve of a mechanism, and how it is taken over."""

    name = Text("Name of the part that it acts on")
    mechanism = MechanismInput("Mechanism whose curve it is")
    curve = Text("Name of the curve")
    turns_per_sheet = Text("Revolutions of the mechanism's shaft per sheet, a number or a ratio such as 1/2", symbol="i", default="1")
    offset = Quantity("Φ_0", "deg", "Main-shaft angle of the mechanism's own zero", ge=-3600, le=3600, default=0)
    ratio = Quantity("k", "1", "Factor on the curve; negative where it acts the other way", default=1)


class Torque(LoadCurve):
    """A torque on a part."""

    inertia = Quantity("J", "kg*m**2", "Inertia that turns an angular acceleration into a torque; 0 for a torque", ge=0, default=0)
    efficiency = Quantity("η", "1", "Efficiency of the way from this shaft to the torque", gt=0, le=1, default=1)
    lag = Quantity("Φ_τ", "deg", "Angle of the main shaft in the time constant with which a motor behind a flywheel follows the torque; 0: at once",
        ge=0, default=0)


class Force(LoadCurve):
    """A force on a part."""

    turns_per_sheet = Text("Revolutions of the mechanism's shaft per sheet, a number or a ratio such as 1/2", symbol="i_F", default="1")
    offset = Quantity("Φ_F", "deg", "Main-shaft angle of the mechanism's own zero", ge=-3600, le=3600, default=0)
    ratio = Quantity("k_F", "1", "Factor on the curve; negative where it acts the other way", default=1)
    inertia = Quantity("J_F", "kg*m**2", "Inertia that turns an angular acceleration into a torque; 0 for others", ge=0, default=0)
    lever = Quantity("r", "mm", "Radius at which a torque acts as this force; 0 for a force", ge=0, default=0)
    absolute = Text("The curve counts by its absolute value: the pull of a chain on its sprocket", default=False)
    constant = Quantity("F_0", "N", "Force that acts all the time", default=0)


class Hub(Block):
    """A part whose joint with its shaft passes the torque at its teeth or chain less what its own inertia takes."""

    name = Text("Name of the part")
    torque = Text("Name of the torque at its teeth or chain, or balance for that which balances the others")
    inertia = Text("Name of the torque of its inertia")


class Motion(Block):
    """How the shaft swings or turns in steps."""

    mechanism = MechanismInput("Mechanism that moves the shaft")
    curve = Text("Name of the curve of its angle")
    turns_per_sheet = Text("Revolutions of the mechanism's shaft per sheet, a number or a ratio such as 1/2", symbol="i_m", default="1")
    offset = Quantity("Φ_m", "deg", "Main-shaft angle of the mechanism's own zero", ge=-3600, le=3600, default=0)
    ratio = Quantity("k_m", "1", "Factor on the angle", default=1)


class ShaftLoads(Inputs):
    """Keys of ``shaft_loads``."""

    main_turns = Quantity("N_m", "1", "Revolutions of the main shaft in the cycle", ge=1, le=1000, integer=True)
    torques = parts(Torque, "Torques on the parts", optional=True)
    hubs = parts(Hub, "Parts whose inertia counts at their own place", optional=True)
    forces = parts(Force, "Forces on the parts", optional=True)
    motion = block(Motion, "How the shaft swings or turns in steps; without it, it turns steadily", optional=True)
    n_points = samples(720)


OF_CURVE = ("name", "mechanism", "curve", "turns_per_sheet", "offset", "ratio")
KEYS = (
    "main_turns",
    *(f"torques.{key}" for key in (*OF_CURVE, "inertia", "efficiency", "lag")),
    *(f"hubs.{key}" for key in ("name", "torque", "inertia")),
    *(f"forces.{key}" for key in (*OF_CURVE, "inertia", "lever", "absolute", "constant")),
    *(f"motion.{key}" for key in OF_CURVE[1:]),
)


Array = NDArray[Any]
TURN = 2 * np.pi
BALANCE = "balance"  # the torque that balances the others, by its name among them
MAIN = "main"  # what runs over the angle of the main shaft itself, for as many of its revolutions as it takes to come back


@dataclass(frozen=True, eq=False)
class CurveLoad:
    """Hold a load: the curve over the main shaft, and the numbers (machines, 1) by which it counts."""

    curve: ShaftCurve
    factor: Array
    efficiency: Array
    constant: Array
    gain: Array  # what the curve gains in a turn of its own
    is_absolute: bool = False
    is_motion: bool = False

    def lagging(self, lag: Array) -> CurveLoad:
        """Return the load as a motor follows it behind a flywheel; the angle of the main shaft in its time constant is ``lag`` (machines, 1)."""
        count, none = len(self.curve.offset), np.zeros((1, 1))
        corners = (self.curve.breakpoints, *(() if self.reversals is None else (self.reversals,)))
        own = np.concatenate([np.broadcast_to(each, (count, each.shape[1])) for each in corners], axis=1)
        load = PieceRows.of(lambda share, middle, row: self._of_shares(share, middle, none, row), own, PIECES[-1])
        shares = np.broadcast_to(lag * float(self.curve.turns) / TURN, (count, 1))[:, 0]
        followed = motor_response(load, np.ones(count), shares)
        curve = replace(
            self.curve, function=lambda share, middle, row: followed.at(share, row, middle), breakpoints=own
        )
        one = np.ones((1, 1))
        return replace(self, curve=curve, factor=one, efficiency=one)

    def at(self, angle: Array, middle: Array, machine: Array | None) -> Array:
        """Return the load at main-shaft angles (rows, points)."""
        share, inside, passed, row = self.curve.turned(angle, middle, machine)
        return self._of_shares(share, inside, passed, row)

    def _of_shares(self, share: Array, inside: Array, passed: Array, row: Array) -> Array:
        """The load at shares of the own turn, so many turns having passed."""
        # an angle is differentiated, also across the end of a piece, where only the function itself goes on
        found = self.curve.function if self.is_motion else self.curve.of_shares
        # a mechanism may be the same in all machines
        machine = row if len(self.curve.breakpoints) > 1 else np.zeros_like(row)
        value = found(share, inside, machine) + passed * _of(self.gain, row)
        value = np.abs(value) if self.is_absolute else value
        factor = _of(self.factor, row)
        # losses go by the sign of the curve, whichever way it acts
        carried = with_losses(value * np.abs(factor), _of(self.efficiency, row))
        return np.sign(factor) * carried + _of(self.constant, row)

    @property
    def reversals(self) -> Array | None:
        """Return the shares of the own turn where it changes its sign, so that losses turn over; None where that makes no corner."""
        return self.curve.samples.sign_changes if self.is_absolute or (self.efficiency != 1).any() else None


def _of(number: Array, row: Array) -> Array:
    return number if len(number) == 1 else number[row]


@dataclass(frozen=True, eq=False)
class Loads:
    """Hold the loads of a shaft."""

    torques: tuple[CurveLoad, ...]
    # places of the torques at their teeth and of their inertia; None of the balance
    hubs: tuple[tuple[int | None, int], ...]
    forces: tuple[CurveLoad, ...]
    motion: CurveLoad | None
    period: Array

    @cached_property
    def joints(self) -> Array:
        """Return the main-shaft angles where a load is not smooth, (machines, places), NaN for none."""
        every = (*self.torques, *self.forces, *(() if self.motion is None else (self.motion,)))
        found = [each.curve.joints(self.period, each.reversals) for each in every]
        return np.concatenate(found, axis=1) if found else np.full_like(self.period, np.nan)


def values(of: str) -> Callable[..., Array]:
    """Return the function that gives a torque or a force over the main shaft."""

    def found(index: int, loads: Loads, x: Array, middle: Array, rows: Array | None) -> Array:
        every: tuple[CurveLoad, ...] = getattr(loads, of)
        return np.broadcast_to(every[index].at(x, np.broadcast_to(middle, x.shape), rows), x.shape)

    return found


def balance(loads: Loads, x: Array, middle: Array, rows: Array | None) -> Array:
    """Return the torque that balances all others."""
    own = np.broadcast_to(middle, x.shape)
    return np.asarray(-sum((each.at(x, own, rows) for each in loads.torques), np.zeros(x.shape)))


def hub(index: int, loads: Loads, x: Array, middle: Array, rows: Array | None) -> Array:
    """Return the torque that passes the joint of a part with its shaft."""
    joined, own = loads.hubs[index]
    torque = values("torques")
    at_teeth = balance(loads, x, middle, rows) if joined is None else torque(joined, loads, x, middle, rows)
    return at_teeth + torque(own, loads, x, middle, rows)


def angle(loads: Loads, x: Array, middle: Array, rows: Array | None) -> Array:
    """Return the angle of the shaft."""
    assert loads.motion is not None  # the step needs it
    return np.broadcast_to(loads.motion.at(x, np.broadcast_to(middle, x.shape), rows), x.shape)


def curves_of(given: Mapping[str, Any]) -> Loads:
    """Return the loads that the configuration names; Refusal in words where a curve is not there."""
    turns = given["main_turns"]
    count = len(turns)
    torques, forces = (
        tuple(_load(given, of, index, count) for index in range(len(given.get(f"{of}.name", ()))))
        for of in ("torques", "forces")
    )
    motion = _load(given, "motion", None, count) if "motion.mechanism" in given else None
    return Loads(torques, _hubs(given), forces, motion, TURN * np.reshape(turns, (-1, 1)).astype(float))


def _hubs(given: Mapping[str, Any]) -> tuple[tuple[int | None, int], ...]:
    known = {name: place for place, name in enumerate(given.get("torques.name", ()))}

    def place(key: str, index: int) -> int:
        if (name := given[f"hubs.{key}"][index]) not in known:
            template = "is “{name}”, which is not the name of a torque; there are {known}"
            raise Refusal(f"hubs.{index}.{key}", Phrase(template, name=name, known=", ".join(known) or "none"))
        return known[name]

    every = range(len(given.get("hubs.name", ())))
    return tuple(
        (None if given["hubs.torque"][index] == BALANCE else place("torque", index), place("inertia", index))
        for index in every
    )


def _load(given: Mapping[str, Any], of: str, index: int | None, count: int) -> CurveLoad:
    def text(key: str) -> Any:
        found = given[f"{of}.{key}"]
        return found if index is None else found[index]

    def number(key: str, default: float) -> Array:
        found = given.get(f"{of}.{key}")
        if found is None:
            return np.full((1, 1), default)
        own = found if index is None else found[:, [index]] if isinstance(found, np.ndarray) else found[index]
        return np.reshape(np.asarray(own, dtype=float), (-1, 1))

    home = of if index is None else f"{of}.{index}"
    mechanism, name = text("mechanism"), text("curve")
    curve = mechanism.curve(name)
    if curve is None:
        template = "is “{curve}”, but {mechanism} has no curve of this name"
        raise Refusal(f"{home}.curve", Phrase(template, curve=name, mechanism=mechanism.name))
    if not isclose(mechanism.period(), mechanism.cycle()):
        template = (
            "is “{curve}”, which is over a part of the cycle of {mechanism} alone; a load is needed over all of it"
        )
        raise Refusal(f"{home}.curve", Phrase(template, curve=name, mechanism=mechanism.name))
    inertia, lever = number("inertia", 0.0), number("lever", 0.0)
    wanted = _unit(of, bool((inertia > 0).any()), bool((lever > 0).any()))
    if not curve.is_in(wanted):
        template = "is “{curve}” of {mechanism}, which is not a curve in {unit}"
        raise Refusal(f"{home}.curve", Phrase(template, curve=name, mechanism=mechanism.name, unit=wanted))
    factor = number("ratio", 1.0) * np.where(inertia > 0, inertia, 1.0) / np.where(lever > 0, lever, 1.0)
    offset = np.broadcast_to(number("offset", 0.0), (count, 1))
    turns = _turns(text("turns_per_sheet"), mechanism, f"{home}.turns_per_sheet")
    shaft = ShaftCurve(curve.values, curve.breakpoints, turns, offset)
    gain = np.reshape(curve.gain(None), (-1, 1)) if of == "motion" else np.zeros((1, 1))
    load = CurveLoad(
        shaft,
        factor,
        number("efficiency", 1.0),
        number("constant", 0.0),
        gain,
        of == "forces" and bool(text("absolute")),
        of == "motion",
    )
    lag = number("lag", 0.0)
    return load.lagging(lag) if (lag > 0).any() else load


def _unit(of: str, has_inertia: bool, has_lever: bool) -> str:
    """The unit of a curve that is taken over: of an acceleration where it moves an inertia, of a torque where a lever makes a force of it."""
    if of == "motion":
        return "rad"
    if has_inertia:
        return "rad/s**2"
    return "N*m" if of == "torques" or has_lever else "N"


def _turns(text: str, mechanism: GivenMechanism, key: str) -> Fraction:
    try:
        return exact_turns(Fraction(TURN / mechanism.period()).limit_denominator(64) if text == MAIN else text)
    except ValueError:
        template = "is “{text}”; a number or a ratio above zero such as 1/2 is needed, with a denominator of at most 64, or main"
        raise Refusal(key, Phrase(template, text=text)) from None


OBJECT = "curves"

cycle = Chapter("Loads over the cycle",
    text="The cycle is a whole number of revolutions of the main shaft and of this one. A torque passes a mesh or a chain with its efficiency: more "
        "where it drives, less where it is given back. A torque of an inertia is that inertia times the angular acceleration.")
cycle.prepared(OBJECT, curves_of, KEYS, for_many=True)
cycle.cycle_length = inner(2 * pi * m.main_turns), "Φ", "deg", "Length of the cycle, as an angle of the main shaft"
cycle.main_angle = abscissa("cycle_length"), "φ_m", "deg", "Angle of the main shaft"
cycle.torque = (computed_curve(values("torques"), OBJECT, "main_angle", "from the curve of the mechanism, at the angle of the main shaft",
    joints=lambda curves: curves.joints, named_by="torques.name", needs=("torques",)), "T", "N*m", "Torque on the shaft")
cycle.balance = (computed_curve(balance, OBJECT, "main_angle", "the negative sum of the others", joints=lambda curves: curves.joints,
    needs=("torques",)), "T_0", "N*m", "Torque that balances the others", "statics")
cycle.hub = (computed_curve(hub, OBJECT, "main_angle", "the torque at its teeth or chain, with that of its own inertia",
    joints=lambda curves: curves.joints, named_by="hubs.name", needs=("hubs",)), "T_h", "N*m", "Torque through the joint of the part with the shaft",
    "statics")
cycle.force = (computed_curve(values("forces"), OBJECT, "main_angle", "from the curve of the mechanism, at the angle of the main shaft",
    joints=lambda curves: curves.joints, named_by="forces.name", needs=("forces",)), "F", "N", "Force on the shaft")
cycle.shaft_angle = (computed_curve(angle, OBJECT, "main_angle", "from the curve of the mechanism, at the angle of the main shaft",
    joints=lambda curves: curves.joints, needs=("motion",)), "θ", "deg", "Angle of the shaft")

EXAMPLE = ExampleBlock("shaft_loads", {
    "main_turns": 2,
    "torques": [{"name": "wheel", "mechanism": Wired("<cylinder_drive>"), "curve": "crank_torque", "turns_per_sheet": "1/2"}],
})

MECHANISM = Mechanism(
    kind="shaft_loads",
    version="1.0",
    title="Loads of a shaft over one cycle",
    summary="The torques and forces of the parts on a shaft, from the curves of the mechanisms, over a cycle after which shaft and machine are back "
            "at their start.",
    inputs=ShaftLoads,
    example=EXAMPLE,
    chapters=(cycle,),
    assumptions=("Shafts and joins are rigid and without backlash.",),
)
