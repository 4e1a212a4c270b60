"""Running the declared steps, for one machine or for an array of variants."""
