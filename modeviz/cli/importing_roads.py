"""Measured roads put into a vehicle folder."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from modeviz.cli.results import print_result
from modeviz.cli.terminal import remark
from modeviz.errors import ModevizError, located
from modeviz.formats.roads.crg import Surface, read_crg
from modeviz.formats.roads.into_folder import add_road, vehicle_of
from modeviz.formats.roads.tracks import TrackSpectra, track_spectra
from modeviz.vehicle.iso_8608 import CLASSES
from modeviz.vehicle.vehicle import track_width

SUFFIXES = (".crg",)

USUAL_TRACK_WIDTH = 1.6
"""m: of a road that is only listed."""


@dataclass(frozen=True, kw_only=True)
class RoadOptions:
    """What is asked for of a road."""

    files: tuple[Path, ...]
    output: Path | None
    name: str | None
    """Of the road; None: that of the file."""
    track_width: float | None
    """m; None: that of the vehicle."""


def holds_road(files: Sequence[Path]) -> bool:
    """Whether what is to be imported is a road."""
    return all(path.suffix.lower() in SUFFIXES for path in files)


def import_road(options: RoadOptions) -> None:
    """Says what a road is like, and puts it into a vehicle folder if there is one.

    Raises:
        ModevizError: there are several files, or it is no road, or the vehicle has no track width.
    """
    path, *others = options.files
    if others:
        raise ModevizError(f"found {len(options.files)} roads, expected one at a time")
    vehicle = vehicle_of(options.output) if options.output else None
    width = options.track_width
    if width is None:
        width = track_width(vehicle.tyres) if vehicle else USUAL_TRACK_WIDTH
    if not 0 < width < 100:
        raise ModevizError(
            f"--track-width: found {width:g} m, expected more than 0, as tyres on both sides have it"
        )
    surface = read_crg(path)
    with located(path.name):
        spectra = track_spectra(surface, width, lambda text: remark(f"{path.name}: {text}"))
    print_result(summary(path, surface, spectra, width))
    if options.output and vehicle:
        name = options.name or path.stem
        after = add_road(spectra, name, options.output, vehicle, path.name)
        for note in after.notes:
            remark(note)
        print_result(f"{options.output}: road {name!r}")


def summary(path: Path, surface: Surface, spectra: TrackSpectra, width: float) -> str:
    """Return what an engineer can compare with what they know of a road."""
    n = spectra.spatial_frequency
    level, waviness = spectra.fit()
    left, right = (1000 * rms for rms in spectra.rms)
    near = min(CLASSES, key=lambda name: abs(math.log(CLASSES[name] / max(level, 1e-12))))
    return "\n".join(
        [
            f"{path.name}: {surface.length:.5g} m long every {surface.increment:.4g} m, "
            f"{surface.v[0]:.4g} to {surface.v[-1]:.4g} m across in {len(surface.v)} sections",
            f"tracks {width:.4g} m apart over {spectra.length:.5g} m: RMS {left:.4g} mm left, "
            f"{right:.4g} mm right",
            f"spectra from {n[0]:.3g} to {n[-1]:.4g} cycles/m; G_d(0.1 cycles/m) {1e6 * level:.4g} "
            f"cm³, waviness {waviness:.3g}, as ISO {near}",
        ]
    )
