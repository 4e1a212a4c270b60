"""Conditions between quantities: constraints of a study, questions to its results."""
