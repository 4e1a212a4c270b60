"""What makes pages and catalogues of the repository from the declarations."""
