"""Batch: many variants of a press from one study file, their stored results and their summary."""
