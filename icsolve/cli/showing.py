"""`icsolve gallery`."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

import click

from icsolve.cli import BUG, bug_report
from icsolve.cli.inputs import STDIN, InputSource, sources
from icsolve.cli.options import Verb
from icsolve.cli.output import watched, write_output
from icsolve.cli.run import DONE, NO_ANSWER, UNREADABLE, complain
from icsolve.errors import CaseError, NotACase
from icsolve.tuples import NamedTuple

if TYPE_CHECKING:
    from icsolve.page.gallery import Exhibit

INDEX = "index"


class Item(NamedTuple):
    """A file to show, and the name of its files in the gallery."""

    source: InputSource
    name: str


@click.command("gallery", cls=Verb)
@click.argument("cases", metavar="CASE...", nargs=-1, required=True)
@click.option("-o", "--output", metavar="DIR", required=True, help="The folder to write into.")
@click.option("--exercises", is_flag=True, help="Cards and figures without answers, and no pages.")
@click.option("--title", metavar="TEXT", help="The heading of the index.")
@click.option("--force", is_flag=True, help="Write over files that are there.")
def gallery_command(
    cases: tuple[str, ...], output: str, exercises: bool, title: str | None, force: bool
) -> int:
    """Write an index page with the figure, the answer and the page of every case.

    \b
    icsolve gallery cases/ -o gallery
    icsolve gallery press.yaml pump.yaml -o gallery --title "Week 3"

    Where a file of that name is there already nothing is written, unless --force allows it. A case without
    an answer is shown with the reason, a file that can't be read is listed; exit status as of `solve`.
    """
    items = list(_items(cases))
    if not items:
        complain(f"icsolve gallery: there is no case in {' '.join(cases)}")
        return UNREADABLE
    taken = [] if force else _taken(items, output)
    if taken:
        more = f" (and {len(taken) - 1} more)" if len(taken) > 1 else ""
        complain(f"icsolve gallery: {taken[0]}{more} is there already; --force writes over what is there")
        return UNREADABLE
    return _write(items, output, title or _title(cases), exercises)


def _items(arguments: Iterable[str]) -> Iterator[Item]:
    """The files, each with a name of its own; names in a folder keep the folders below it."""
    used = {INDEX}
    for argument in arguments:
        for source in sources(argument):
            if source.folder is not None and not source.may_be_a_case():
                continue
            stem = _stem(source)
            name, n = stem, 2
            while name.casefold() in used:
                name, n = f"{stem}-{n}", n + 1
            used.add(name.casefold())
            yield Item(source, name)


def _title(arguments: Iterable[str]) -> str:
    """What the gallery is called: the folders or files that it was made of."""
    names = [os.path.basename(os.path.abspath(argument)) for argument in arguments]
    return f"Gallery of {', '.join(names)}" if len(names) <= 3 else "Gallery"


def _stem(source: InputSource) -> str:
    """What the files of a case are called: its own name, below the folder that was named."""
    if source.path == STDIN:
        return "stdin"
    path = os.path.relpath(source.path, source.folder) if source.folder else os.path.basename(source.path)
    return os.path.splitext(path)[0].replace(os.sep, "/")


def _taken(items: Iterable[Item], output: str) -> list[str]:
    """Files that are there already."""
    from icsolve.page.gallery import ENDINGS

    names = [f"{INDEX}.html", *(item.name + ending for item in items for ending in ENDINGS)]
    paths = [os.path.join(output, *name.split("/")) for name in names]
    return [path for path in paths if os.path.lexists(path)]


def _write(items: list[Item], output: str, title: str, exercises: bool) -> int:
    """Show each case and write its files, then the index; returns the exit status."""
    from icsolve.page.gallery import index_html

    exhibits: list[Exhibit] = []
    worst = DONE
    with watched(items, len(items), "gallery") as bar:
        for item in bar:
            one, code = _shown(item, exercises)
            if one is None:
                continue
            if not all(_put(output, item.name + ending, text) for ending, text in one.files.items()):
                return UNREADABLE
            worst = max(worst, code)
            exhibits.append(one._replace(files={}))
    done = _put(output, f"{INDEX}.html", index_html(exhibits, title))
    return worst if done else UNREADABLE


def _shown(item: Item, exercises: bool) -> tuple[Exhibit | None, int]:
    """A file as it is shown, and the exit status that it calls for; None for a file of a folder that is no
    case."""
    from icsolve.page.gallery import exhibit, unreadable

    path = item.source.path
    try:
        one = exhibit(item.source.read(None), item.name, path, exercise=exercises)
    except CaseError as error:
        if isinstance(error, NotACase) and item.source.folder is not None:
            return None, DONE
        complain(str(error))
        return unreadable(item.name, path, str(error)), UNREADABLE
    except OSError:
        raise
    except Exception as error:
        complain(bug_report(path, error))
        return unreadable(item.name, path, bug_report("", error).partition("\n")[0]), BUG
    if one.reason:
        complain(f"{path}: {one.status}: {one.reason}")
        return one, NO_ANSWER
    return one, DONE


def _put(output: str, name: str, text: str) -> bool:
    """Write a file of the gallery; whether that was done."""
    return write_output("gallery", text, os.path.join(output, *name.split("/")), folders=True) == DONE
