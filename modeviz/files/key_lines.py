"""Where in the text of a TOML file its keys stand."""

import re
from collections import Counter
from collections.abc import Iterator, Sequence

_HEADER = re.compile(r"^\s*(\[\[?)\s*([^\[\]]+?)\s*\]\]?\s*(?:#.*)?$")
_KEY = re.compile(r"""^\s*([\w-]+|"[^"]*"|'[^']*')\s*=""")


def line_of(path: str, lines: Sequence[tuple[str, int]]) -> int:
    """Return the number of the line, from one, of a key or of the table that is nearest to it.

    Zero if nothing of it is found, as with tables in unusual forms.

    Args:
        path: of the key, such as "mount_group[1].mount[0].at".
        lines: those of the file, see `key_lines`.
    """
    best, line = "", 0
    for key, number in lines:
        is_on_the_way = path == key or path.startswith((f"{key}.", f"{key}["))
        if is_on_the_way and len(key) > len(best):
            best, line = key, number
    return line


def key_lines(text: str) -> Iterator[tuple[str, int]]:
    """Return the paths of headers and of keys in a text, each with its line."""
    seen: Counter[str] = Counter()
    table = ""
    for number, line in enumerate(text.splitlines(), 1):
        if header := _HEADER.match(line):
            table = _table(header[2], header[1] == "[[", seen)
            yield table, number
        elif key := _KEY.match(line):
            name = key[1].strip("\"'")
            yield f"{table}.{name}" if table else name, number


def _table(name: str, is_item: bool, seen: Counter[str]) -> str:
    """The path of a table by its header, of which its list has had so many before."""
    path = ""
    parts = [part.strip().strip("\"'") for part in name.split(".")]
    for depth, part in enumerate(parts):
        path = f"{path}.{part}" if path else part
        if is_item and depth == len(parts) - 1:
            seen[path] += 1
        if seen[path]:
            path += f"[{seen[path] - 1}]"
    return path
