"""Many machines, each a configuration of its own: calculated side by side, and compared."""
