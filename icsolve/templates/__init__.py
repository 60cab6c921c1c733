"""Commented cases to start from, one YAML file for each kind of mechanism in this folder."""

from __future__ import annotations

from pathlib import Path

_HERE = Path(__file__).parent


def kinds() -> list[str]:
    """The kinds that there is a template for, by name."""
    return sorted(path.stem for path in _HERE.glob("*.yaml"))


def template(kind: str) -> str:
    """The template of a kind; its first line is a comment that says what it is."""
    return (_HERE / f"{kind}.yaml").read_text(encoding="utf-8")


def nearest(kind: str) -> str | None:
    """The kind whose name is most like the given one, if any is."""
    from difflib import get_close_matches

    return next(iter(get_close_matches(kind.lower().replace("_", "-"), kinds(), n=1, cutoff=0.5)), None)
