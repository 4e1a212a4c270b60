"""From a question to a machine: solve, advise, influence."""
