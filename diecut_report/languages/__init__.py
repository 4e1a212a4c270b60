"""Languages of reports: texts that remember what they were filled with, catalogues, translation."""
