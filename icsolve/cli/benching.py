"""`icsolve bench`."""

from __future__ import annotations

import click

from icsolve.cli.commands import Verb
from icsolve.cli.run import DONE, NO_ANSWER, UNREADABLE, complain, unwritten
from icsolve.files import whole_file


@click.command("bench", cls=Verb)
@click.option(
    "--stress", is_flag=True, help="The stress catalogue: scenes that break solvers, with their verdicts."
)
@click.option("--full", is_flag=True, help="Hold the laws on all their scenes: about an hour and a half.")
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
    icsolve bench                   two minutes; needs the extra icsolve[bench]
    icsolve bench --stress          every scene of the stress catalogue and its verdict

    Exit status: 1 where a verdict of the catalogue is not the one asked, or a promise is not kept: a law on
    errors, or a time; 2 where it can't run.
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
        import matplotlib as mpl  # noqa: F401
        import mpmath  # noqa: F401
    except ImportError as error:
        complain(f"icsolve bench needs {error.name}: pip install 'icsolve[bench]'")
        return UNREADABLE
    from icsolve.bench.report import picture, run

    try:
        with whole_file(output) as file:
            kept = run(full, click.echo)
            file.write(picture(kept.scenes, kept.turns, kept.absent))
    except BrokenPipeError:
        raise
    except OSError as error:
        return unwritten("bench", output, error)
    broken = [gate.what for gate in kept.gates if not gate.held]
    for what in broken:
        complain(f"icsolve bench: not kept: {what}")
    complain(f"wrote {output}")
    return NO_ANSWER if broken else DONE
