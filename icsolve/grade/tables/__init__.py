"""Tables of answers, from any platform: text to rows, rows to submissions."""

from icsolve.grade.tables.columns import FIELDS, Columns, HeaderError, Layout, Submission
from icsolve.grade.tables.platforms import recognise
from icsolve.grade.tables.text import Row, Table

__all__ = ["FIELDS", "Columns", "HeaderError", "Layout", "Row", "Submission", "Table", "recognise"]
