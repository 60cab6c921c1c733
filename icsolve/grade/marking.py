"""Entries in order of student to results: attempts chosen, answers judged, errors carried forward, and what a
class answered counted.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import reduce
from itertools import chain, groupby, islice, pairwise
from operator import itemgetter
from types import MappingProxyType

from icsolve.grade.carried_forward import carried_forward
from icsolve.grade.case_store import CaseStore
from icsolve.grade.importing import Issues
from icsolve.grade.judge import IN_REVIEW, RIGHT, WRONG, Judgement, feedback, judge_answer
from icsolve.grade.keys import AnyKey, NumberKey
from icsolve.grade.mistakes.lookup import Wrong
from icsolve.grade.results import OVERRIDE, Marked, Overrides, Result
from icsolve.grade.tables.columns import NEVER, StoredAnswer, attempt_number, readings
from icsolve.grade.tolerance import NoKeyError
from icsolve.grade.variants.record import GivenValue, Neighbours
from icsolve.grade.variants.varied import owner_of
from icsolve.grade.written.answer import MISSING, Reader, WrittenAnswer
from icsolve.grade.written.two_numbers import WrittenPlace, WrittenRange

_MEMORY = 40_000
"""Different answers that are remembered with their verdicts; a class repeats itself."""
NAMED = 40
"""Students without an answer who are named; the others are in the results."""
_SAMPLE = 300
"""Answers by which it is told whether another seed was meant."""
_AT_ONCE = 5000
"""Answers of one student that are looked at together."""


BINS = 20
"""Bins of the histogram to each side of zero, up to twice the right answer; one more for what lies beyond.

The right answer, its half and its double lie in the middle of bins, so that rounding does not divide them."""
_SPAN = 2.0


OTHERS = "(other names that are no case)"
_MOST_STRANGE = 200
"""Names that are no case which are counted one by one."""
_MOST_TEXTS = 4000
"""Texts of a question that are counted one by one; of more the commonest half is kept."""
_LONGEST = 80


class Counts:
    """What a class answered to one question."""

    def __init__(self) -> None:
        self.verdicts: Counter[str] = Counter()
        self.mistakes: Counter[str] = Counter()
        """by the first cause; '' for those of no known cause"""
        self.bins: Counter[int] = Counter()
        """answers by `bin_of` their ratio to the right one"""
        self.unread: Counter[str] = Counter()
        """invalid answers and those for review, by their flag"""
        self.score = self.max_score = 0.0
        """marks, and the most that there were, of what was judged"""
        self.texts: Counter[str] = Counter()
        """the texts that wait for a person"""
        self.unexplained: Counter[str] = Counter()
        """the wrong values of no known cause, to four figures"""

    def add(self, m: Marked, key: AnyKey | None) -> None:
        """Count an answer as often as it was given; its own count starts again."""
        judged, n = m.judged, m.count
        verdict, share, _, value, _, code, causes, _ = judged
        self.verdicts[verdict] += n
        if verdict == "wrong":
            self.mistakes[causes[0].code if causes else ""] += n
            if not causes and value is not None:
                _count_text(self.unexplained, f"{value:.4g}", n)
        elif verdict in ("invalid", "review"):
            self.unread[code] += n
            _count_text(self.texts, " ".join(m.raw.split())[:_LONGEST], n)
        if value is not None and isinstance(key, NumberKey):
            self.bins[bin_of(value, key.value, key.half)] += n
        if m.score is not None:
            self.score += n * share * m.points
            self.max_score += n * m.points
        m.count = 0


def _count_text(texts: Counter[str], text: str, n: int) -> None:
    """Count a text; of too many the commonest half is kept."""
    texts[text] = texts.get(text, 0) + n
    if len(texts) > _MOST_TEXTS:
        common = texts.most_common(_MOST_TEXTS // 2)
        texts.clear()
        texts.update(dict(common))


def bin_of(value: float, right: float, half: float) -> int:
    """The bin of an answer: of its ratio to the right one, of a zero by half-widths."""
    ratio = value / right if right else (value / half if half else 0.0)
    if not math.isfinite(ratio) or abs(ratio) > _SPAN * (1.0 + 0.5 / BINS):
        return (BINS + 1) * (1 if ratio > 0 else -1)
    return round(ratio / _SPAN * BINS)


class Tally:
    """Counts that grow: what was judged is counted and forgotten; ``key`` tells the key of a question."""

    def __init__(self, key: Callable[[str], AnyKey | None]) -> None:
        self._key = key
        self._strange = 0
        self.counts: dict[str, Counts] = {}

    def add(self, marked: Iterable[Marked]) -> None:
        """Count answers, each as often as it was given."""
        for m in marked:
            item = self._item_of(m)
            if item not in self.counts:
                self.counts[item] = Counts()
            self.counts[item].add(m, self._key(item))

    def _item_of(self, m: Marked) -> str:
        """The question under which an answer is counted; of names that are no case only so many are kept."""
        strange = m.judged.code == "not-graded" and m.item not in self.counts
        if strange:
            self._strange += 1
        return OTHERS if strange and self._strange > _MOST_STRANGE else m.item


class Marker:
    """Judges entries; ``case_store`` has the keys, ``neighbours`` the right answers of the whole class, where
    they differ, ``overrides`` the marks given by hand. ``path`` is the file of answers, for what is noted;
    ``groups`` has the members with whom each student handed in, if any."""

    def __init__(
        self,
        case_store: CaseStore,
        path: str,
        issues: Issues,
        questions: Iterable[str],
        neighbours: Neighbours | None = None,
        overrides: Overrides | None = None,
        groups: Mapping[str, tuple[str, ...]] = MappingProxyType({}),
    ) -> None:
        self.case_store, self.course = case_store, case_store.course
        self.issues = issues
        self.path = path
        self.given: list[GivenValue] = []
        """values given to questions with variables, of the first students"""
        self._neighbours = neighbours
        self._overrides = overrides or {}
        self._groups = groups if case_store.varied else {}
        self.overruled: set[tuple[str, str]] = set()
        """students and questions whose marks were given by hand"""
        self.questions = frozenset(questions)
        self._reader = Reader(self.course.decimal)
        self._memory: dict[tuple[str, str, str, str, str], Marked] = {}
        self._missing: dict[str, Marked] = {}
        self._uncounted: list[Marked] = []
        self.owing: dict[str, list[str]] = {}
        """of each question the first students who gave no answer"""
        self.silent = 0
        """students who gave no answer at all"""
        self.tally = Tally(case_store.common_key)

    def results(self, entries: Iterable[StoredAnswer], students: Iterable[str] = ()) -> Iterator[Result]:
        """The results of sorted entries, and of sorted ``students`` who may have given none."""
        waiting = iter(students)
        owed = next(waiting, None)
        for student, own in groupby(entries, key=itemgetter(0)):
            while owed is not None and owed < student:
                yield from self._student(owed, [])
                owed = next(waiting, None)
            if owed == student:
                owed = next(waiting, None)
            yield from self._of_student(student, own)
        while owed is not None:
            yield from self._student(owed, [])
            owed = next(waiting, None)

    def _of_student(self, student: str, entries: Iterator[StoredAnswer]) -> Iterator[Result]:
        """In pieces, should one id have an endless number of rows; rows without an id one by one."""
        if not student:
            return (self._result(entry, self._troubled(entry, entry.trouble)) for entry in entries)
        chosen = list(islice(entries, _AT_ONCE))
        if len(chosen) == _AT_ONCE:
            return self._endless(chain(chosen, entries))
        if self.case_store.varied:
            chosen = [self._by_its_numbers(entry) for entry in chosen]
        if student in self._groups:
            chosen = self._by_one_of_group(chosen, self._groups[student])
        if len({entry.item for entry in chosen}) < len(chosen):
            groups = groupby(chosen, key=itemgetter(1))
            chosen = [self._chosen(list(attempts)) for _, attempts in groups]
        return self._student(student, chosen)

    def _by_its_numbers(self, entry: StoredAnswer) -> StoredAnswer:
        """An answer that itself says to which numbers it is given, as of whoever has these."""
        varied = self.case_store.variation(entry.item.partition(":")[0]) if entry.variant else None
        owner = owner_of(entry.variant)
        return entry._replace(student=owner) if varied is not None and owner in varied.by_owner else entry

    def _by_one_of_group(self, entries: list[StoredAnswer], members: tuple[str, ...]) -> list[StoredAnswer]:
        """A group hands in one solution, to the numbers of one of them: the answers to each case as of the
        member to whose numbers they fit best, the same for all members."""
        found: list[StoredAnswer] = []
        for _, same_case in groupby(entries, key=lambda entry: entry.item.partition(":")[0]):
            own = list(same_case)
            ways = [[entry._replace(student=member) for entry in own] for member in members]
            found += max(ways, key=lambda way: sum(self._marked(entry).judged.share for entry in way))
        return found

    def _endless(self, entries: Iterator[StoredAnswer]) -> Iterator[Result]:
        """Question by question, without what looks at all of them together."""
        for _, attempts in groupby(entries, key=itemgetter(1)):
            entry = reduce(lambda chosen, other: self._chosen([chosen, other]), attempts)
            yield self._result(entry, self._marked(entry))

    def _student(self, student: str, chosen: list[StoredAnswer]) -> Iterator[Result]:
        """One student's results, with what is missing, in order of the questions."""
        found = [(entry, self._marked(entry)) for entry in chosen]
        self.silent += not chosen
        if any(":" in entry.item for entry in chosen):
            found = carried_forward(self.case_store, found)
        if student:
            self._add_missing(student, found)
        for entry, judged in found:
            variant = self._variant(entry) if self.case_store.varied else ""
            own = entry if entry.student == student else entry._replace(student=student)
            yield self._result(own, judged, variant)

    def _add_missing(self, student: str, found: list[tuple[StoredAnswer, Marked]]) -> None:
        """What the student owes and did not answer; an answer under a name that is nearly that of a case
        waits for a person, and is not missing too."""
        missing = self.questions.difference([entry.item for entry, _ in found])
        if missing:
            meant = {self.case_store.meant(entry.item) for entry, _ in found if entry.trouble}
            missing -= {item for item in meant if (student, item) not in self._overrides}
            for item in missing:
                names = self.owing.setdefault(item, [])
                if len(names) < NAMED:
                    names.append(student)
            absent = (StoredAnswer(student, item, 0) for item in missing)
            found += [(entry, self._absent(entry)) for entry in absent]
            found.sort(key=lambda pair: pair[0].item)

    def _final(self, entry: StoredAnswer, marked: Marked) -> Marked:
        """An answer as it was judged, or with the mark that was given by hand."""
        override = self._overrides.get((entry.student, entry.item))
        if override is None:
            return marked
        self.overruled.add((entry.student, entry.item))
        points, judged = marked.points, marked.judged
        share = override.score / points if points else 0.0
        verdict = RIGHT if override.score >= points else WRONG
        cause = Wrong(OVERRIDE, judged.value or 0.0)
        again = judged._replace(verdict=verdict, share=share, code=OVERRIDE, mistakes=(cause,))
        told = f"Marked by hand: {override.comment}" if override.comment else "Marked by hand."
        return Marked(marked.item, marked.raw, again, points, told, marked.read)

    def _result(self, entry: StoredAnswer, marked: Marked, variant: str = "") -> Result:
        """Counted, as the line of the variant that is the student's own, or that the answer names."""
        if self._overrides:
            marked = self._final(entry, marked)
        if not marked.count:
            if len(self._uncounted) >= _MEMORY:
                self.counted()
            self._uncounted.append(marked)
        marked.count += 1
        return Result(entry.student, entry.item, variant or entry.variant, entry.attempt, entry.line, marked)

    def _chosen(self, attempts: list[StoredAnswer]) -> StoredAnswer:
        """The attempt that counts, of several in order of their lines; what nothing tells apart is listed."""
        good = [entry for entry in attempts if not entry.trouble] or attempts[-1:]
        ranked = sorted(good, key=self._rank)
        if len(good) > 1:
            by_day = sorted(good, key=lambda entry: self._rank(entry, 1))
            at = 0 if self.course.attempt == "first" else -1
            if by_day[at] != ranked[at] and self.course.attempt != "best":
                return self._two_orders(ranked[at], by_day[at])
        for before, entry in pairwise(ranked):
            if self._rank(before) == self._rank(entry):
                line, which = (entry if self.course.attempt == "first" else before).line, self.course.attempt
                what = "column" if before.line == entry.line else "row"
                said = f"the same student answers the same question again; the {which} {what} counts"
                self.issues.note(self.path, line, said)
        if self.course.attempt == "first":
            return ranked[0]
        if self.course.attempt == "best":
            return max(reversed(ranked), key=lambda entry: _worth(self._marked(entry).judged))
        return ranked[-1]

    def _two_orders(self, entry: StoredAnswer, other: StoredAnswer) -> StoredAnswer:
        """Two attempts of which either may be the one that counts, as their dates are read."""
        why = (
            f"{entry.time!r} and {other.time!r} can be read month first or day first, and another attempt "
            "counts then; --dates month or --dates day says which"
        )
        self.issues.note(self.path, entry.line, why, serious=True)
        return entry._replace(trouble=why)

    def _rank(self, entry: StoredAnswer, reading: int = 0) -> tuple[int, float]:
        """By the number of the attempt, then by its time, its date read month first or (1) day first."""
        time = readings(entry.time)[reading]
        if time is None:
            why = "this time can't be read; the order of the rows tells which is last"
            self.issues.note(self.path, entry.line, why)
        return attempt_number(entry.attempt), NEVER if time is None else time

    def _marked(self, entry: StoredAnswer) -> Marked:
        if entry.trouble:
            return self._troubled(entry, entry.trouble)
        variant = ""
        if self.case_store.varied:
            variant = self._variant(entry) + ("!" if self._is_others(entry) else "")
        key = (entry.item, variant, entry.answer, entry.unit, entry.direction)
        found = self._memory.get(key)
        if found is None:
            if len(self._memory) >= _MEMORY:
                self._memory.clear()
            found = self._memory[key] = self._judged(entry)
        return found

    def _variant(self, entry: StoredAnswer) -> str:
        """The label of the student's own values; '' where the case has no variables."""
        return self.case_store.variant_of(entry.item, entry.student)

    def _is_others(self, entry: StoredAnswer) -> bool:
        """Whether the answer says that it is to another variant than the student's."""
        given = entry.variant.strip()
        return bool(given) and self._variant(entry) not in ("", given)

    def counted(self) -> dict[str, Counts]:
        """The counts of all results so far."""
        self.tally.add(self._uncounted)
        self._uncounted.clear()
        return self.tally.counts

    def _judged(self, entry: StoredAnswer) -> Marked:
        try:
            key = self.case_store.key(entry.item, entry.student)
        except NoKeyError as error:
            self.issues.note(self.path, entry.line, f"not graded: {error}", serious=True)
            return self._troubled(entry, error.told)
        if self.case_store.varied and self._is_others(entry):
            return self._of_another(entry)
        judged, read = judge_answer(key, self._reader, entry.answer, entry.unit, entry.direction)
        if self._neighbours is not None and isinstance(key, NumberKey) and isinstance(read, WrittenAnswer):
            judged = self._beside_others(entry, judged, read)
        told = feedback(key, judged, self.course.reveal)
        far = isinstance(read, WrittenPlace) and read.toward is not None
        seen = None if read.flag or far or isinstance(read, WrittenRange) else read
        return Marked(entry.item, entry.answer, judged, key.policy.points, told, seen)

    def _beside_others(self, entry: StoredAnswer, judged: Judgement, written: WrittenAnswer) -> Judgement:
        """The verdict on an answer to a question with variables: it may be right for another's numbers."""
        if judged.value is None or not self.case_store.variant_of(entry.item, entry.student):
            return judged
        if len(self.given) < _SAMPLE:
            right = judged.verdict == RIGHT
            self.given.append(GivenValue(entry.student, entry.item, judged.value, right))
        if judged.verdict != WRONG or any(m.code != "near-miss" for m in judged.mistakes):
            return judged
        assert self._neighbours is not None
        label = self._neighbours.variant(entry.item, judged.value, written.digits)
        found = (Wrong("neighbour", judged.value, label),) if label else ()
        return judged._replace(code="neighbour", mistakes=found) if found else judged

    def _troubled(self, entry: StoredAnswer, why: str) -> Marked:
        """A row that can't be graded: for a person to look at."""
        return self._unjudged(entry, IN_REVIEW, "not-graded", f"Not graded: {why}")

    def _of_another(self, entry: StoredAnswer) -> Marked:
        """An answer to numbers that are not the student's: a person must say whose it is."""
        told = "this answer names another variant than the student's; --variants values.csv takes the numbers"
        self.issues.note(self.path, entry.line, f"{told} that were handed out")
        why = f"This is an answer to variant {entry.variant}; yours is {self._variant(entry)}."
        return self._unjudged(entry, IN_REVIEW, "other-variant", why)

    def _absent(self, entry: StoredAnswer) -> Marked:
        found = self._missing.get(entry.item)
        if found is None:
            found = self._unjudged(entry, MISSING, MISSING, "No answer was given.")
            self._missing[entry.item] = found
        return found

    def _unjudged(self, entry: StoredAnswer, verdict: str, code: str, told: str) -> Marked:
        """An answer that nothing was read of."""
        judged = Judgement(verdict, 0.0, (False, False, False), code=code)
        return Marked(entry.item, entry.answer, judged, self.course.policy_of(entry.item).points, told)


def _worth(judged: Judgement) -> tuple[float, bool]:
    """By which one attempt is better than another: its mark; what a person has to read may be worth the whole
    one, which is enough where another has it."""
    waits = judged.verdict == IN_REVIEW
    return 1.0 if waits else judged.share, not waits
