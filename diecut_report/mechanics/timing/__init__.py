"""Motions on one main shaft: intervals, clearance, torques, productivity."""
