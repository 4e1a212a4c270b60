"""Tests of the beginning of a configuration."""
