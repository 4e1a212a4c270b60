"""Which digests and keys are too weak to sign with: NIST SP 800-131A wants 112 bits of security."""

from __future__ import annotations

from diecut_report.languages.phrases import Phrase

WEAK_DIGESTS = ("md2", "md4", "md5", "sha1")
SHORTEST = {"rsa": 2048, "rsassa_pss": 2048, "dsa": 2048, "ec": 224}  # bits of a key


def weak_digest(name: str) -> bool:
    """Return whether somebody can make another document of the same digest."""
    return name.lower().replace("-", "") in WEAK_DIGESTS


def weak_key(kind: str, bits: int | None) -> str:
    """Return what is told of a key that can be broken; "" of one that cannot."""
    least = SHORTEST.get(kind, 0)
    if bits is None or bits >= least:
        return ""
    return Phrase(
        "the key is too short: {kind} with {bits} bits, at least {least} are needed",
        kind=kind.upper(),
        bits=bits,
        least=least,
    )
