"""What plain code of a plugin says where no machine can be made of the inputs."""

from __future__ import annotations


class Refused(Exception):
    """Refuse the machine: the key of the config to change (``loads.0.torque``), and in words what is wrong with it and what to do."""

    def __init__(self, key: str, message: str) -> None:
        super().__init__(message)
        self.key, self.message = key, message
