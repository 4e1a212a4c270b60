"""What plain code says of a machine that cannot be."""

from __future__ import annotations


class Refusal(Exception):
    """Say, out of plain code, that a machine cannot be: the key to change (``lines.0.offset``), and why in words."""

    def __init__(self, key: str, words: str) -> None:
        super().__init__(f"{key}: {words}")
        self.key, self.words = key, words
