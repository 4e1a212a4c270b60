"""From calculations to plain data: mechanisms in the order of their references, checks, the results document."""
