"""The study file, its variables, samples, constraints and tables."""
