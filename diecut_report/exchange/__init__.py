"""What leaves the program and comes back: a report's own calculation, taken out, verified, rendered again, compared."""
