"""Running a study: chunks of variants through an engine to rows of results."""
