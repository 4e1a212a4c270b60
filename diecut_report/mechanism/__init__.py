"""What a plugin declares: inputs, steps, checks, figures, phases."""
