"""Units, how quantities are read and printed, and the sizes a machine may have."""
