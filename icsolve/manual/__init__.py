"""The manual, a Markdown page a topic, and commented cases to start from, a YAML file a kind of mechanism."""

from __future__ import annotations

import re
from difflib import get_close_matches
from pathlib import Path

_HERE = Path(__file__).parent
TOPICS = {
    "format": "the case file: names, units, figure, joints, friction, loads, motion, published values",
    "commands": "every command with its options, exit statuses",
    "results": "what `--json` holds",
    "statuses": "why a case has no answer: every status",
    "sweeps": "a range of positions or loads: paths, motion from the position as written, `--find`",
    "cams": "profiles of cams and their followers",
    "pages": "one HTML file that moves",
    "grading": "students' answers: tables, verdicts, mistakes, course, variants, platforms",
    "library": "icsolve in Python and in notebooks",
    "accuracy": "error bounds, and run time against other ways to solve",
    "problems": "the 24 problems of the source document",
    "errata": "what is wrong in its print",
    "history": "what changed",
    "inside": "for those who work on icsolve",
}
"""The pages in their order, and what each tells."""
SHORTEST = 3
"""Letters of a word that paragraphs are searched for."""


def page(topic: str) -> str:
    """The page of a topic."""
    return (_HERE / f"{topic}.md").read_text(encoding="utf-8")


def told_of(word: str) -> str | None:
    """What the manual tells of a word: its page; else the sections, of all pages, whose heading starts with
    it; else the page whose contents name it; else the paragraphs that hold it. None where there are none.
    """
    if word in TOPICS:
        return page(word)
    held = re.compile(rf"\b{re.escape(word)}", re.IGNORECASE)
    parts = {topic: re.sub(r"(?ms)^```.*?^```$", _hidden, page(topic)) for topic in TOPICS}
    sections = [part for text in parts.values() for part in re.split(r"^(?=#+ )", text, flags=re.MULTILINE)]
    found = [part for part in sections if held.match(part.lstrip("# "))]
    if not found and len(word) >= SHORTEST:
        found = [page(topic) for topic, says in TOPICS.items() if held.search(says)][:1]
    if not found and len(word) >= SHORTEST:
        for topic, text in parts.items():
            told = [block for block in re.split(r"\n{2,}|\n(?=\|)", text) if held.search(block)]
            found += [f"# {topic}", *told] if told else []
    return "\n".join(part.replace("\0", "#").strip() + "\n" for part in found) or None


def words_told() -> list[str]:
    """The words of the manual, those of its headings first."""
    texts = [page(topic) for topic in TOPICS]
    headings = re.findall(r"(?m)^#+ (.*)", "\n".join(texts))
    found = (word.lower() for text in (*headings, *texts) for word in re.findall(r"[A-Za-z]{4,}", text))
    return list(dict.fromkeys(found))


def _hidden(block: re.Match[str]) -> str:
    """A block with its comments' signs put aside, which are no headings."""
    return block.group().replace("#", "\0")


def kinds() -> list[str]:
    """The kinds of mechanism that there is a template for, by name."""
    return sorted(path.stem for path in (_HERE / "templates").glob("*.yaml"))


def kinds_like(word: str) -> list[str]:
    """The kinds that a word may mean: by a slip of the pen, a part of their names, or their descriptions
    (``epicyclic`` for ``planetary``).
    """
    begins = {part[:6] for part in re.findall(r"[a-z]{4,}", word.lower())}
    described = {kind: template(kind).partition("\n")[0].lower() for kind in kinds()}

    def having(texts: dict[str, str]) -> list[str]:
        words = {kind: {one[:6] for one in re.findall(r"[a-z]+", text)} for kind, text in texts.items()}
        return [kind for kind, own in words.items() if begins & own]

    close = get_close_matches(word.lower().replace("_", "-"), kinds(), n=1, cutoff=0.8)
    return close or having({kind: kind for kind in described}) or having(described)


def template(kind: str) -> str:
    """The template of a kind; its first line is a comment that says what it is."""
    return (_HERE / "templates" / f"{kind}.yaml").read_text(encoding="utf-8")


def nearest(word: str, options: list[str], least: float = 0.65) -> str:
    """``did you mean ...? `` for the option that is most like a word, else nothing."""
    near = get_close_matches(word.lower().replace("_", "-"), options, n=1, cutoff=least)
    return f"did you mean {near[0]}? " if near else ""
