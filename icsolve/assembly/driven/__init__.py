"""Where the links of a driven mechanism are, on any arithmetic that a record runs on."""
