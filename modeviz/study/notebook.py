"""How results look in a notebook, in light and in dark ones."""

from collections.abc import Iterable, Mapping, Sequence
from html import escape

from modeviz.report.charts import NOW, Curve, line_chart
from modeviz.report.rate_fields import listed_fields, with_unit
from modeviz.text.axes import Axis, decibel_axis, shown_hz
from modeviz.text.markup import table
from modeviz.text.wording import percent_change, significant
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import Rates, spoken_value
from modeviz.vehicle.vehicle import Vehicle

STYLE = """<style>
.modeviz {
  --mv-paper: var(--jp-layout-color0, var(--vscode-editor-background, #fff));
  --mv-dim: color-mix(in srgb, currentColor 65%, transparent);
  --mv-line: color-mix(in srgb, currentColor 18%, transparent);
  --mv-base: #8a95a1; --mv-now: #2f86cf;
  max-width: 960px; font: 13px/1.45 system-ui, sans-serif; font-variant-numeric: tabular-nums;
}
.modeviz table { border-collapse: collapse; margin: 4px 0 10px; font-size: 13px; border: 0; }
.modeviz :is(th, td) {
  text-align: right; padding: 2px 0 2px 16px; border: 0; border-bottom: 1px solid var(--mv-line);
  font-weight: 400; background: none; white-space: nowrap;
}
.modeviz thead th, .modeviz .dim, .modeviz p { color: var(--mv-dim); }
.modeviz tr > :first-child, .modeviz .words { text-align: left; }
.modeviz tr > :first-child { padding-left: 0; }
.modeviz p { margin: 4px 0; }
.modeviz b { font-weight: 600; }
.modeviz .charts {
  display: grid; gap: 12px; grid-template-columns: repeat(auto-fill, minmax(360px, 1fr));
}
.modeviz figure { margin: 0; }
.modeviz figcaption { font-size: 12px; color: var(--mv-dim); }
</style>"""


def block(title: str, *content: str) -> str:
    """Return what a notebook shows: a title, which is escaped here, and HTML below it."""
    return f'<div class="modeviz">{STYLE}<b>{escape(title)}</b>{"".join(content)}</div>'


def paragraphs(*lines: str) -> str:
    """Return a paragraph for each line that is not empty."""
    return "".join(f"<p>{escape(line)}</p>" for line in lines if line)


def charts(figures: Iterable[str]) -> str:
    """Return figures side by side, where there is room."""
    return f'<div class="charts">{"".join(figures)}</div>'


def figure(svg: str, caption: str) -> str:
    """Return a chart with what it shows below it."""
    return f"<figure>{svg}<figcaption>{escape(caption)}</figcaption></figure>"


def spectrum(
    frequency_hz: Floats,
    decibels: Floats,
    peaks: Sequence[int],
    highest_hz: float,
    unit: str,
    caption: str,
) -> str:
    """Return a chart of one response over frequency.

    Args:
        frequency_hz: (n_freqs,).
        decibels: (n_freqs,), the response.
        peaks: the numbers of the lines that are marked.
        highest_hz: the end of the vehicle's band.
        unit: of the response.
        caption: what is drawn.
    """
    low, high = shown_hz(highest_hz)
    inside = decibels[(frequency_hz >= low) & (frequency_hz <= high)]
    y = decibel_axis(unit, [inside if len(inside) else decibels])
    curve = Curve("", frequency_hz, decibels, NOW, peaks=peaks)
    svg = line_chart([curve], Axis("Frequency, Hz", low, high), y, caption, 440, 210)
    return figure(svg, f"{caption}; peaks in Hz")


def rates_table(vehicle: Vehicle, groups: Iterable[str], sets: Mapping[str, Rates]) -> str:
    """Return rates side by side, in N/mm, and how much each differs from the first set.

    Args:
        vehicle: whose groups they are.
        groups: which of them have rows.
        sets: the rates of every group, by the name of the set.
    """
    first, *others = sets
    header = ["N/mm", escape(first), *(cell for name in others for cell in (escape(name), ""))]
    rows = [
        [escape(name), *cells]
        for group in groups
        for name, *cells in rate_rows(vehicle.mount_group(group), list(sets.values()))
    ]
    return table(header, rows)


def rate_rows(group: MountGroup, sets: Sequence[Rates]) -> list[list[str]]:
    """Return a row for each rate of a group, N/mm or as it says, and one for its loss factor.

    In a row are its name, its value in the first set, and value and change in each other.

    Args:
        group: whose rates they are.
        sets: the rates of every group.
    """
    own = [rates[group.name] for rates in sets]
    columns = [
        (with_unit(field), [spoken_value(rates, field) for rates in own])
        for field in listed_fields(group, *own)
    ]
    columns.append(("loss factor", [group.loss_factor_with(rates) for rates in own]))
    rows = []
    for what, (first, *others) in columns:
        changed = [cell for v in others for cell in (significant(v), percent_change(v, first))]
        rows.append([f"{group.name} {what}", significant(first), *changed])
    return rows
