"""What to change in the motor, the flywheel and the run-up, in words for messages."""

from __future__ import annotations

from dataclasses import dataclass

from diecut_report.api import Phrase, joined, phrase, si, standard_series, standard_table, told

RATINGS = standard_series("iec_60072_ratings")
SYNCHRONOUS = tuple(
    sorted(speed for name, speed in standard_table("motor_synchronous_speeds").values.items() if name.endswith("50 Hz"))
)
LARGEST_MOTOR = si(max(RATINGS.values), RATINGS.unit)
DENSITIES = {"steel": 7850.0, "cast_iron": 7200.0}  # kg/m³
MOST_RESERVE = 4.0  # of the motor, that is worth advising
MOST_FLUCTUATION = 0.99
RIM_SPEEDS = {"steel": 60.0, "cast_iron": 35.0}  # m/s


def mean_advice(driving_mean: float, braking_mean: float) -> str:
    """Which mean torque belongs to the curve."""
    mean = driving_mean - braking_mean
    if mean < 0:
        return Phrase("the curve's mean is {mean}, so its load drives: look at its sign", mean=told(mean, "N*m"))
    return Phrase("set torque_mean to {mean}, or take both from the same mechanism", mean=told(mean, "N*m"))


def motor_advice(power: float) -> str:
    """How much the motor may have to give, from the power of its shaft."""
    reserve = LARGEST_MOTOR / power
    if reserve >= 1:
        return Phrase(
            "lower reserve_factor to at most {reserve}, or lower the torque or the speed of the output",
            reserve=told(reserve, "1", up=False),
        )
    return Phrase(
        "its shaft may take {largest_motor}, not {power}: lower the torque or the speed of the output, "
        "or drive with several motors",
        largest_motor=told(LARGEST_MOTOR, "kW"),
        power=told(power, "kW"),
    )


def overload_advice(peak: float, breakdown_ratio: float, speed: float, power: float) -> str:
    """Which reserve makes a motor whose breakdown torque is enough."""
    needed = peak * speed / breakdown_ratio
    if needed > min(LARGEST_MOTOR, MOST_RESERVE * power):
        return phrase("give torque_curve, so that a flywheel is sized that takes the peak")
    return Phrase(
        "give torque_curve, so that a flywheel is sized, or raise reserve_factor to at least {needed}",
        needed=told(needed / power, "1", up=True),
    )


def rim_advice(rim_speed: float, allowed: float, fluctuation: float, density: float) -> str:
    """Which material, and which fluctuation of the speed, makes the wheel hold: its rim's speed goes with δ to the -1/5."""
    ways = []
    steel = rim_speed * (density / DENSITIES["steel"]) ** 0.2
    if density < DENSITIES["steel"] and steel <= RIM_SPEEDS["steel"]:
        ways.append(phrase("take flywheel_material: steel"))
    greater = fluctuation * (rim_speed / allowed) ** 5
    if greater < MOST_FLUCTUATION:
        ways.append(Phrase("accept a speed_fluctuation of at least {greater}", greater=told(greater, "1", up=True)))
    ways = ways or [phrase("let the flywheel turn slower, with gears of a smaller ratio and a V-belt of a greater one")]
    return joined(ways, " or ")


@dataclass(frozen=True)
class RunUp:
    """A run-up, SI: what the motor's shaft has to bring to its speed in the allowed time, and what it gives."""

    allowed: float
    speed: float
    power: float
    torque: float
    torque_ratio: float
    load: float
    mean_torque: float
    inertia: float
    load_inertia: float
    gears: float
    gears_efficiency: float
    belt: float
    belt_efficiency: float
    wheel: float = 0.0
    fluctuation: float = 1.0

    @property
    def accelerating(self) -> float:
        """Torque left to accelerate."""
        return self.torque - self.load * self.mean_torque

    @property
    def wheel_share(self) -> float:
        """Inertia at the motor of an inertia of one at the flywheel's shaft."""
        return 1 / (self.belt**2 * self.belt_efficiency)

    @property
    def load_share(self) -> float:
        """Inertia at the motor of an inertia of one at the output."""
        return self.wheel_share / (self.gears**2 * self.gears_efficiency)

    @property
    def too_much(self) -> float:
        """Inertia at the motor beyond what runs up in the allowed time."""
        return self.inertia - self.allowed * self.accelerating / self.speed

    def smaller_load(self) -> list[str]:
        """The inertia of the load with which the time is kept."""
        left = self.load_inertia - self.too_much / self.load_share
        return [Phrase("a load_inertia of at most {left}", left=told(left, "kg*m**2", up=False))] if left > 0 else []

    def lighter_wheel(self) -> list[str]:
        """The fluctuation of the speed that makes the flywheel light enough."""
        left = self.wheel - self.too_much / self.wheel_share
        return self._fluctuating(left / self.wheel) if left > 0 else []

    def _fluctuating(self, share: float) -> list[str]:
        """The fluctuation of the speed with such a share of the flywheel."""
        greater = self.fluctuation / share
        return (
            [Phrase("a speed_fluctuation of at least {greater}", greater=told(greater, "1", up=True))]
            if greater < MOST_FLUCTUATION
            else []
        )

    def smaller_both(self) -> list[str]:
        """Load and flywheel made smaller alike, where neither is enough by itself."""
        share = 1 - self.too_much / (self.load_inertia * self.load_share + self.wheel * self.wheel_share)
        if self.load_inertia * self.wheel <= 0 or share <= 0:
            return []
        load = Phrase(
            "a load_inertia of at most {load_inertia}",
            load_inertia=told(self.load_inertia * share, "kg*m**2", up=False),
        )
        return [Phrase("{load} with {wheel}", load=load, wheel=wheel) for wheel in self._fluctuating(share)]

    def smaller_inertia(self) -> list[str]:
        """Which inertias keep the time."""
        if self.load_inertia + self.wheel <= 0:
            return []
        return [*self.smaller_load(), *self.lighter_wheel()] or self.smaller_both()

    def less_load(self) -> list[str]:
        """The share of the load with which the time is kept, else one that the motor overcomes at all."""
        left = self.torque - self.inertia * self.speed / self.allowed
        if self.mean_torque <= 0 or self.load <= 0 or (left < 0 < self.accelerating):
            return []
        share = (left if left >= 0 else 0.9 * self.torque) / self.mean_torque
        return [
            Phrase(
                "a run_up_load of at most {share} (load disengaged while it runs up)", share=told(share, "1", up=False)
            )
        ]

    def larger_motor(self) -> list[str]:
        """The reserve that makes the motor strong enough."""
        torque = self.load * self.mean_torque + self.inertia * self.speed / self.allowed
        power = torque * self.speed / self.torque_ratio
        if power > min(LARGEST_MOTOR, MOST_RESERVE * self.power):
            return []
        return [Phrase("a reserve_factor of at least {power}", power=told(power / self.power, "1", up=True))]

    def longer(self) -> list[str]:
        """The time that the protection would have to accept."""
        time = self.inertia * self.speed / self.accelerating
        return [
            Phrase(
                "a protection for heavy starting, allowable_run_up_time = {time} or more", time=told(time, "s", up=True)
            )
        ]


def run_up_advice(*numbers: float) -> str:
    """What makes the motor run up in time, each way by itself: numbers of ``RunUp``."""
    run = RunUp(*numbers)
    light = [*run.smaller_inertia(), *run.longer()] if run.accelerating > 0 else []
    ways = [*light[:-1], *run.less_load(), *run.larger_motor(), *light[-1:]]
    if not ways:
        return phrase("change several of run_up_load, run_up_torque_ratio and the torque together")
    return Phrase("one of these is enough: {ways}", ways=joined(ways, "; "))
