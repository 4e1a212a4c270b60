"""The numbers of roller chains that textbooks and rating tables print.

Bhandari V. B. Design of Machine Elements. McGraw-Hill; example 14.1 (the safety as a run of its Scilab companion prints it).
Budynas R. G., Nisbett J. K. Shigley's Mechanical Engineering Design, solutions manual; problems 17-26, 17-27.
ANSI B29.1, horsepower ratings of roller chain no. 40, as the tables of engineersedge.com print them.
"""

from __future__ import annotations

from tests.machines import number
from tests.plugins.chains import chain
from tests.validation.rows import Row

BHANDARI = {
    "chain": "custom", "pitch": 19.05, "pin_diameter": 5.94, "bearing_area": 105, "breaking_load": 31.1, "mass_per_length": 1.47,
    "teeth_1": 17, "speed": 1000, "power": 14.32, "application_factor": 1, "center_distance": 762,
}  # fmt: skip
FORTY = 40 * 12.7  # mm
HORSEPOWER = 745.7


def distant(teeth_1: int, teeth_2: int, name: str, scale: float = 1.0) -> float:
    """A number of a loop whose axes are forty pitches apart."""
    machine = chain(chain="08B", teeth_1=teeth_1, teeth_2=teeth_2, center_distance=FORTY)
    return number(machine, name) * scale


def rated(teeth: int, speed: float) -> float:
    """Rated power of one strand of half an inch pitch, in horsepower."""
    return number(chain(chain="08B", teeth_1=teeth, speed=speed, power_rating="ansi_b29_1"), "rated_power") / HORSEPOWER


def bhandari(name: str) -> float:
    """A number of the textbook's drive."""
    return number(chain({}, **BHANDARI), name)


BOOK, SOLUTIONS, TABLES = "Bhandari, example 14.1", "Shigley, solutions", "ANSI B29.1, no. 40"
# fmt: off
ROWS = (
    Row(BOOK, "breaking load over power by mean velocity", "11.722224", "1",
        lambda: bhandari("breaking_load") / (bhandari("power") / bhandari("velocity"))),
    Row(SOLUTIONS, "links X₀ of 19 and 38 teeth, a = 40 p (17-27)", "108.7", "1", lambda: distant(19, 38, "links_exact")),
    Row(SOLUTIONS, "even links (17-27)", "110", "1", lambda: distant(19, 38, "links")),
    Row(SOLUTIONS, "distance of the axes in pitches (17-27)", "40.64", "1", lambda: distant(19, 38, "center_distance_adjusted", 1 / 12.7e-3)),
    Row(SOLUTIONS, "links X₀ of 21 and 84 teeth, a = 40 p (17-26)", "135", "1", lambda: distant(21, 84, "links_exact")),
    Row(TABLES, "17 teeth, 100 rpm: the plates govern", "0.69", "hp", lambda: rated(17, 100)),
    Row(TABLES, "11 teeth, 1800 rpm: the rollers govern", "4.66", "hp", lambda: rated(11, 1800)),
)
