"""Templates and style sheets of the report, and its fonts."""
