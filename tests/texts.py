"""The README and the pages of the manual, as the tests read them."""

from __future__ import annotations

import re
from pathlib import Path

from icsolve.manual import TOPICS, page

ROOT = Path(__file__).parent.parent
README = (ROOT / "README.md").read_text(encoding="utf-8")
PAGES = {"README": README, **{topic: page(topic) for topic in TOPICS}}


def blocks(text: str) -> list[tuple[str, str]]:
    """Kind and text of each fenced block."""
    return re.findall(r"^```(\w+)\n(.*?)^```$", text, re.DOTALL | re.MULTILINE)


def section(topic: str, title: str) -> str:
    """The text under a heading of a page, up to the next heading."""
    after = PAGES[topic].partition(f"# {title}\n")[2]
    parts = re.split(r"(^```.*?^```$)", after, flags=re.DOTALL | re.MULTILINE)
    shown = "".join(part.replace("#", "\0") if part.startswith("```") else part for part in parts)
    return re.split(r"\n#+ ", shown)[0].replace("\0", "#")


def files() -> dict[str, str]:
    """The files that the pages show: a YAML block starts with its name."""
    found: dict[str, str] = {}
    for text in PAGES.values():
        for kind, block in blocks(text):
            if kind == "yaml":
                name = re.match(r"# (\S+\.yaml)\n", block)
                assert name, "a YAML block starts with the name of its file"
                assert found.setdefault(name[1], block) == block, "one name, one file"
    return found
