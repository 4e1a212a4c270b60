"""Texts that keep their values, their translation, and the catalogues they are found in."""
