"""A measured road out of another program's file, in one step: what the command and the page do."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from modeviz.errors import ModevizError, located
from modeviz.formats.roads.crg import Surface, read_crg
from modeviz.formats.roads.into_folder import add_road, vehicle_of
from modeviz.formats.roads.tracks import TrackSpectra, track_spectra
from modeviz.vehicle.vehicle import Vehicle, track_width

SUFFIXES = (".crg",)

USUAL_TRACK_WIDTH = 1.6
"""m: of a road that goes into no vehicle."""


@dataclass(frozen=True, kw_only=True)
class RoadSettings:
    """How a road is read."""

    name: str | None = None
    """Of the road; None: that of the file."""
    track_width: float | None = None
    """m; None: that of the vehicle."""


@dataclass(frozen=True, eq=False)
class ImportedRoad:
    """A road, and what it was made of."""

    name: str
    surface: Surface
    spectra: TrackSpectra
    vehicle: Vehicle | None
    """Of the folder that it was put into."""


def holds_road(files: Sequence[Path]) -> bool:
    """Return whether what is to be imported is a road."""
    return all(path.suffix.lower() in SUFFIXES for path in files)


def import_road(
    path: Path, folder: Path | None, settings: RoadSettings, note: Callable[[str], None]
) -> ImportedRoad:
    """Return the road of a file, put into a vehicle folder if there is one.

    Args:
        path: of a surface.
        folder: of a vehicle that has its bodies.
        settings: how it is read.
        note: told what is taken otherwise than it stands, a sentence at a time.

    Raises:
        ModevizError: it is no road, or the vehicle has no track width or something of that name.
    """
    vehicle = vehicle_of(folder) if folder else None
    width = _track_width(settings.track_width, vehicle)
    surface = read_crg(path)
    with located(path.name):
        spectra = track_spectra(surface, width, note)
    name = settings.name or path.stem
    after = add_road(spectra, name, folder, vehicle, path.name) if folder and vehicle else None
    return ImportedRoad(name, surface, spectra, after)


def _track_width(given: float | None, vehicle: Vehicle | None) -> float:
    """The one that is given, or else that of a vehicle's tyres, or the usual one, m.

    Raises:
        ModevizError: it is none, or there are no tyres on both sides.
    """
    if given is not None:
        if not 0 < given < 100:
            raise ModevizError(f"--track-width: found {given:g} m, expected more than 0, below 100")
        return given
    if vehicle is None:
        return USUAL_TRACK_WIDTH
    width = track_width(vehicle.tyres)
    if not 0 < width < 100:
        raise ModevizError(
            "the vehicle has no tyres on both sides, which say how far the tracks of a road are apart; "
            "give it [[tyre]] tables first, or say it with --track-width"
        )
    return width
