"""Which mistake: the likely wrong answers of a case, each with its cause."""
