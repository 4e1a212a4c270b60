"""Texts that plain code makes: they remember their parts, so that a report can say them in another language."""

from __future__ import annotations

from diecut_report.api import Phrase, below, joined, named, outward, phrase, si, told, worded

length = si(12.3456, "mm")
assert abs(length - 0.0123456) < 1e-12
assert told(length, "mm") == "12.35 mm"
assert told(length, "mm", up=False) == "12.34 mm"  # what "at least" names must be enough

advice = Phrase("set {key} to at most {high}", key="stroke", high=told(length, "mm", up=False))
assert advice == "set stroke to at most 12.34 mm" and advice.template == "set {key} to at most {high}"
assert (
    joined([advice, phrase("take a longer spring")], ", or ")
    == "set stroke to at most 12.34 mm, or take a longer spring"
)
assert named(["stroke", "free_length"], " and ") == "stroke and free_length"
assert worded("cast_iron") == "cast iron"

assert outward(1.23456, up=True) == 1.235 and outward(1.23456, up=False) == 1.234
assert below(2.0) == 1.999
