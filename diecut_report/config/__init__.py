"""From YAML text to a checked configuration whose references are linked."""
