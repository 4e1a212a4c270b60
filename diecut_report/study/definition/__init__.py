"""A study file: read and judged as a whole, against its base."""
