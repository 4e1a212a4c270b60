"""Spectra: curves over a range of their own have ids of their own, and a number for each place of the range."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from diecut_report.contract.mechanism import Mechanism
from diecut_report.declaration.names import DeclaredNames
from diecut_report.declaration.words import Fault
from diecut_report.languages.phrases import Phrase, phrase


def faults(mechanism: Mechanism, names: DeclaredNames) -> Iterator[Fault]:
    """Yield what is wrong with the spectra."""
    known = {name for name in names.known if names.kinds(name) & {"curve", "abscissa"}}
    for spectrum in mechanism.spectra:
        for curve in (spectrum, *spectrum.lines()):
            subject = Phrase("curve {id}", id=curve.id)
            if curve.id in known:
                yield Fault(curve.at, subject, phrase("of a spectrum has the id of another curve; name it otherwise"))
            if np.shape(curve.values) != (len(spectrum.values),) or not np.isfinite(curve.values).all():
                yield Fault(curve.at, subject, Phrase("does not have one number for each of {id}", id=spectrum.id))
            if not (curve.symbol and curve.description):
                yield Fault(curve.at, subject, phrase("has no symbol or no description"))
            known.add(curve.id)
