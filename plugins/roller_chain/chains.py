"""The chains of ISO 606, series B, one strand."""

from __future__ import annotations

from diecut_report.api import own_table, standard_table

# fmt: off

COLUMNS = {"pitch": "mm", "roller_diameter": "mm", "inner_width": "mm", "pin_diameter": "mm", "plate_thickness": "mm", "breaking_load": "kN",
           "mass_per_length": "kg/m"}
DIMENSIONS = tuple(standard_table(f"iso_606_{name}").values for name in ("pitches", "roller_diameters", "inner_widths", "pin_diameters"))
OWN = {  # plate thickness, breaking load, mass per length
    "08B": (1.60, 17.8, 0.69),
    "10B": (1.70, 22.2, 0.93),
    "12B": (1.85, 28.9, 1.15),
    "16B": (4.15, 60.0, 2.71),
    "20B": (4.50, 95.0, 3.70),
    "24B": (6.00, 160.0, 7.10),
}
ROWS = {name: (*(table[name] for table in DIMENSIONS), *own) for name, own in OWN.items()}
TITLE = "Roller chains of ISO 606, series B, one strand"
SOURCES = ("Donghua, Drive Chains, catalogue 2020 (all columns)",
           "Galaxy Chain, roller chains to BS 228, DIN 8187 and ISO 606 (pitch, rollers, widths, pins; breaking loads and masses near by)")
LEFT_OUT = ("Breaking loads are the lower of both, ISO 606 minima (Donghua 18.0, 22.4, 29.0, 60, 95, 160 kN; Galaxy 17.80, 22.27, 28.94, 60.92, "
            "95.16, 160.04 kN). The 22.2 kN of 10B stand in Bhandari, example 14.7. Plate thickness and mass are Donghua's; a public library has "
            "the same thickness up to 16B, Galaxy's masses are within 8 %. The dimensions stand among the standard tables.")

CHAINS = own_table(title=TITLE, columns=COLUMNS, rows=ROWS, sources=SOURCES, left_out=LEFT_OUT)
BY_PITCH = own_table(title=f"{TITLE}, by their pitch", columns=COLUMNS, rows=tuple(ROWS.values()), sources=SOURCES, left_out=LEFT_OUT)
