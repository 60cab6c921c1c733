"""``python -m icsolve``."""

from icsolve.cli import main

if __name__ == "__main__":
    main()
