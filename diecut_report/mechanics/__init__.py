"""Shared kinematics and geometry: formulas on numbers and arrays, which plugins bind to their quantities."""
