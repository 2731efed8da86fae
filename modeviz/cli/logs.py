"""Options of commands that serve: where what happens is written, and how."""

import logging
import threading
from argparse import ArgumentParser
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from logging.handlers import WatchedFileHandler
from pathlib import Path
from typing import Literal

from modeviz.errors import ModevizError, reason
from modeviz.text.log import LOG, TerminalHandler, file_formatter
from modeviz.viewer.page.wire.notices import Notices


@dataclass(frozen=True, kw_only=True)
class LogOptions:
    """Where a server's log goes."""

    log: Path | None = None
    """A file that is written on; what goes wrong stands on the terminal as well."""
    log_format: Literal["text", "json"] = "text"
    """How its lines are written, or those on the terminal if there is no file."""

    @property
    def is_log_json(self) -> bool:
        return self.log_format == "json"


def add_log(command: ArgumentParser) -> None:
    """Adds the options of the log."""
    command.add_argument(
        "--log", type=Path, metavar="FILE", help="write what happens to a file, which may be rotated"
    )
    command.add_argument(
        "--log-format",
        choices=("text", "json"),
        default="text",
        help="lines for people (default), or one JSON object a line, without --log on the terminal",
    )


@contextmanager
def logged(options: LogOptions) -> Iterator[None]:
    """Has what happens inside logged, also what nobody caught in a thread.

    Raises:
        ModevizError: the file cannot be written.
    """
    handlers = _handlers(options)
    before = [*LOG.handlers], LOG.level, threading.excepthook
    LOG.handlers[:], threading.excepthook = handlers, _report
    LOG.setLevel(logging.INFO)
    try:
        yield
    finally:
        LOG.info("stopped", extra={"event": "stopped"})
        LOG.handlers[:], threading.excepthook = before[0], before[2]
        LOG.setLevel(before[1])
        for handler in handlers:
            handler.close()


def _handlers(options: LogOptions) -> list[logging.Handler]:
    terminal = TerminalHandler()
    if options.log is None:
        if options.is_log_json:
            terminal.setFormatter(file_formatter(is_json=True))
            terminal.setLevel(logging.INFO)
        return [terminal]
    try:
        file = WatchedFileHandler(options.log, encoding="utf-8")
    except OSError as error:
        raise ModevizError(f"--log {options.log}: {reason(error)}") from None
    file.setFormatter(file_formatter(options.is_log_json))
    return [terminal, file]


def _report(uncaught: threading.ExceptHookArgs) -> None:
    """Logs what nobody caught in a thread."""
    if isinstance(uncaught.exc_value, Exception):
        Notices().mistake(uncaught.exc_value)
