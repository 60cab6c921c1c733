"""The words of an answer: numbers, senses, ranges, sentences, its text and its JSON."""
