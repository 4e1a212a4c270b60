"""Templates are compiled once for all tests of a worker: that takes most of the time of a small page."""

from __future__ import annotations

from typing import Any

from jinja2 import BytecodeCache, Environment
from jinja2.bccache import Bucket


class Compiled(BytecodeCache):
    """What is compiled of a template, by its text, its name and who fills it: the firm's sandbox compiles otherwise."""

    def __init__(self) -> None:
        self.known: dict[Any, Any] = {}

    def get_bucket(self, environment: Environment, name: str, filename: str | None, source: str) -> Bucket:
        bucket = Bucket(environment, (type(environment), name, filename, source), "")  # type: ignore[arg-type]
        bucket.code = self.known.get(bucket.key)
        return bucket

    def set_bucket(self, bucket: Bucket) -> None:
        self.known[bucket.key] = bucket.code
