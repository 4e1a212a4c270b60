"""The report in the formats of office programs: DOCX with its formulas as Office Math, XLSX with its numbers as numbers."""
