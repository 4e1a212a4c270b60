"""Tables of variants: files, headers, cells."""
