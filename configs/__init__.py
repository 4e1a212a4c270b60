"""Complete example configurations; each is built in the tests."""
