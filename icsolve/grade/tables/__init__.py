"""Tables of answers, from any platform: text to rows, rows to submissions."""

from icsolve.grade.tables.columns import FIELDS, Columns, HeaderError, Submission, TableLayout
from icsolve.grade.tables.platforms import recognise
from icsolve.grade.tables.text import Table, TableRow

__all__ = ["FIELDS", "Columns", "HeaderError", "Submission", "Table", "TableLayout", "TableRow", "recognise"]
