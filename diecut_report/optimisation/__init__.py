"""From a study to its best machines: a search through what varies, its front, and each of its points calculated again by itself."""
