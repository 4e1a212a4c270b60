"""HTML and PDF pages, and the templates that they are made from."""
