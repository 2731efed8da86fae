"""OpenCRG files as their specification has them, "Data file structure" and "Road data"."""

from collections.abc import Sequence

import numpy as np

WIDTHS = {"LRFI": 10, "LDFI": 20}
TYPES = {"KRBI": ">f4", "KDBI": ">f8"}
RECORD = 80


def crg(
    heights: np.ndarray,
    increment: float,
    v: Sequence[float],
    data_format: str = "KRBI",
    channels: dict[str, np.ndarray] | None = None,
    parameters: dict[str, float] | None = None,
    numbered: bool = True,
    modifiers: dict[str, float] | None = None,
) -> bytes:
    """A file of heights (n_rows, n_sections), sections from the right.

    Args:
        heights: m.
        increment: m, along the road.
        v: of the sections, rising.
        data_format: of the road data.
        channels: other columns before the heights, by name and unit.
        parameters: besides the usual ones, or in their place.
        numbered: whether sections are named by numbers, and not by v.
        modifiers: of the section $ROAD_CRG_MODS.
    """
    said = {
        "REFERENCE_LINE_START_U": 0.0,
        "REFERENCE_LINE_END_U": increment * (len(heights) - 1),
        "REFERENCE_LINE_INCREMENT": increment,
        "LONG_SECTION_V_RIGHT": v[0],
        "LONG_SECTION_V_LEFT": v[-1],
    } | (parameters or {})
    if numbered and len(v) > 1:
        said.setdefault("LONG_SECTION_V_INCREMENT", v[1] - v[0])
    names = [f"long section {i},m" if numbered else f"long section at v = {x:.3f},m"
             for i, x in enumerate(v, 1)]  # fmt: skip
    extra = channels or {}
    lines = ["$CT", "A road", "$", "* a comment", "$ROAD_CRG    ! parameters"]
    lines += [f"{name:<26}= {float(value)!r} ! m" for name, value in said.items() if value is not None]
    lines += ["$", "$ROAD_CRG_MODS"]
    lines += [f"{name} = {value}" for name, value in (modifiers or {}).items()]
    lines += ["$", "$KD_Definition", f"#:{data_format}", "U:reference line u,m,0.0,1.0"]
    lines += [f"D:{name}" for name in (*extra, *names)]
    lines += ["$", "$" * 72, ""]
    values = np.column_stack([*extra.values(), heights])
    data = _text(values, WIDTHS[data_format]) if data_format in WIDTHS else None
    return "\n".join(lines).encode("latin-1") + (
        data if data is not None else _binary(values, TYPES[data_format])
    )


def _text(values: np.ndarray, width: int) -> bytes:
    def field(value: float) -> str:
        return "**missing*".ljust(width) if np.isnan(value) else f"{value:{width}.{width - 4}f}"[:width]

    lines = []
    per_line = RECORD // width
    for row in values:
        fields = [field(value) for value in row]
        lines += ["".join(fields[i : i + per_line]) for i in range(0, len(fields), per_line)]
    return ("\n".join(lines) + "\n").encode()


def _binary(values: np.ndarray, kind: str) -> bytes:
    numbers = values.astype(kind).ravel()
    more = -numbers.nbytes % RECORD // numbers.itemsize
    return np.concatenate([numbers, np.full(more, np.nan, kind)]).astype(kind).tobytes()
