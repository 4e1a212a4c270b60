"""The built-in mechanisms, one module or folder each."""
