"""`icsolve bench`."""

from __future__ import annotations

import os
import tempfile
from contextlib import suppress

import click

from icsolve.cli.run import DONE, NO_ANSWER, UNREADABLE, complain

ONE_CORE = ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS")
"""Told to numpy before it is imported: the small matrices of a scene gain nothing from threads."""


@click.command("bench")
@click.option(
    "--stress", is_flag=True, help="The stress catalogue: scenes that break solvers, with their verdicts."
)
@click.option("--full", is_flag=True, help="Hold the laws on all their scenes: about half an hour.")
@click.option(
    "-o",
    "--output",
    metavar="FILE",
    default="icsolve-bench.svg",
    show_default=True,
    help="Where the work-precision diagram goes.",
)
def bench_command(stress: bool, full: bool, output: str) -> int:
    """Measure run time against error, and print Markdown.

    \b
    icsolve bench                   two minutes; needs mpmath (the extra icsolve[bench])
    icsolve bench --stress          every scene of the stress catalogue and its verdict

    Exit status: 1 where a verdict of the catalogue is not the one asked, or a law on errors is broken (a
    time never fails); 2 where it can't run.
    """
    return _stress() if stress else _bench(full, output)


def _stress() -> int:
    from icsolve.bench.report import stress

    text, wrong = stress()
    click.echo(text)
    complain("every verdict is the one asked" if not wrong else f"{wrong} verdicts are not the ones asked")
    return NO_ANSWER if wrong else DONE


def _bench(full: bool, output: str) -> int:
    try:
        import mpmath  # noqa: F401
    except ImportError:
        complain("icsolve bench needs mpmath for its sixty digits: pip install 'icsolve[bench]'")
        return UNREADABLE
    for library in ONE_CORE:
        os.environ.setdefault(library, "1")
    try:
        handle, draft = tempfile.mkstemp(dir=os.path.dirname(os.path.abspath(output)), suffix=".svg")
    except OSError as error:
        return _cannot_write(output, error)
    from icsolve.bench.picture import picture
    from icsolve.bench.report import run

    try:
        with os.fdopen(handle, "w", encoding="utf-8", newline="\n") as file:
            kept = run(full, click.echo)
            file.write(picture(kept.scenes, kept.turns, kept.absent))
        os.chmod(draft, 0o644)
        os.replace(draft, output)
    except OSError as error:
        if isinstance(error, BrokenPipeError):
            raise
        return _cannot_write(output, error)
    finally:
        with suppress(OSError):
            os.remove(draft)
    broken = [gate.what for gate in kept.gates if not gate.timed and not gate.held]
    for what in broken:
        complain(f"icsolve bench: not kept: {what}")
    complain(f"wrote {output}")
    return NO_ANSWER if broken else DONE


def _cannot_write(path: str, error: OSError) -> int:
    complain(f"icsolve bench: {path} can't be written: {error.strerror}")
    return UNREADABLE
