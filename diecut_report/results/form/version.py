"""The version of the form of the results file."""

from __future__ import annotations

SCHEMA_VERSION = 1
"""It rises when a key changes its name or meaning, or is not written any more."""
FORM_VERSION = f"{SCHEMA_VERSION}.7"
"""Its second number rises with each addition: a key, a block, a word that a text may be; it begins at 0 with each new first number."""
