"""Studies of a small vehicle, and changes of its mount, as tests write them."""

from pathlib import Path

from modeviz.journal.changes import Change, Difference, Kind
from modeviz.journal.fingerprint import Fingerprint
from modeviz.journal.study_file import StudyFile
from modeviz.journal.tuning import Pinned, Tuning
from modeviz.vehicle.mount_rates import MountRates

VEHICLE = Fingerprint({"body cab": "1", "mount group C2": "1"})
KEY = StudyFile.session_id("the-key-of-one-session")


def opened(path: Path, vehicle: Fingerprint = VEHICLE, **more) -> StudyFile:
    return StudyFile.open(path, "Truck", vehicle, **more)


def pinned(lateral: float) -> Pinned:
    return Pinned({"C2": MountRates(300e3, lateral * 1e3, 200e3)})


def change(
    before: float, after: float, kind: Kind = "step", author: str = "Ada", **variants: float
) -> Change:
    """Of the lateral rate, N/mm."""
    now = pinned(before if kind in ("undo", "back") else after)
    return Change(
        kind,
        "Undo: set C2.lateral" if kind == "undo" else "Set C2.lateral",
        f"state {before:g}",
        f"state {after:g}",
        author,
        (Difference("C2.lateral", f"{before:g} N/mm", f"{after:g} N/mm"),),
        Tuning(now.rates, {}, {name: pinned(rate) for name, rate in variants.items()}),
    )
