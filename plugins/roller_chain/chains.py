"""The chains of ISO 606, series B, one strand."""

from __future__ import annotations

from diecut_report.api import own_table

# fmt: off

COLUMNS = {"pitch": "mm", "roller_diameter": "mm", "inner_width": "mm", "pin_diameter": "mm", "plate_thickness": "mm", "breaking_load": "kN",
           "mass_per_length": "kg/m"}
ROWS = {
    "08B": (12.700, 8.51, 7.75, 4.45, 1.60, 17.8, 0.69),
    "10B": (15.875, 10.16, 9.65, 5.08, 1.70, 22.2, 0.93),
    "12B": (19.050, 12.07, 11.68, 5.72, 1.85, 28.9, 1.15),
    "16B": (25.400, 15.88, 17.02, 8.28, 4.15, 60.0, 2.71),
    "20B": (31.750, 19.05, 19.56, 10.19, 4.50, 95.0, 3.70),
    "24B": (38.100, 25.40, 25.40, 14.63, 6.00, 160.0, 7.10),
}
TITLE = "Roller chains of ISO 606, series B, one strand"
SOURCES = ("Donghua, Drive Chains, catalogue 2020 (all columns)",
           "Galaxy Chain, roller chains to BS 228, DIN 8187 and ISO 606 (pitch, rollers, widths, pins; breaking loads and masses near by)")
LEFT_OUT = ("Breaking loads are the lower of both, ISO 606 minima (Donghua 18.0, 22.4, 29.0, 60, 95, 160 kN; Galaxy 17.80, 22.27, 28.94, 60.92, "
            "95.16, 160.04 kN). Plate thickness and mass are Donghua's; Galaxy's masses are within 8 %.")

CHAINS = own_table(title=TITLE, columns=COLUMNS, rows=ROWS, sources=SOURCES, left_out=LEFT_OUT)
BY_PITCH = own_table(title=f"{TITLE}, by their pitch", columns=COLUMNS, rows=tuple(ROWS.values()), sources=SOURCES, left_out=LEFT_OUT)
