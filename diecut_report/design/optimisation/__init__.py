"""From a study to its best machines."""
