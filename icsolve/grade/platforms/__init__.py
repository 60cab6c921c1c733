"""Results and questions in the forms of learning platforms."""
