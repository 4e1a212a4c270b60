"""What libraries raise for a PDF that is not as the standard has it: it was damaged, or made to harm."""

from __future__ import annotations

import zlib

PDF_FAULTS = (
    ValueError, TypeError, LookupError, AttributeError, NameError, ArithmeticError, RuntimeError, AssertionError, OSError, MemoryError,
    zlib.error,
)  # fmt: skip
"""RuntimeError with recursion and what is not implemented, ArithmeticError with decimals, NameError with a variable that was never set."""
