"""What a report carries with it, and how it is read back, verified and signed."""
