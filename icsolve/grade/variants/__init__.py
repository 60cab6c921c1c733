"""Variants: every student's own numbers, drawn by hash, checked to make a fair task."""
