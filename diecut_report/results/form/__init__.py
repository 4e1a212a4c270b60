"""The form of the results file: each key with its type and what it holds (`schema` gives it as JSON Schema, docs/results-file.md in words)."""
