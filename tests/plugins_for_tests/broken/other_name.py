"""A plugin that gives another kind than the file says."""

from diecut_report.api import Inputs, Mechanism

MECHANISM = Mechanism(kind="quite_other", version="1", title="Other", summary="", inputs=Inputs, chapters=())
