"""Universal files written after their specification, column by column."""

import numpy as np


def block(number: str | int, *lines: str) -> str:
    return "\n".join(["    -1", f"{number:>6}", *lines, "    -1", ""])


def nodes_15(labels, places, definition=0, motion=0) -> str:
    rows = [
        f"{label:10d}{definition:10d}{motion:10d}{1:10d}" + "".join(f"{v:13.5E}" for v in place)
        for label, place in zip(labels, places, strict=True)
    ]
    return block(15, *rows)


def nodes_2411(labels, places, motion=0, part=0) -> str:
    rows = []
    for label, place in zip(labels, places, strict=True):
        rows.append(f"{label:10d}{part:10d}{motion:10d}{1:10d}")
        rows.append("".join(f"{v:25.16E}" for v in place).replace("E", "D"))
    return block(2411, *rows)


def elements_2412(*elements: tuple[int, tuple[int, ...]]) -> str:
    rows = []
    for number, (descriptor, corners) in enumerate(elements, start=1):
        rows.append("".join(f"{v:10d}" for v in (number, descriptor, 1, 1, 7, len(corners))))
        if descriptor in (11, 21, 24):
            rows.append("".join(f"{v:10d}" for v in (0, 1, 1)))
        rows.append("".join(f"{v:10d}" for v in corners))
    return block(2412, *rows)


def numbers(values) -> str:
    return "".join(f"{v:13.5E}" for v in values)


def interleaved(values) -> np.ndarray:
    """Real and imaginary parts in turn of complex values."""
    values = np.asarray(values)
    if not np.iscomplexobj(values):
        return values
    return np.column_stack([values.real, values.imag]).ravel()


def data(labels, shape) -> list[str]:
    rows = []
    for label, values in zip(labels, shape, strict=True):
        values = interleaved(values)
        rows.append(f"{label:10d}")
        rows += [numbers(values[i : i + 6]) for i in range(0, len(values), 6)]
    return rows


def shape_55(
    labels, shape, frequency, modal_mass=1.0, damping=0.0, mode=1, analysis=2, result=8, titles="NONE"
) -> str:
    n_values = np.shape(shape)[1]
    characteristic = {3: 2, 6: 3}[n_values]
    kind = 5 if np.iscomplexobj(shape) else 2
    parameters = [frequency, modal_mass, damping, 0.0] if analysis == 2 else frequency
    return block(
        55,
        *[titles] * 5,
        "".join(f"{v:10d}" for v in (1, analysis, characteristic, result, kind, n_values)),
        "".join(f"{v:10d}" for v in (2, len(parameters), 1, mode)),
        numbers(parameters),
        *data(labels, shape),
    )


def shape_2414(
    labels, shape, frequency, modal_mass=1.0, damping=0.0, mode=1, eigenvalue=None, location=1
) -> str:
    n_values = np.shape(shape)[1]
    characteristic = {3: 2, 6: 3}[n_values]
    kind = 6 if np.iscomplexobj(shape) else 4
    analysis = 2 if eigenvalue is None else 3
    s = eigenvalue or 0j
    return block(
        2414,
        f"{mode:10d}",
        f"MODE {mode}",
        f"{location:10d}",
        *["NONE"] * 5,
        "".join(f"{v:10d}" for v in (1, analysis, characteristic, 8, kind, n_values)),
        "".join(f"{v:10d}" for v in (0, 0, 0, 0, 1, mode, 0, 0)),
        "".join(f"{v:10d}" for v in (0, 0)),
        numbers([0.0, frequency, 0.0, modal_mass, damping, 0.0]),
        numbers([s.real, s.imag, 0.0, 0.0, 0.0, 0.0]),
        *data(labels, shape),
    )


def frame_18(number, kind, reference, origin, on_x, in_xz) -> str:
    values = [*origin, *on_x, *in_xz]
    return block(
        18,
        "".join(f"{v:10d}" for v in (number, kind, reference, 8, 1)),
        f"CS{number}",
        numbers(values[:6]),
        numbers(values[6:]),
    )


def frame_2420(number, kind, axes, origin) -> str:
    rows = ["".join(f"{v:25.16E}" for v in row) for row in (*np.transpose(axes), origin)]
    return block(2420, f"{1:10d}", "part", "".join(f"{v:10d}" for v in (number, kind, 8)), "CS", *rows)


def units_164(code, name, length, force) -> str:
    factors = "".join(f"{v:25.17E}" for v in (length, force, 1.0)).replace("E", "D")
    return block(164, f"{code:10d}{name:<20}{2:10d}", factors, f"{273.15:25.17E}".replace("E", "D"))
