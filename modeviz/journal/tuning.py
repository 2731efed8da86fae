"""What a session has decided, as far as a study file can tell it in words: rates, places, variants."""

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from typing import Any

from modeviz.vehicle.mount_rates import MountRates, Rates
from modeviz.vehicle.placement import Placement, Placements


@dataclass(frozen=True)
class Pinned:
    """A variant: rates that were given a name."""

    rates: Rates
    placements: Placements = field(default_factory=dict)
    """Where mounts were with these rates, of the groups that were placed otherwise."""


@dataclass(frozen=True)
class Tuning:
    """The present rates and the variants of a session."""

    rates: Rates = field(default_factory=dict)
    """Of every mount group."""
    placements: Placements = field(default_factory=dict)
    """Of the groups whose mounts are elsewhere than they were given."""
    variants: Mapping[str, Pinned] = field(default_factory=dict)
    """By name."""

    @property
    def present(self) -> Pinned:
        """Rates and places without the variants."""
        return Pinned(self.rates, self.placements)


def pinned_text(pinned: Pinned) -> str:
    """Return a variant as JSON, in SI."""
    record = {
        "rates": {group: asdict(rates) for group, rates in pinned.rates.items()},
        "placements": {group: asdict(place) for group, place in pinned.placements.items()},
    }
    return json.dumps(record, sort_keys=True, ensure_ascii=False)


def pinned_of(text: str) -> Pinned:
    """Return the variant that a JSON text is, see `pinned_text`."""
    return pinned_of_record(json.loads(text))


def pinned_of_record(record: Mapping[str, Any]) -> Pinned:
    """Return the variant of a record with "rates" and "placements", see `pinned_text`."""
    return Pinned(
        {group: MountRates(**rates) for group, rates in record["rates"].items()},
        {
            group: Placement(tuple(place["offset"]), tuple(place["angles"]))
            for group, place in record["placements"].items()
        },
    )
