"""Curves and spectra of a calculation as plain data."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from diecut_report.contract.spectra import Spectrum, SpectrumLine
from diecut_report.contract.steps import Step
from diecut_report.engine import Calculation
from diecut_report.engine.calculation import Unproven
from diecut_report.engine.numerics.domain import Domain
from diecut_report.engine.shown_units import declared_unit, unit_for
from diecut_report.engine.steps.rough_places import require_whole
from diecut_report.expressions import Array
from diecut_report.languages.phrases import Phrase
from diecut_report.quantities.units import unit

Data = dict[str, Any]


def curves(calc: Calculation) -> Data:
    """Return each curve at the samples of its abscissa, with its one-sided values at the breakpoints."""
    found: Data = {}
    for name, domain in calc.domains.items():
        step = calc.steps[name]
        found[name] = _curve(step, domain.samples[0], declared_unit(calc, name, step.unit))
        edges = np.unique(domain.joints[0])[1:-1]
        if len(edges):
            found[name]["breakpoints"] = edges.tolist()
    pieces = {axis: _edges(domain) for axis, domain in calc.domains.items()}
    asked = {getattr(step, "of", "") for step in calc.steps.values()}
    for name, curve in calc.curves.items():
        if curve.output or name in asked:
            require_whole(calc, name)
        if curve.output:
            values = calc.curve_samples(name)[0]
            shown = _curve(curve, values, unit_for(calc, name, curve.unit, values))
            found[name] = shown | _limits(calc, name, pieces[calc.axis[name]])
    for spectrum in calc.mechanism.spectra:
        found |= _spectrum(spectrum)
    return found


def _spectrum(spectrum: Spectrum) -> Data:
    common = {"is_spectrum": True}
    lines = {
        line.id: _curve(line, line.values, line.unit) | {"abscissa": spectrum.id} | common for line in spectrum.lines()
    }
    return {spectrum.id: _curve(spectrum, spectrum.values, spectrum.unit) | common} | lines


def _curve(step: Step | SpectrumLine, values: Any, display: str) -> Data:
    if not np.isfinite(np.asarray(values, dtype=float)).all():
        raise Unproven(
            Phrase(
                "{description} ({id}) is a curve that has no value at some of its places",
                description=step.description,
                id=step.id,
            ),
            step.at,
        )
    return {"unit": unit(step.unit).si, "values": np.asarray(values, dtype=float).tolist(), "symbol": step.symbol,
            "description": step.description, "display_unit": display, "source": step.source,
            **({"source_symbol": step.source_symbol} if isinstance(step, Step) and step.source_symbol else {})}  # fmt: skip


class _Edges(NamedTuple):
    """Hold the smooth pieces of an abscissa: their ends and middles, each (1, pieces), and at which of those between them a curve may jump."""

    starts: Array
    ends: Array
    middles: Array
    joint: Array


def _edges(domain: Domain) -> _Edges:
    wide = domain.widths[0] > 1e-12 * domain.period[0, 0]
    starts, ends = domain.edges[:1, :-1][:, wide], domain.edges[:1, 1:][:, wide]
    joint = (domain.is_joint(starts[:, 1:]) | domain.is_joint(ends[:, :-1]))[0]
    return _Edges(starts, ends, domain.middles[:1, wide], joint)


def _limits(calc: Calculation, name: str, edges: _Edges) -> Data:
    axis = calc.axis[name]
    first = np.zeros(1, dtype=int)
    after = calc.kept("starts", axis, lambda _: (edges.starts, edges.middles), first)[name]
    before = calc.kept("ends", axis, lambda _: (edges.ends, edges.middles), first)[name]
    after, before = (np.broadcast_to(limits, edges.starts.shape)[0] for limits in (after, before))
    return {
        "abscissa": axis,
        "breakpoints": edges.starts[0, 1:][edges.joint].tolist(),
        "left": before[:-1][edges.joint].tolist(),
        "right": after[1:][edges.joint].tolist(),
    }
