"""Curves of mechanisms over the angle of the main shaft, as loads of one shaft, of many machines at once."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from math import isclose
from typing import Any

import numpy as np
from numpy.typing import NDArray

from diecut_report.api import GivenMechanism, Phrase, Refusal
from diecut_report.mechanics.timing.engagement import motor_response
from diecut_report.mechanics.timing.intervals import exact_turns
from diecut_report.mechanics.timing.shaft_curves import PIECES, PieceRows, ShaftCurve, with_losses

Array = NDArray[Any]
TURN = 2 * np.pi
BALANCE = "balance"  # the torque that balances the others, by its name among them
MAIN = (
    "main"  # what runs over the angle of the main shaft itself, for as many of its revolutions as it takes to come back
)


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
        machine = (
            row if len(self.curve.breakpoints) > 1 else np.zeros_like(row)
        )  # a mechanism that is the same in all machines
        value = found(share, inside, machine) + passed * _of(self.gain, row)
        value = np.abs(value) if self.is_absolute else value
        factor = _of(self.factor, row)
        carried = with_losses(
            value * np.abs(factor), _of(self.efficiency, row)
        )  # by the sign of the curve, whichever way it acts
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
    hubs: tuple[
        tuple[int | None, int], ...
    ]  # places of the torques at their teeth and of their inertia; None of the balance
    forces: tuple[CurveLoad, ...]
    motion: CurveLoad | None
    period: Array

    @cached_property
    def joints(self) -> Array:
        """Return the main-shaft angles where a load is not smooth, (machines, places), NaN for none."""
        every = (*self.torques, *self.forces, *(() if self.motion is None else (self.motion,)))
        found = [each.curve.joints(self.period, each.reversals) for each in every]
        return np.concatenate(found, axis=1) if found else np.full_like(self.period, np.nan)


def joints(loads: Loads) -> Array:
    """Return where a load is not smooth."""
    return loads.joints


def values(of: str) -> Callable[..., Array]:
    """Return the function that gives a torque or a force over the main shaft."""

    def found(index: int, loads: Loads, x: Array, middle: Array, rows: Array | None) -> Array:
        every: tuple[CurveLoad, ...] = getattr(loads, of)
        return np.broadcast_to(every[index].at(x, np.broadcast_to(middle, x.shape), rows), x.shape)

    return found


def balance(loads: Loads, x: Array, middle: Array, rows: Array | None) -> Array:
    """Return the torque that balances all others."""
    own = np.broadcast_to(middle, x.shape)
    found: Array = -sum((each.at(x, own, rows) for each in loads.torques), np.zeros(x.shape))
    return found


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
