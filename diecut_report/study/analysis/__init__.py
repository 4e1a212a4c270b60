"""Questions to the stored variants."""
