"""The results of a press, and the JSON file that they are written to."""
