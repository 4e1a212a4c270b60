"""What scripts and notebooks use."""
