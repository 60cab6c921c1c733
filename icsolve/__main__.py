"""``python -m icsolve``."""

from icsolve.cli import entry

if __name__ == "__main__":
    entry()
