"""Design reports for die-cutting presses: a YAML description in, a checked calculation document out."""

__version__ = "0.1.0"
