"""Two kinds in one file, found by the folder's list. It prints, as a careless plugin does."""

from diecut_report.api import Inputs, Mechanism

print("hello from a plugin")

FIRST = Mechanism(kind="first_kind", version="1", title="First", summary="", inputs=Inputs, chapters=())
SECOND = Mechanism(kind="second_kind", version="1", title="Second", summary="", inputs=Inputs, chapters=())
