"""Questions to the results of a study."""
