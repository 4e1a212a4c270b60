"""A plugin that cannot be imported."""

from library_that_is_not_there import anything  # type: ignore[import-not-found]

MECHANISM = anything
