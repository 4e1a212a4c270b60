"""Inputs and surroundings that would do harm."""
