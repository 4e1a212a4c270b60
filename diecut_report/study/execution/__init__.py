"""Calculates the variants of a study, in one process or in many."""
