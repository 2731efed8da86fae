"""Fragments of page text: tables, changes, and rows that can be clicked."""

from collections.abc import Callable, Iterable, Sequence
from html import escape
from importlib.resources import files

import viser

from modeviz.errors import cut
from modeviz.text.markup import change as change
from modeviz.text.markup import span as span
from modeviz.text.markup import title as title

TWO_LINES = 32
"""Letters on two lines of a narrow column."""


def style_sheet() -> str:
    """The rules of the page's one style sheet."""
    return files("modeviz.viewer").joinpath("page/browser/style.css").read_text("utf-8")


def block(*content: str) -> str:
    """A piece of the page in our style."""
    return f'<div class="mv">{"".join(content)}</div>'


FOR_ALL = '<div class="mv-for-all"></div>'
"""Stands before a widget that looks the same where one only looks, see `looking.let_all_use`."""


def heading(left: str, right: str = "") -> str:
    """A line with a bold start and a quiet end."""
    quiet = f'<span class="dim">{right}</span>' if right else ""
    return f'<div class="heading"><span>{left}</span>{quiet}</div>'


def legend(entries: Iterable[tuple[str, str]]) -> str:
    """Return a legend of colours: variables of the style sheet and finished text."""
    return " &nbsp; ".join(
        f'<i class="swatch" style="background:var({color})"></i>{text}' for color, text in entries
    )


def hinted(text: str, hint: str) -> str:
    """Text with something to read where the pointer rests; both are page text already."""
    return f'<span title="{hint}">{text}</span>'


def named(name: str, about: str = "") -> str:
    """A name as page text, see `clamped`; of a long one beginning and end, which tell it from others.

    Args:
        name: plain text.
        about: likewise, to read where the pointer rests; else the name.
    """
    return clamped(escape(cut(name, TWO_LINES)), about or name)


def clamped(content: str, about: str) -> str:
    """Page text on at most two lines, with plain text to read where the pointer rests."""
    return f'<span class="name" title="{escape(about)}">{content}</span>'


def table(header: Sequence[str], rows: Sequence[str], kind: str = "") -> str:
    """A table of finished rows, see `row`; `kind` is its class in the style sheet."""
    head = f"<tr>{''.join(f'<th>{cell}</th>' for cell in header)}</tr>" if header else ""
    return f'<table class="{kind}">{head}{"".join(rows)}</table>'


def row(cells: Sequence[str], chosen: bool = False) -> str:
    """A table row; the cells are page text already."""
    state = ' class="on"' if chosen else ""
    return f"<tr{state}>{''.join(f'<td>{cell}</td>' for cell in cells)}</tr>"


def hidden(ids: Iterable[str]) -> str:
    """Page text that hides the widgets of some ids."""
    rows = ",".join(f'div:has(>[id="{name}"])' for name in ids)
    return f"<style>{rows}{{display:none!important}}</style>" if rows else ""


class HiddenButtons:
    """Buttons without a face, pressed by clicking other page text.

    A `<label>` around that text names the button's element; viser gives it the widget's private id.
    """

    def __init__(self, gui: viser.GuiApi, count: int, press: Callable[[int], None]) -> None:
        """Makes the buttons; `press` gets the number of the one pressed."""
        self._gui, self._press = gui, press
        self._ids: list[str] = []
        self._part = gui.add_folder(None)
        with self._part:
            self._style = gui.add_html("")
        self.reach(count)

    def reach(self, count: int) -> None:
        """Makes more of them where there are fewer than that."""
        first = len(self._ids)
        if count <= first:
            return
        with self._part:
            self._ids += [self._made(i) for i in range(first, count)]
        self._style.content = hidden(self._ids)

    def _made(self, i: int) -> str:
        button = self._gui.add_button(f"hidden {i}")
        button.on_click(lambda _: self._press(i))
        return button._impl.uuid

    def __len__(self) -> int:
        return len(self._ids)

    def label(self, i: int, text: str) -> str:
        """Text that presses button `i`."""
        return f'<label for="{self._ids[i]}">{text}</label>'
