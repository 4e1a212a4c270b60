"""A plugin whose MECHANISM is none."""

MECHANISM = {"kind": "no_mechanism"}
