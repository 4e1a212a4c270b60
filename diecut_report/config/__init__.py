"""From the text of a press configuration to checked, linked inputs."""
