"""Tables of answers, from any platform: text to rows, rows to submissions."""
