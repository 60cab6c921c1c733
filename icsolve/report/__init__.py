"""What a reader is told of an answer: its text, and what kind of mechanism it is."""
