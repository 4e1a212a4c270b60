"""How much a config may hold: more than a press has, and little enough for time and memory. docs/limits.md tells them."""

MAX_TEXT = 500  # characters of a text
MAX_QUANTITY = 200  # characters of a number with its unit
MAX_PARTS = 200  # blocks in a list: revisions, gears, pulleys
MAX_CURVE_VALUES = 10_000  # numbers in a list that gives a curve
MAX_MECHANISMS = 200  # of a config
MAX_PRINTED_MECHANISMS = 60  # of a config whose report is a PDF
MAX_COMPARISONS = 12  # of a config
