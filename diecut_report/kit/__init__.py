"""Tests what a plugin author writes and checks plugins with."""
