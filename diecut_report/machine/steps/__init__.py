"""How each type of step runs."""
