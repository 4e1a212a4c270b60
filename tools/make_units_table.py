"""Write diecut_report/quantities/units_table.json: the everyday units with the factors and dimensions that pint gives them.

Run `python tools/make_units_table.py` after a change to the lists below; tests compare the table with pint.
"""

from __future__ import annotations

import json

from diecut_report.quantities.units import TABLE_FILE, measure_with_pint

# name with article, coherent SI unit, a typical SI value for examples in messages, units of the family
FAMILIES: list[tuple[str, str, float, str]] = [
    ("a pure number", "1", 0.5, "1 %"),
    ("a length", "m", 0.04, "m mm cm um nm km in ft"),
    ("an area", "m**2", 0.02, "m**2 mm**2 cm**2"),
    ("a volume or section modulus", "m**3", 2e-4, "m**3 mm**3 cm**3 L"),
    ("a second moment of area", "m**4", 3e-6, "m**4 mm**4 cm**4"),
    ("a curvature", "1/m", 10.0, "1/m 1/mm"),
    ("a mass", "kg", 12.0, "kg g mg t lb"),
    ("a density", "kg/m**3", 8000.0, "kg/m**3 g/cm**3 t/m**3 kg/dm**3 g/mm**3"),
    ("a mass per length", "kg/m", 5.0, "kg/m g/m g/mm kg/mm"),
    ("a mass per area", "kg/m**2", 0.3, "kg/m**2 g/m**2"),
    ("a mass flow", "kg/s", 0.1, "kg/s kg/h kg/min"),
    ("a moment of inertia", "kg*m**2", 0.5, "kg*m**2 kg*mm**2 kg*cm**2 g*cm**2 g*mm**2 t*m**2"),
    ("a static unbalance", "kg*m", 0.02, "kg*m kg*mm kg*cm g*mm g*cm g*m"),
    ("a force", "N", 2000.0, "N kN MN mN kgf lbf"),
    ("a line force or stiffness", "N/m", 30000.0, "N/m N/mm N/cm kN/m kN/mm MN/m N/um"),
    ("a moment", "N*m", 100.0, "N*m kN*m N*mm N*cm kN*mm MN*m mN*m kgf*m"),
    ("an energy", "J", 100.0, "J kJ MJ mJ kWh W*h W*s"),
    (
        "a pressure or stress",
        "Pa",
        3e5,
        "Pa kPa MPa GPa hPa bar mbar psi kpsi N/mm**2 kN/mm**2 N/m**2 N/cm**2 kN/m**2 N/(mm*um)",
    ),
    ("a compliance per width", "m*s**2/kg", 7e-11, "m*s**2/kg mm*um/N"),
    ("an angular stiffness", "N*m/rad", 5000.0, "N*m/rad kN*m/rad N*mm/rad N*m/deg"),
    ("an angular damping", "N*m*s/rad", 2.0, "N*m*s/rad"),
    ("a damping", "N*s/m", 200.0, "N*s/m kN*s/m N*s/mm"),
    ("a speed", "m/s", 0.5, "m/s mm/s cm/s m/min mm/min km/h"),
    ("an acceleration", "m/s**2", 9.0, "m/s**2 mm/s**2 cm/s**2"),
    ("a jerk", "m/s**3", 50.0, "m/s**3 mm/s**3"),
    ("an angle", "rad", 1.05, "rad deg mrad arcmin arcsec revolution"),
    ("an angle squared", "rad**2", 1.0, "rad**2"),
    ("an angular speed", "rad/s", 5.24, "rad/s rpm deg/s rad/min deg/min revolution/s"),
    ("an angular acceleration", "rad/s**2", 20.0, "rad/s**2 deg/s**2"),
    ("an angular jerk", "rad/s**3", 100.0, "rad/s**3 deg/s**3"),
    ("a length per angle", "m/rad", 0.05, "m/rad mm/rad mm/deg"),
    ("a length per angle squared", "m/rad**2", 0.05, "m/rad**2 mm/rad**2"),
    ("a length per angle cubed", "m/rad**3", 0.05, "m/rad**3 mm/rad**3"),
    ("an angle per length", "rad/m", 0.05, "rad/m deg/m deg/mm rad/mm"),
    ("a time", "s", 0.2, "s ms us min h d"),
    ("a frequency", "1/s", 1.667, "1/s Hz kHz 1/min 1/h"),
    ("a power", "W", 2000.0, "W kW mW MW hp"),
    ("a power density", "W/m**2", 5000.0, "W/m**2 W/cm**2 kW/m**2 W/mm**2"),
    ("a power per moment of inertia", "W/(kg*m**2)", 50.0, "W/(kg*m**2)"),
    ("a flow", "m**3/s", 1e-3, "m**3/s m**3/h L/min L/s"),
    ("a temperature difference", "K", 20.0, "K mK"),
    ("a thermal expansion", "1/K", 1e-5, "1/K"),
    ("a specific heat", "J/(kg*K)", 500.0, "J/(kg*K) kJ/(kg*K) J/(g*K)"),
    ("a heat capacity", "J/K", 500.0, "J/K kJ/K"),
    ("a thermal conductivity", "W/(m*K)", 50.0, "W/(m*K)"),
    ("a heat transfer coefficient", "W/(m**2*K)", 10.0, "W/(m**2*K)"),
    ("a thermal resistance", "K/W", 0.5, "K/W"),
    ("a dynamic viscosity", "Pa*s", 0.1, "Pa*s mPa*s"),
    ("a kinematic viscosity", "m**2/s", 1e-4, "m**2/s mm**2/s"),
    ("a pressure-velocity product", "Pa*m/s", 1e6, "Pa*m/s MPa*m/s"),
    ("a momentum", "kg*m/s", 5.0, "kg*m/s N*s"),
    ("a current", "A", 2.0, "A mA"),
    ("a voltage", "V", 24.0, "V mV kV"),
    ("a resistance", "ohm", 2.0, "ohm"),
    ("a voltage per angular speed", "V*s/rad", 0.5, "V*s/rad"),
]

# Other spellings, after the general ones (·, ², ^, °, spaces, "Nm") that diecut_report.quantities.units reads itself.
# Machine plates write rev/min for an angular speed, while rev/h counts strokes: a frequency.
ALIASES: dict[str, str] = {
    "rev": "revolution",
    "rev/s": "revolution/s",
    "rev/min": "rpm",
    "revolution/min": "rpm",
    "r/min": "rpm",
    "rev/h": "1/h",
    "radian": "rad",
    "degree": "deg",
    "degrees": "deg",
    "degree/s": "deg/s",
    "sec": "s",
    "second": "s",
    "seconds": "s",
    "minute": "min",
    "minutes": "min",
    "hr": "h",
    "hour": "h",
    "hours": "h",
    "inch": "in",
    "micron": "um",
    "l": "L",
    "l/min": "L/min",
    "l/s": "L/s",
    "s**-1": "1/s",
    "min**-1": "1/min",
    "h**-1": "1/h",
    "m**-1": "1/m",
    "mm**-1": "1/mm",
    "K**-1": "1/K",
    "m*s**-1": "m/s",
    "mm*s**-1": "mm/s",
    "m*s**-2": "m/s**2",
    "mm*s**-2": "mm/s**2",
    "m*s**-3": "m/s**3",
    "rad*s**-1": "rad/s",
    "rad*s**-2": "rad/s**2",
    "N*mm**-2": "N/mm**2",
    "N*mm**-1": "N/mm",
    "N*m**-1": "N/m",
    "kg*m**-3": "kg/m**3",
    "m*N": "N*m",
    "mm*kg": "kg*mm",
    "mm*g": "g*mm",
    "m*kg": "kg*m",
    "Nm/rad": "N*m/rad",
    "J/kg/K": "J/(kg*K)",
    "W/m/K": "W/(m*K)",
    "W/m**2/K": "W/(m**2*K)",
}


def table() -> dict[str, object]:
    """The whole table: families, units as [factor, index of the family], aliases."""
    families: list[dict[str, object]] = []
    units: dict[str, tuple[float, int]] = {}
    for index, (name, si, example, texts) in enumerate(FAMILIES):
        kind = _measured(si)[1]
        families.append({"name": name, "si": si, "example": example, "kind": kind})
        for text in texts.split():
            factor, own_kind = _measured(text)
            if own_kind != kind or text in units:
                raise ValueError(f"{text} does not belong to {name}, or stands twice")
            units[text] = (factor, index)
    return {"families": families, "units": units, "aliases": ALIASES}


def _measured(text: str) -> tuple[float, tuple[float, ...]]:
    measured = (1.0, (0.0,) * 8) if text == "1" else measure_with_pint(text)
    if measured is None:
        raise ValueError(f"pint does not know {text}")
    factor, kind = measured
    return factor, tuple(int(exponent) for exponent in kind)


def text() -> str:
    """The table as JSON, one entry a line, so that changes read well."""
    parts: list[str] = []
    for key, value in table().items():
        is_list = isinstance(value, list)
        items = value if isinstance(value, list) else value.items() if isinstance(value, dict) else []
        lines = [json.dumps(i) if is_list else f"{json.dumps(i[0])}: {json.dumps(i[1])}" for i in items]
        opening, closing = "[]" if is_list else "{}"
        parts.append(f' "{key}": {opening}\n  ' + ",\n  ".join(lines) + f"\n {closing}")
    return "{\n" + ",\n".join(parts) + "\n}\n"


if __name__ == "__main__":
    TABLE_FILE.write_text(text(), encoding="utf-8")
