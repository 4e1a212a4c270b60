"""From results to a report that is read and signed. Pure functions of the results."""
