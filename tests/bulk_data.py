"""Bulk data as Nastran's Quick Reference Guide has it: small and large fixed fields, continuations."""

import re


def bulk_data(text: str) -> list[list[int | float | str]]:
    """The cards, each its name and its fields, eight for each small line, with "" where none is."""
    cards = []
    for line in text.splitlines():
        assert len(line) <= 80
        if line.startswith("$"):
            continue
        name, width = line[:8].strip(), 16 if "*" in line[:8] else 8
        fields = [line[8 + i * width : 8 + (i + 1) * width].strip() for i in range(64 // width)]
        if name in ("+", "*"):
            cards[-1] += fields
        else:
            cards.append([name.rstrip("*"), *fields])
    return [[card[0], *map(value, card[1:])] for card in cards]


def value(field: str) -> int | float | str:
    if re.fullmatch(r"[-+]?\d+", field):
        return int(field)
    real = re.fullmatch(r"([-+]?(?:\d+\.\d*|\.\d+))(?:E?([-+]?\d+))?", field)
    return float(f"{real[1]}e{real[2] or 0}") if real else field
