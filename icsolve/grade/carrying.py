"""A wrong final answer looked at again where its student has a wrong intermediate one."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from icsolve.grade.carried import Intermediate, carried
from icsolve.grade.judge import WRONG, feedback, share_of
from icsolve.grade.keys import Key, NoKeyError, PlaceKey
from icsolve.grade.malrules import Wrong
from icsolve.grade.marked import Marked
from icsolve.grade.shelf import Shelf
from icsolve.grade.solved import Solved
from icsolve.grade.store import Entry

Found = tuple[Entry, Marked]


class Carrying:
    """Recognises errors carried forward; ``keep`` takes what is judged anew, so that it is counted."""

    def __init__(self, shelf: Shelf, reveal: bool, keep: Callable[[Marked], None]) -> None:
        self._shelf = shelf
        self._reveal = reveal
        self._keep = keep

    def looked_at(self, found: list[Found]) -> list[Found]:
        """One student's answers, those that follow from a wrong intermediate one with that cause."""
        marked = {entry.item: (entry, m) for entry, m in found}
        wrong = [item for item, (_, m) in marked.items() if ":" in item and m.judged.verdict == WRONG]
        for case in dict.fromkeys(item.partition(":")[0] for item in wrong):
            final = marked.get(case)
            if final is not None and final[1].judged.verdict == WRONG and final[1].judged.value is not None:
                own = [marked[item] for item in wrong if item.startswith(f"{case}:")]
                marked[case] = self._again(final, own)
        return list(marked.values())

    def _again(self, final: Found, wrong: list[Found]) -> Found:
        """The final answer with its cause, if it follows from the wrong steps."""
        entry, before = final
        solved = self._shelf.solved(entry.item, entry.student)
        key, name = solved.key(entry.item), getattr(solved.target(entry.item), "load", "")
        value = before.judged.value
        assert isinstance(key, Key) and value is not None
        for unscaled in carried(solved.answer, name, list(_steps(solved, wrong))):
            cause = unscaled._replace(value=unscaled.value * solved.scale)
            close = abs(value - cause.value) <= key.wrongs.reach * abs(cause.value)
            if close and abs(cause.value - key.value) > key.half:
                return entry, self._with_cause(key, before, cause)
        return final

    def _with_cause(self, key: Key, before: Marked, cause: Wrong) -> Marked:
        others = (m for m in before.judged.mistakes if m.code != "near-miss")
        mistakes = (cause, *others)[:3]
        judged = before.judged._replace(
            mistakes=mistakes,
            code=" ".join(m.code for m in mistakes),
            share=max(share_of(key, before.judged.parts, mistakes), before.judged.share),
        )
        told = feedback(key, judged, self._reveal)
        again = Marked(before.item, before.raw, judged, before.points, told, before.written)
        self._keep(again)
        return again


def _steps(solved: Solved, wrong: list[Found]) -> Iterator[Intermediate]:
    """The wrong intermediate answers that have a value."""
    for entry, marked in wrong:
        try:
            key = solved.key(entry.item)
        except NoKeyError:
            continue
        right = key.place if isinstance(key, PlaceKey) else (key.value,)
        if len(marked.given) == len(right):
            what = entry.item.partition(":")[2]
            yield Intermediate(what, solved.target(entry.item), right, marked.given)
