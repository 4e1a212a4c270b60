"""The kinematics of a four-bar linkage over 720 crank angles, many variants: the engine against pylinkage; one core, one run.

    pip install "pylinkage[numba]"      (no part of the program)
    python benchmarks/pylinkage_kinematics.py [ROUNDS]

pylinkage: positions, velocities and accelerations of the joints at 720 angles, by its compiled solver, one variant after the other
with new lengths, and positions alone, by its batch simulation. The engine: angle, speed and acceleration of the rocker and the
transmission angle at 720 angles, and beside these dead centres, swing, time ratio and the greatest speed and acceleration,
found to rounding and proved; and positions alone, rocker's angle and transmission angle. The aim: at least 4 × the variants a second,
each against its like.
"""

from __future__ import annotations

import os

os.environ |= dict.fromkeys(
    ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS"), "1"
)  # one core

import sys
import time
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from batch_kernel import variants

from diecut_report.machine.numerics.curves import Curves
from diecut_report.machine.steps.needed import needed
from diecut_report.machine.steps.run import calculate
from diecut_report.plugins.cylinder_drive import MECHANISM
from diecut_report.study.execution.engines import settle

COUNT, CHUNK, ANGLES = 2048, 512, 720
POSITIONS = ("rocker_angle", "transmission_angle")
FORCES = {"flank_change", "losses"}  # steps that cut the turn where a moment changes its sign: no part of the motion
NUMBERS = ("swing_angle", "dead_center_outer", "dead_center_inner", "time_ratio", "transmission_angle_min", "transmission_angle_max",
           "velocity_max", "acceleration_max")  # fmt: skip
CURVES = ("rocker_angle", "rocker_speed_ratio", "rocker_acceleration_ratio", "transmission_angle")


def by_engine(values: Mapping[str, Any], numbers: Sequence[str] = NUMBERS, asked: Sequence[str] = CURVES) -> list[Any]:
    """Numbers of the motion, and its curves at all angles."""
    count = len(values["frame_ratio"])
    calc = calculate(MECHANISM, values, count, needed(MECHANISM, frozenset(values), (*numbers, *asked)) - FORCES)
    angles = calc.domains["crank_angle"].samples
    curves = Curves(calc, "crank_angle", asked, np.zeros(count), np.arange(count))
    return [*(calc[name] for name in numbers), *curves.at(np.broadcast_to(angles, (count, ANGLES)))]


def positions_by_engine(values: Mapping[str, Any]) -> list[Any]:
    """The positions of the links alone."""
    return by_engine(values, (), POSITIONS)


def linkage(frame: float, coupler: float, rocker: float) -> Any:
    """pylinkage's four-bar with a crank of the length 1."""
    from pylinkage.actuators import Crank
    from pylinkage.components import Ground
    from pylinkage.dyads import RRRDyad
    from pylinkage.simulation import Linkage

    first, second = Ground(0.0, 0.0), Ground(frame, 0.0)
    crank = Crank(anchor=first, radius=1.0, angular_velocity=2 * np.pi / ANGLES)
    made = Linkage([first, second, crank, RRRDyad(crank.output, second, distance1=coupler, distance2=rocker)])
    made.set_input_velocity(crank, omega=1.0)
    made.compile()
    return made


def one_by_one(values: Mapping[str, Any]) -> list[Any]:
    """Positions, velocities and accelerations, the compiled linkage given new lengths each time."""
    made = linkage(5.0, 5.0, 2.05)
    lengths = zip(values["frame_ratio"], values["coupler_ratio"], values["rocker_ratio"], strict=True)
    found = []
    for frame, coupler, rocker in lengths:
        made.components[1].x = frame
        made.set_constraints([1.0, coupler, rocker])
        found.append(made.step_fast_with_kinematics(ANGLES))
    return found


def together(values: Mapping[str, Any]) -> list[Any]:
    """Positions alone, by the batch simulation."""
    from pylinkage.population import Ensemble

    made = linkage(5.0, 5.0, 2.05)
    lengths = np.stack([np.ones(len(values["frame_ratio"])), values["coupler_ratio"], values["rocker_ratio"]], axis=1)
    places = np.tile([[0.0, 0.0], [5.0, 0.0], [1.0, 0.0], [3.0, 1.0]], (len(lengths), 1, 1))
    places[:, 1, 0] = values["frame_ratio"]
    group = Ensemble(made, lengths, places)
    group.simulate(ANGLES)
    return [group.trajectories]


def same_motion(inputs: Mapping[str, Any], count: int = 16) -> float:
    """How far the rocker's swing over the 720 angles differs between the two, of some variants, rad."""
    few = {name: value[:count] for name, value in inputs.items()}
    ours = np.ptp(by_engine(few)[len(NUMBERS)], axis=1)
    joints = [
        positions[:, 3] - [frame, 0] for (positions, *_), frame in zip(one_by_one(few), few["frame_ratio"], strict=True)
    ]
    theirs = [np.ptp(np.unwrap(np.arctan2(joint[:, 1], joint[:, 0]))) for joint in joints]
    return float(np.max(np.abs(ours - theirs)))


def rate(function: Callable[[Mapping[str, Any]], Any], inputs: Mapping[str, Any], count: int) -> float:
    """Variants a second, in chunks."""
    start = time.process_time()
    for first in range(0, count, CHUNK):
        function({name: value[first : first + CHUNK] for name, value in inputs.items()})
    return count / (time.process_time() - start)


def main(rounds: int) -> None:
    """Run all in turns and print variants a second, and the ratio of the best."""
    try:
        import pylinkage
    except ModuleNotFoundError:
        raise SystemExit('pylinkage is not installed; install it with: pip install "pylinkage[numba]"') from None
    inputs = variants(COUNT)
    print(f"swing of the rocker differs by {same_motion(inputs):.0e} rad")
    settle()  # as workers of a study do
    runs = {
        "engine, with derivatives": by_engine, "pylinkage, with derivatives": one_by_one,
        "engine, positions alone": positions_by_engine, "pylinkage, positions alone": together,
    }  # fmt: skip
    best = dict.fromkeys(runs, 0.0)
    for function in runs.values():
        rate(function, inputs, CHUNK)  # compiles
    for _ in range(rounds):
        for name, function in runs.items():
            best[name] = max(best[name], rate(function, inputs, COUNT))
    for name, found in best.items():
        print(f"{name:30} {found:8.0f} variants a second")
    print(f"pylinkage {pylinkage.__version__}")
    for part in ("with derivatives", "positions alone"):
        print(f"engine / pylinkage, {part:20} {best[f'engine, {part}'] / best[f'pylinkage, {part}']:.2f}")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 5)
