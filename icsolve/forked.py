"""Work in processes that share what was read and solved; where systems can't, all is done in one."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any


def can_fork() -> bool:
    """Whether a process can be split in two with all that it knows."""
    return sys.platform == "linux"


@contextmanager
def started(calls: Sequence[tuple[Callable[..., Any], tuple[Any, ...]]]) -> Iterator[Callable[[], list[Any]]]:
    """Start each call in a process of its own; gives what waits for their results, in order.

    Raises RuntimeError from the waiting where a process failed.
    """
    from multiprocessing import get_context

    context = get_context("fork")
    running = []
    for function, arguments in calls:
        receiver, sender = context.Pipe(duplex=False)
        process = context.Process(target=_run, args=(function, arguments, sender), daemon=True)
        process.start()
        sender.close()  # else a process that dies would leave the receiver waiting
        running.append((process, receiver))
    try:
        yield lambda: [_received(receiver) for _, receiver in running]
    finally:
        for process, receiver in running:
            receiver.close()
            process.join(1.0)
            if process.is_alive():
                process.terminate()
                process.join()


def _run(function: Callable[..., Any], arguments: tuple[Any, ...], sender: Any) -> None:
    """In the new process: the result, or what went wrong."""
    try:
        sender.send((True, function(*arguments)))
    except BaseException as error:
        sender.send((False, f"{type(error).__name__}: {error}"))
    finally:
        sender.close()


def _received(receiver: Any) -> Any:
    try:
        good, result = receiver.recv()
    except EOFError:
        good, result = False, "it ended early"
    if not good:
        raise RuntimeError(f"a process failed: {result}")
    return result
