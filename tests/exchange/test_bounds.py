"""A PDF whose few objects refer to each other many times, so that a tree of them has more ends than anybody can walk to: it ends in words, soon."""

from __future__ import annotations

import io
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from pyhanko.pdf_utils.generic import ArrayObject, DictionaryObject, NameObject, StreamObject

from diecut_report.exchange.later_changes import only_signed
from diecut_report.exchange.signing import Additions
from diecut_report.time_limit import limited

SECONDS = 20.0  # what none of these takes a tenth of


def named(**entries: Any) -> DictionaryObject:
    return DictionaryObject({NameObject(f"/{key}"): value for key, value in entries.items()})


def itself(writer: Additions) -> DictionaryObject:
    """Certificates in a list that holds itself."""
    listed = ArrayObject()
    reference = writer.add_object(listed)
    listed += [reference] * 1000
    return named(Certs=reference)


def levels(writer: Additions) -> DictionaryObject:
    """Certificates in lists of the same lists."""
    listed: Any = writer.add_object(StreamObject(stream_data=b"x"))
    for _ in range(4):
        listed = writer.add_object(ArrayObject([listed] * 1000))
    return named(Certs=listed)


def shared(writer: Additions) -> DictionaryObject:
    """The same list of certificates for each of many signatures."""
    certificate = writer.add_object(StreamObject(stream_data=b"x"))
    own = writer.add_object(named(Cert=writer.add_object(ArrayObject([certificate] * 20_000))))
    return named(VRI=named(**{f"A{number}": own for number in range(20_000)}))


@pytest.mark.parametrize(("proofs", "is_taken"), [(itself, False), (levels, False), (shared, True)])
def test_proofs_that_refer_to_each_other_are_judged_soon(
    small_report: Path, proofs: Callable[[Additions], DictionaryObject], is_taken: bool
) -> None:
    whole = (small_report / "small.pdf").read_bytes()
    writer, made = Additions(io.BytesIO(whole)), io.BytesIO()
    writer.root[NameObject("/DSS")] = writer.add_object(proofs(writer))
    writer.update_root()
    writer.write(made)
    with limited(SECONDS):
        assert only_signed(whole, made.getvalue()) is is_taken
