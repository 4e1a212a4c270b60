"""The calculation as it is printed: formulas with numbers in, tables, items."""
