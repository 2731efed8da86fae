"""The whole report: what is compared, the figures that count, pictures and sections."""

from base64 import b64encode
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from datetime import date
from html import escape
from importlib.metadata import version
from importlib.resources import files

from modeviz.analysis.exact_check import Check
from modeviz.analysis.results import AXIS
from modeviz.report.comparison import Comparison
from modeviz.report.html.engines import engines
from modeviz.report.html.exactness import exactness
from modeviz.report.html.forces import forces, paths
from modeviz.report.html.modes import frequencies, objective, participation, rates
from modeviz.report.html.notes import study_notes
from modeviz.report.html.ride import levels, spectra
from modeviz.report.html.rigid import rigid
from modeviz.report.html.rubber import rubber
from modeviz.report.html.statics import statics
from modeviz.report.html.wheels import wheels
from modeviz.report.notes import Note
from modeviz.text.markup import change, named_small, section, span
from modeviz.text.wording import number, signed
from modeviz.units import factor
from modeviz.vehicle.loads import Road
from modeviz.vehicle.mount_rates import RIDE_DIRECTIONS


@dataclass(frozen=True)
class Picture:
    """A picture for a report."""

    caption: str
    png: bytes


def report(
    comparison: Comparison,
    made: date,
    pictures: Sequence[Picture] = (),
    check: Check | None = None,
    remarks: Sequence[Note] = (),
) -> str:
    """A comparison as one HTML document: no scripts, nothing to load, light, dark and for paper.

    Args:
        comparison: sections for which the vehicle has no loads or points are left out.
        made: the date on it.
        pictures: shown after the figures that count.
        check: how far the second of both sets is from the exact answer.
        remarks: what people noted on the study.
    """
    first, second = map(escape, comparison.names)
    heading = f"{escape(comparison.vehicle.name)}: {second} against {first}"
    body = "".join(
        [
            f"<header><h1>{heading}</h1>{_about(comparison, made)}</header>",
            _figures(comparison),
            _pictures(pictures),
            study_notes(remarks),
            rates(comparison),
            objective(comparison),
            frequencies(comparison),
            rubber(comparison),
            rigid(comparison),
            forces(comparison),
            paths(comparison),
            statics(comparison),
            spectra(comparison),
            levels(comparison),
            participation(comparison),
            wheels(comparison),
            engines(comparison),
            exactness(comparison, check),
            _notes(comparison),
        ]
    )
    style = files("modeviz.report.html").joinpath("style.css").read_text("utf-8")
    return (
        '<!doctype html>\n<html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f"<title>{heading}</title><style>{style}</style></head><body>{body}</body></html>\n"
    )


def _about(comparison: Comparison, made: date) -> str:
    """The list of where the numbers come from."""
    items = [("Vehicle", escape(comparison.vehicle.name))]
    if comparison.rides is not None:
        conditions = comparison.rides[1].conditions
        load = comparison.rides[1].drive.load
        kilometres_per_hour = conditions.speed / factor("km/h", "speed")
        if isinstance(load, Road):
            items += [
                ("Road", named_small(load.name, load.label)),
                ("Speed", f"{kilometres_per_hour:.4g} km/h"),
            ]
        else:
            items.append(("Load", escape(load.name)))
    items += [("Date", made.isoformat()), ("Made with", f"modeviz {version('modeviz')}")]
    return f"<dl>{''.join(f'<div><dt>{k}</dt><dd>{v}</dd></div>' for k, v in items)}</dl>"


def _figures(comparison: Comparison) -> str:
    """The few numbers that a decision is made on."""
    if comparison.rides is None:
        return ""
    figures = "".join(
        f"<div><span>{what}</span><b>{now}</b><small>from {base} {difference}</small></div>"
        for what, now, base, difference in _counting(comparison)
    )
    return f'<div class="figures">{figures}</div>'


def _counting(comparison: Comparison) -> Iterator[tuple[str, str, str, str]]:
    """The title, value now, value before and change of each figure."""
    assert comparison.rides is not None
    base, now = comparison.rides
    before, after = base.rating.mean_personal_rating, now.rating.mean_personal_rating
    yield "Rating (MPR), of 10", number(after, 2), number(before, 2), _gain(after - before)
    for direction in RIDE_DIRECTIONS:
        old, new = (float(r.rms[0, AXIS[direction]]) for r in (base, now))
        yield f"{direction.capitalize()} RMS, g", f"{new:.4f}", f"{old:.4f}", change(new, old)
    old, new = base.rating.weighted_total, now.rating.weighted_total
    yield "ISO 2631-1 total, m/s²", f"{new:.3f}", f"{old:.3f}", change(new, old)


def _gain(difference: float) -> str:
    """The difference of a rating, where more is better; what rounds to none is none."""
    kind = "good" if difference > 0 else "bad"
    return span(signed(difference, 2), kind if abs(difference) >= 0.005 else "dim")


def _notes(comparison: Comparison) -> str:
    """The section with the notes on the vehicle, and on the one compared with what else there is."""
    own, (first, _) = comparison.vehicle.notes, comparison.names
    others = [note for note in comparison.base.prepared.vehicle.notes if note not in own]
    notes = [*own, *(f"{first}: {note}" for note in others)]
    if not notes:
        return ""
    items = "".join(f"<li>{escape(note)}</li>" for note in notes)
    return section("Notes on the vehicle", f"<ul>{items}</ul>")


def _pictures(pictures: Sequence[Picture]) -> str:
    if not pictures:
        return ""
    shown = "".join(
        f'<figure><img alt="{escape(p.caption)}" src="data:image/png;base64,'
        f'{b64encode(p.png).decode()}"><figcaption>{escape(p.caption)}</figcaption></figure>'
        for p in pictures
    )
    return section("Shapes", f'<div class="pictures">{shown}</div>')
