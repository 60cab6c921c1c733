"""Variants: every student's own numbers, drawn by hash, checked to make a fair task."""

from icsolve.grade.variants.draw import drawn, label
from icsolve.grade.variants.varied import Draw, Varied

__all__ = ["Draw", "Varied", "drawn", "label"]
