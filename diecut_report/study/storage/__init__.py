"""The folder in which a study keeps its results."""
