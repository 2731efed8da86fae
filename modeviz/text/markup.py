"""Pieces of HTML that need no program behind them. Cells and content are HTML already, see `escape`."""

from collections.abc import Collection, Sequence
from functools import lru_cache
from html import escape

from modeviz.text.wording import percent_change, sentence_case

NONE = '<span class="dim">–</span>'
"""Where there is no number."""

WORDS = ' class="words"'


def span(content: str, kind: str) -> str:
    """Text of a kind: "dim", "good" or "bad"."""
    return f'<span class="{kind}">{content}</span>'


@lru_cache
def title(name: str) -> str:
    """A name with a capital, escaped."""
    return escape(sentence_case(name))


def named_small(name: str, label: str) -> str:
    """A name, escaped, with what people call it in small letters where that is something else."""
    return escape(name) + (f" <small>{escape(label)}</small>" if label != name else "")


def change(now: float, base: float) -> str:
    """The change in percent, good or bad where less is better."""
    text = percent_change(now, base)
    unchanged = text in ("0.0 %", "–")
    return span(text, "dim" if unchanged else "good" if now < base else "bad")


def section(heading: str, *content: str) -> str:
    """A part of a document."""
    return f"<section><h2>{heading}</h2>{''.join(content)}</section>"


def note(text: str) -> str:
    """A remark on the table or figure before it."""
    return f'<p class="note">{text}</p>'


def table(
    header: Sequence[str],
    rows: Sequence[Sequence[str]],
    groups: Sequence[tuple[str, int]] = (),
    words: Collection[int] = (),
) -> str:
    """A table of numbers whose first column names its rows.

    Args:
        header: a cell for each column.
        rows: likewise; a row of one cell is a heading over those that follow.
        groups: what stands above the header, and over how many columns.
        words: the numbers of other columns that hold words, not numbers.
    """
    above = "".join(f'<th colspan="{n}" scope="colgroup">{text}</th>' for text, n in groups)
    head = "".join(
        f'<th scope="col"{WORDS if i in words else ""}>{text}</th>' for i, text in enumerate(header)
    )
    body = "".join(_row(cells, len(header), words) for cells in rows)
    upper = f'<tr class="groups">{above}</tr>' if groups else ""
    return f"<table><thead>{upper}<tr>{head}</tr></thead><tbody>{body}</tbody></table>"


def _row(cells: Sequence[str], n_columns: int, words: Collection[int]) -> str:
    name, *values = cells
    if not values:
        return f'<tr class="over"><th colspan="{n_columns}" scope="rowgroup">{name}</th></tr>'
    data = (f"<td{WORDS if i in words else ''}>{v}</td>" for i, v in enumerate(values, 1))
    return f'<tr><th scope="row">{name}</th>{"".join(data)}</tr>'
