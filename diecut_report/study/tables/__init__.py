"""Tables of variants in CSV, Parquet and XLSX."""
