"""What a mechanism plugin declares: inputs, steps of the calculation, checks, figures."""
