"""The engine: runs the steps that a mechanism declares, proves what it finds, and prints what it computed."""
