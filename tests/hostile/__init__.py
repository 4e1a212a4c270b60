"""Hostile files: what a stranger may hand to the program. They are generated (``made_tables``), large ones as holes or packed."""
