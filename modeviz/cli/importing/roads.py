"""Measured roads put into a vehicle folder."""

import math
from collections.abc import Sequence
from pathlib import Path

from modeviz.cli.news import News
from modeviz.cli.results import print_result
from modeviz.cli.terminal import remark
from modeviz.errors import ModevizError
from modeviz.formats.roads.crg import Surface
from modeviz.formats.roads.imported import RoadSettings, import_road
from modeviz.formats.roads.tracks import TrackSpectra
from modeviz.vehicle.doubts import road_doubts
from modeviz.vehicle.iso_8608 import CLASSES


def import_road_file(files: Sequence[Path], output: Path | None, settings: RoadSettings) -> None:
    """Says what a road is like, and puts it into a vehicle folder if there is one.

    Raises:
        ModevizError: there are several files, or it is no road, or the vehicle has no track width.
    """
    path, *others = files
    if others:
        raise ModevizError(f"found {len(files)} roads, expected one at a time")
    news = News(output, road_doubts)
    road = import_road(path, output, settings, lambda text: remark(f"{path.name}: {text}"))
    print_result(summary(path, road.surface, road.spectra))
    if road.vehicle:
        news.tell(road.vehicle)
        print_result(f"{output}: road {road.name!r}")


def summary(path: Path, surface: Surface, spectra: TrackSpectra) -> str:
    """Return what an engineer can compare with what they know of a road."""
    n = spectra.spatial_frequency
    level, waviness = spectra.fit()
    left, right = (1000 * rms for rms in spectra.rms)
    near = min(CLASSES, key=lambda name: abs(math.log(CLASSES[name] / max(level, 1e-12))))
    return "\n".join(
        [
            f"{path.name}: {surface.length:.5g} m long every {surface.increment:.4g} m, "
            f"{surface.v[0]:.4g} to {surface.v[-1]:.4g} m across in {len(surface.v)} sections",
            f"tracks {spectra.width:.4g} m apart over {spectra.length:.5g} m: RMS {left:.4g} mm left, "
            f"{right:.4g} mm right",
            f"spectra from {n[0]:.3g} to {n[-1]:.4g} cycles/m; G_d(0.1 cycles/m) {1e6 * level:.4g} "
            f"cm³, waviness {waviness:.3g}, as ISO {near}",
        ]
    )
