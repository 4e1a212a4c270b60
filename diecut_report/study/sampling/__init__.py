"""The variants of a study by number."""
