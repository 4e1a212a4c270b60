"""How each step prints: formula, numbers put in, result."""
