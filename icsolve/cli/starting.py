"""`icsolve new`, `icsolve schema` and `icsolve manual`: to start a file, and to read how it goes on."""

from __future__ import annotations

import click

from icsolve.cli.commands import Verb
from icsolve.cli.run import DONE, OUTPUT, UNREADABLE, complain, unwritten
from icsolve.files import KeptError, whole_file
from icsolve.manual import TOPICS, kinds, kinds_like, nearest, template, told_of, words_told


@click.command("new", cls=Verb)
@click.argument("kind", required=False)
@OUTPUT
def new_command(kind: str | None, output: str | None) -> int:
    """Print a commented case of a KIND of mechanism; without KIND, list the kinds.

    \b
    icsolve new
    icsolve new slider-crank -o pump.yaml
    """
    if kind is not None:
        return _write_template(kind, output)
    width = max(map(len, kinds()))
    for one in kinds():
        says = template(one).splitlines()[0].partition(": ")[2]
        click.echo(f"{one:<{width}}  {says}")
    return DONE


@click.command("schema", cls=Verb)
def schema_command() -> int:
    """Print the JSON Schema (draft-07) of a case, for editors."""
    import json

    from icsolve.read.schema import schema

    click.echo(json.dumps(schema(), indent=2))
    return DONE


@click.command("manual", cls=Verb)
@click.argument("topic", required=False)
def manual_command(topic: str | None) -> int:
    """Print a page of the manual, or what it tells of a word; without TOPIC, list the pages.

    \b
    icsolve manual format
    icsolve manual friction
    """
    if topic is None:
        width = max(map(len, TOPICS))
        for name, says in TOPICS.items():
            click.echo(f"{name:<{width}}  {says}")
        return DONE
    text = told_of(topic)
    if text is None:
        hint = nearest(topic, list(TOPICS)) or nearest(topic, words_told(), 0.8)
        if starts := kinds_like(topic):
            hint = f"`icsolve new {starts[0]}` starts a case of such a thing; "
        complain(f"icsolve manual: nothing is told of {topic!r}; {hint}`icsolve manual` lists the pages")
        return UNREADABLE
    click.echo(text, nl=False)
    return DONE


def _write_template(kind: str, output: str | None) -> int:
    """Print or write the case of a kind; never over a file that is there."""
    if kind not in kinds():
        alike = kinds_like(kind)[:3]
        hint = f"did you mean {' or '.join(alike)}? " if alike else ""
        complain(f"icsolve new: there is no kind {kind!r}; {hint}`icsolve new` lists the kinds")
        return UNREADABLE
    text = _for_editors(template(kind))
    if output is None or output == "-":
        click.echo(text, nl=False)
        return DONE
    return _write(text, output)


def _for_editors(text: str) -> str:
    """The case with the line, after its first, by which editors find the schema beside it."""
    from icsolve.read.schema import ID

    first, end, rest = text.partition("\n")
    return f"{first}{end}# yaml-language-server: $schema={ID}\n{rest}"


def _write(text: str, path: str) -> int:
    try:
        with whole_file(path, force=False) as file:
            file.write(text)
    except KeptError:
        complain(f"icsolve new: {path} is there already, and is left as it is; choose another name")
        return UNREADABLE
    except BrokenPipeError:
        raise
    except OSError as error:
        return unwritten("new", path, error)
    beside = _schema_beside(path)
    click.echo(f"wrote {path}{beside}; `icsolve {path}` solves it", err=True)
    return DONE


def _schema_beside(path: str) -> str:
    """Put the schema in the folder of a case where there is none yet; what to say of it."""
    import json
    import os

    from icsolve.read.schema import ID, schema

    target = os.path.join(os.path.dirname(path), ID)
    if not os.path.isfile(path):  # a device or a pipe
        return ""
    try:
        with whole_file(target, force=False) as file:
            file.write(json.dumps(schema(), indent=1) + "\n")
    except OSError:  # it is there, or can't be: the case serves without
        return ""
    return f", and {target}, by which editors complete it"
