"""What was computed in a session before it was opened again: a line each."""

import time
from collections.abc import Sequence
from html import escape

import viser

from modeviz.journal.runs import Run
from modeviz.viewer.page.html import block, heading, span

MOST = 12
"""Lines, of the newest."""


def add_earlier_runs(gui: viser.GuiApi, runs: Sequence[Run]) -> None:
    """Lists runs, the newest first; nothing where there are none."""
    if runs:
        lines = (f"<div>{_line(run)}</div>" for run in reversed(runs[-MOST:]))
        gui.add_html(block(heading("Earlier"), *lines))


def _line(run: Run) -> str:
    when = time.strftime("%d %b %H:%M", time.localtime(run.time))
    who = f", {run.author}" if run.author else ""
    return f"{escape(run.kind)} {escape(run.title)} {span(escape(f'{when}{who}'), 'dim')}"
