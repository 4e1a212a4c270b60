"""The page on which a designer changes a press and sees what follows."""
