"""`icsolve new` and `icsolve schema`: to start a file."""

from __future__ import annotations

import click

from icsolve.cli.run import DONE, UNREADABLE, complain
from icsolve.templates import kinds, nearest, template


@click.command("new")
@click.argument("kind", required=False)
@click.option("-o", "--output", metavar="FILE", help="Write here instead of standard output.")
def new_command(kind: str | None, output: str | None) -> int:
    """Print a commented case of a KIND of mechanism; without KIND, list the kinds.

    \b
    icsolve new
    icsolve new slider-crank -o pump.yaml
    """
    return list_kinds() if kind is None else write_template(kind, output)


@click.command("schema")
def schema_command() -> int:
    """Print the JSON Schema (draft-07) of a case, for editors."""
    import json

    from icsolve.read.schema import schema

    click.echo(json.dumps(schema(), indent=2))
    return DONE


def list_kinds() -> int:
    """Print every kind and what its first line says of it."""
    width = max(len(kind) for kind in kinds())
    for kind in kinds():
        says = template(kind).splitlines()[0].partition(": ")[2]
        click.echo(f"{kind:<{width}}  {says}")
    return DONE


def write_template(kind: str, output: str | None) -> int:
    """Print or write the case of a kind; never over a file that is there."""
    if kind not in kinds():
        suggestion = nearest(kind)
        hint = f"did you mean {suggestion}? " if suggestion else ""
        complain(f"icsolve new: there is no kind {kind!r}; {hint}`icsolve new` lists the kinds")
        return UNREADABLE
    if output is None or output == "-":
        click.echo(template(kind), nl=False)
        return DONE
    return _write(template(kind), output)


def _write(text: str, path: str) -> int:
    try:
        with open(path, "x", encoding="utf-8", newline="\n") as file:
            file.write(text)
    except FileExistsError:
        complain(f"icsolve new: {path} is there already, and is left as it is; choose another name")
        return UNREADABLE
    except OSError as error:
        complain(f"icsolve new: {path} can't be written: {error.strerror}")
        return UNREADABLE
    click.echo(f"wrote {path}; `icsolve {path}` solves it", err=True)
    return DONE
