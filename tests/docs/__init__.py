"""The pages of ``docs/`` are executed: their files are written, their commands run, their outputs compared."""
