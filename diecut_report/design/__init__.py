"""From a question to a machine: inputs that are varied in one run, solved for, and written into the configuration."""
