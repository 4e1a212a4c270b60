"""The number of the contract between the program and its plugins: it grows when a plugin that was written before would no longer run."""

CONTRACT = 1
