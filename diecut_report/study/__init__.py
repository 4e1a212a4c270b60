"""Many variants of a press."""
