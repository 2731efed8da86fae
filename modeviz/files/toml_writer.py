"""Records as TOML that people like to read: arrays and tables of numbers on one line."""

import json
import re
from collections.abc import Iterator, Mapping
from typing import Any

import msgspec

from modeviz.files.records.record import FileRecord
from modeviz.files.schema.scaling import from_si


def to_toml(record: FileRecord) -> str:
    """The TOML of a file's record in SI, in `WRITTEN_UNITS`; numbers read back to the same bits."""
    table = from_si(msgspec.to_builtins(record), type(record))
    return "\n".join(toml_lines(table, "")).strip() + "\n"


def toml_lines(table: Mapping[str, Any], path: str) -> Iterator[str]:
    """Yield the lines of a table, its own values before the tables in it, which `path` goes before."""
    blocks = {key: value for key, value in table.items() if _is_block(value)}
    for key, value in table.items():
        if key not in blocks:
            yield f"{_key(key)} = {toml_value(value)}"
    for key, value in blocks.items():
        name = f"{path}{_key(key)}"
        header = f"[[{name}]]" if isinstance(value, list) else f"[{name}]"
        for inner in value if isinstance(value, list) else [value]:
            if not all(map(_is_block, inner.values())):
                yield from ("", header)
            yield from toml_lines(inner, f"{name}.")


def _is_block(value: Any) -> bool:
    """Whether the value is a table under a header of its own, or a list of such."""
    if isinstance(value, list):
        return bool(value) and isinstance(value[0], dict)
    return isinstance(value, dict) and not all(isinstance(v, int | float) for v in value.values())


def _key(key: str) -> str:
    return key if re.fullmatch(r"[A-Za-z0-9_-]+", key) else toml_value(key)


def toml_value(value: Any) -> str:
    """Return text, a number, a truth value, a list or a table of such, on one line."""
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, list):
        return f"[{', '.join(map(toml_value, value))}]"
    if isinstance(value, dict):
        return f"{{ {', '.join(f'{_key(k)} = {toml_value(v)}' for k, v in value.items())} }}"
    return str(value).lower()
