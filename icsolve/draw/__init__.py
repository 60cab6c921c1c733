"""Drawings as SVG text: the mechanism in the field's symbols, its centres with their lines, its loads.

Marks are made in picture units, shapely shapes and places them, and `svg` writes them out."""

from __future__ import annotations

from icsolve.draw.figure import Drawing, draw

__all__ = ["Drawing", "draw"]
