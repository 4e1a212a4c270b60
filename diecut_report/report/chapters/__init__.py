"""The contents of a report: its front, its chapters, its tables."""
