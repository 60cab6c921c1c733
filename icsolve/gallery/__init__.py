"""A gallery of cases: for each its figure, answer and page, and an index of all."""

from __future__ import annotations

from icsolve.gallery.exhibit import ENDINGS, Exhibit, exhibit, unreadable
from icsolve.gallery.index import index_html

__all__ = ["ENDINGS", "Exhibit", "exhibit", "index_html", "unreadable"]
