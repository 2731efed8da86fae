"""What was decided, in words: a title, and each thing as it was and is."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import fields
from typing import Any, TypeVar

from modeviz.errors import listed
from modeviz.journal.changes import Difference
from modeviz.journal.differences import pinned_differences
from modeviz.journal.tuning import Pinned
from modeviz.report.rate_fields import spoken
from modeviz.vehicle.absorber import Absorber
from modeviz.vehicle.mount_rates import RATE_FIELDS, MountRates
from modeviz.vehicle.placement import Placement
from modeviz.viewer.session.design import Design, Variant

Thing = TypeVar("Thing")

GIVEN = Placement()
FEW = 3
"""So many groups are named in a title."""


def differences(before: Design, after: Design) -> tuple[Difference, ...]:
    """Return all that differs between two designs, in engineers' words and units."""
    return (
        *pinned_differences(_present(before), _present(after)),
        *_of_things("absorber", _absorbers(before), _absorbers(after), _absorber_words),
        *_of_things("variant", before.variants, after.variants, _variant_words),
        *_of_sets("lock", _locks(before), _locks(after)),
        *_of_sets("kept ratios", before.linked, after.linked),
        *_of_fields("target", before.decoupling, after.decoupling),
        *_of_fields("search", before.plan, after.plan),
    )


def title(before: Design, after: Design) -> str:
    """Return what was decided between two designs, in a line: "Set C2.lateral"."""
    words = [
        *_of_variants(before, after),
        *_of_absorbers(before, after),
        *_of_tuning(before, after),
        *_of_locks(before, after),
    ]
    if before.decoupling != after.decoupling:
        words.append("change targets")
    if before.plan != after.plan and not words:
        words.append("change what a search is to find")
    said = ", ".join(words) or "change"
    return said[:1].upper() + said[1:]


def _present(design: Design) -> Pinned:
    return Pinned(design.rates, design.alterations.placements)


def _of_things(
    kind: str, before: Mapping[str, Thing], after: Mapping[str, Thing], words: Callable[[Thing], str]
) -> Iterator[Difference]:
    """What is there otherwise, by name."""
    for name in _either(before, after):
        if before.get(name) != after.get(name):
            was, now = (words(each[name]) if name in each else "" for each in (before, after))
            yield Difference(f"{kind} {name}", was, now)


def _absorbers(design: Design) -> Mapping[str, Absorber]:
    return {absorber.name: absorber for absorber in design.alterations.absorbers}


def _absorber_words(absorber: Absorber) -> str:
    return f"{absorber.mass:.4g} kg on {absorber.body}, {absorber.frequency_hz:.4g} Hz"


def _variant_words(variant: Variant) -> str:
    return f"rates of {listed(variant.rates)}"


def _locks(design: Design) -> frozenset[str]:
    return frozenset(f"{group}.{spoken(field)}" for group, field in design.locked)


def _of_sets(kind: str, before: frozenset[str], after: frozenset[str]) -> Iterator[Difference]:
    yield from (Difference(f"{kind} {name}", "on", "") for name in sorted(before - after))
    yield from (Difference(f"{kind} {name}", "", "on") for name in sorted(after - before))


def _of_fields(kind: str, before: Any, after: Any) -> Iterator[Difference]:
    """The fields of two dataclasses that differ; numbers and texts as they are, others counted."""
    for field in fields(after or before) if before != after else ():
        was, now = (getattr(each, field.name, None) for each in (before, after))
        if was != now:
            yield Difference(f"{kind} {field.name.replace('_', ' ')}", _brief(was), _brief(now))


def _brief(value: object) -> str:
    if isinstance(value, float):
        return f"{value:.4g}"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, str | int):
        return str(value)
    if isinstance(value, frozenset):
        return listed(sorted(value))
    return "" if value is None else "as it was then"


def _of_variants(before: Design, after: Design) -> Iterator[str]:
    old = {variant.number: name for name, variant in before.variants.items()}
    new = {variant.number: name for name, variant in after.variants.items()}
    for number, name in new.items():
        if number not in old:
            yield f"pin {name}"
        elif old[number] != name:
            yield f"rename {old[number]} to {name}"
        elif before.variants[name] != after.variants[name]:
            yield f"pin {name} again"
    yield from (f"forget {name}" for number, name in old.items() if number not in new)


def _of_absorbers(before: Design, after: Design) -> Iterator[str]:
    old, new = _absorbers(before), _absorbers(after)
    yield from (f"add absorber {name}" for name in new if name not in old)
    yield from (f"remove absorber {name}" for name in old if name not in new)
    yield from (f"change absorber {name}" for name in new if name in old and new[name] != old[name])


def _of_tuning(before: Design, after: Design) -> Iterator[str]:
    """Rates and places of what both designs have."""
    groups = [g for g in after.rates if g in before.rates and after.rates[g] != before.rates[g]]
    places = before.alterations.placements, after.alterations.placements
    moved = [g for g in _either(*places) if places[0].get(g, GIVEN) != places[1].get(g, GIVEN)]
    loaded = _loaded(before, after)
    if loaded and (len(groups) > 1 or (groups and moved)):
        yield f"load {loaded}"
        return
    if len(groups) == 1:
        yield f"set {_one_group(groups[0], before.rates[groups[0]], after.rates[groups[0]])}"
    elif groups:
        yield f"set {_few(groups)}"
    if moved:
        yield f"place {_few(moved)}"


def _loaded(before: Design, after: Design) -> str:
    """The variant of before that the rates and places after are; "" if they are none."""
    now = {**after.rates}, after.alterations
    same = (n for n, v in before.variants.items() if ({**v.rates}, v.alterations) == now)
    return next(same, "")


def _one_group(group: str, before: MountRates, after: MountRates) -> str:
    changed = [f for f in RATE_FIELDS if getattr(before, f) != getattr(after, f)]
    if len(changed) > 1:
        return group
    return f"{group}.{spoken(changed[0])}" if changed else f"{group}.loss-factor"


def _few(groups: list[str]) -> str:
    more = [f"{len(groups) - FEW} more"] if len(groups) > FEW else []
    return ", ".join([*groups[:FEW], *more])


def _of_locks(before: Design, after: Design) -> Iterator[str]:
    old, new = _locks(before), _locks(after)
    yield from (f"lock {name}" for name in sorted(new - old))
    yield from (f"unlock {name}" for name in sorted(old - new) if name.split(".")[0] in after.rates)
    yield from (f"keep ratios of {name}" for name in sorted(after.linked - before.linked))
    gone = (name for name in sorted(before.linked - after.linked) if name in after.rates)
    yield from (f"let ratios of {name} change" for name in gone)


def _either(before: Mapping[str, Any], after: Mapping[str, Any]) -> list[str]:
    return [*before, *(name for name in after if name not in before)]
