"""What others write with the program: the packages and repositories in ``examples/``, used as they would use them."""
