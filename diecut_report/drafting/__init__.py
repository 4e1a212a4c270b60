"""The beginning of a configuration: chosen kinds with the values of their examples, wired to each other, each key explained."""
