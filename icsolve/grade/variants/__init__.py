"""Variants: every student's own numbers, drawn by hash, checked to make a fair task."""

from icsolve.grade.variants.varied import Draw, Varied, drawn, label

__all__ = ["Draw", "Varied", "drawn", "label"]
