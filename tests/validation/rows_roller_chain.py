"""The numbers of roller chains that textbooks and rating tables print.

Bhandari V. B. Design of Machine Elements. McGraw-Hill; examples 14.1, 14.4, 14.6, 14.7 (as runs of their Scilab companion print them).
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
PUMP = {"teeth_1": 17, "teeth_2": 34, "center_distance": 762}
ENGINE = {"teeth_1": 21, "teeth_2": 80, "links": 132}
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


def looped(name: str, scale: float = 1.0, **keys: object) -> float:
    """A number of a textbook's loop, of which the pitch counts alone."""
    return (
        number(chain({}, **{"chain": "12B", "speed": 900, "power": 10, "application_factor": 1} | keys), name) * scale
    )


def driven(name: str) -> float:
    """A number of the textbook's drive with a chain 10B, whose breaking load it has from its own table."""
    return looped(name, chain="10B", teeth_1=19, teeth_2=76, speed=1400, power=12.9537, center_distance=635)


BOOK, SOLUTIONS, TABLES = "Bhandari, example 14.1", "Shigley, solutions", "ANSI B29.1, no. 40"
# fmt: off
ROWS = (
    Row(BOOK, "breaking load over power by mean velocity", "11.722224", "1",
        lambda: bhandari("breaking_load") / (bhandari("power") / bhandari("velocity"))),
    Row("Bhandari, example 14.4", "chain 12B: pitch circle of 17 teeth", "103.673741", "mm",
        lambda: looped("sprocket_diameter_1", 1e3, **PUMP)),
    Row("Bhandari, example 14.4", "pitch circle of 34 teeth", "206.462975", "mm", lambda: looped("sprocket_diameter_2", 1e3, **PUMP)),
    Row("Bhandari, example 14.4", "links X₀, a = 40 p", "105.683011", "1", lambda: looped("links_exact", **PUMP)),
    Row("Bhandari, example 14.4", "distance of the axes of 106 links, less 0.2 % for the sag", "763.496160", "mm",
        lambda: looped("center_distance_adjusted", 998, **PUMP)),
    Row("Bhandari, example 14.6", "pitch 19.05: pitch circle of 21 teeth", "127.816092", "mm", lambda: looped("sprocket_diameter_1", 1e3, **ENGINE)),
    Row("Bhandari, example 14.6", "pitch circle of 80 teeth", "485.228971", "mm", lambda: looped("sprocket_diameter_2", 1e3, **ENGINE)),
    Row("Bhandari, example 14.6", "distance of the axes of 132 links", "755.098993", "mm",
        lambda: looped("center_distance_adjusted", 1e3, **ENGINE)),
    Row("Bhandari, example 14.6", "pitch 12.7: links X₀ of 25 and 96 teeth, a = 30 p", "124.756334", "1",
        lambda: looped("links_exact", chain="08B", teeth_1=25, teeth_2=96, center_distance=381)),
    Row("Bhandari, example 14.6", "distance of the axes of 124 links", "375.825124", "mm",
        lambda: looped("center_distance_adjusted", 1e3, chain="08B", teeth_1=25, teeth_2=96, links=124)),
    Row("Bhandari, example 14.7", "chain 10B: power by mean velocity", "1840.558878", "N",
        lambda: driven("power") / driven("velocity")),
    Row("Bhandari, example 14.7", "breaking load over power by mean velocity", "12.061554", "1",
        lambda: driven("breaking_load") / (driven("power") / driven("velocity"))),
    Row(SOLUTIONS, "links X₀ of 19 and 38 teeth, a = 40 p (17-27)", "108.7", "1", lambda: distant(19, 38, "links_exact")),
    Row(SOLUTIONS, "even links (17-27)", "110", "1", lambda: distant(19, 38, "links")),
    Row(SOLUTIONS, "distance of the axes in pitches (17-27)", "40.64", "1", lambda: distant(19, 38, "center_distance_adjusted", 1 / 12.7e-3)),
    Row(SOLUTIONS, "links X₀ of 21 and 84 teeth, a = 40 p (17-26)", "135", "1", lambda: distant(21, 84, "links_exact")),
    Row(TABLES, "17 teeth, 100 rpm: the plates govern", "0.69", "hp", lambda: rated(17, 100)),
    Row(TABLES, "11 teeth, 1800 rpm: the rollers govern", "4.66", "hp", lambda: rated(11, 1800)),
)
