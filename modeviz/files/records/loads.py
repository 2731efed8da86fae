"""The tables of `vehicle.toml` that say what shakes the vehicle, in SI."""

from dataclasses import replace
from typing import ClassVar, Self

import numpy as np

from modeviz.errors import VehicleError, at_key
from modeviz.files.records.fields import (
    Acceleration,
    AccelerationPsd,
    Direction,
    Displacement,
    DisplacementPsd,
    ForceAmplitude,
    ForcePsd,
    Name,
    Position,
    Ratio,
    RoadLevel,
    Speed,
    TrackWidth,
    WheelLoadAmplitude,
)
from modeviz.files.records.record import Record, vector_along
from modeviz.files.roads import read_road
from modeviz.files.schema.quantities import Vector, quantity_of
from modeviz.files.source import Source
from modeviz.files.spectra import read_spectrum
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.iso_8608 import CLASSES, RoadClass, rough_road
from modeviz.vehicle.loads import (
    BaseMotion,
    Force,
    Road,
    Roughness,
    Spectrum,
    WheelLoad,
    WheelLoadKind,
)


class RoadRecord(Record, kw_only=True):
    """[[road]]: with a file it is a table's, else of a class or a level of ISO 8608."""

    depending: ClassVar[frozenset[str]] = frozenset(("file", "iso_8608", "roughness"))

    name: Name
    label: str = ""
    """The name, if not given."""
    file: str | None = None
    """A file of the folder, .csv."""
    speed: Speed | None = None
    """At which the table was met."""
    iso_8608: RoadClass | None = None
    roughness: RoadLevel | None = None
    """G_d(n₀)."""
    waviness: Ratio | None = None
    """2, if not given."""
    track_width: TrackWidth | None = None
    """The vehicle's, if not given."""

    @classmethod
    def of(cls, road: Road, file: str) -> Self:
        if road.roughness is None:
            return cls(name=road.name, label=road.label, file=file, speed=road.speed)
        level, waviness = road.roughness.level, road.roughness.waviness
        known: RoadClass | None = next((k for k, mean in CLASSES.items() if mean == level), None)
        return cls(
            name=road.name,
            label=road.label,
            iso_8608=known,
            roughness=None if known else level,
            waviness=waviness,
            track_width=road.roughness.track_width,
        )

    def build(self, source: Source, track_width: float) -> Road:
        """The road under a vehicle of that track width, m."""
        given = _the_one({key: getattr(self, key) for key in ("file", "iso_8608", "roughness")})
        self._check_keys(given)
        return (
            self._of_file(source, track_width)
            if given == "file"
            else self._of_surface(source, track_width)
        )

    def _check_keys(self, given: str) -> None:
        """Raises VehicleError for a key that does nothing beside the one that is given."""
        idle = ("waviness",) if given == "file" else ("speed",)
        for key in idle:
            if getattr(self, key) is not None:
                raise VehicleError(f"{key}: does nothing beside {given}, leave it out")

    def _of_surface(self, source: Source, track_width: float) -> Road:
        level = self.roughness if self.iso_8608 is None else CLASSES[self.iso_8608]
        assert level is not None
        waviness = 2.0 if self.waviness is None else self.waviness
        roughness = Roughness(level, waviness, self._width(track_width))
        road = rough_road(self.name, self.label or self.name, roughness)
        source.count_lines(len(road.frequency_hz))
        return road

    def _of_file(self, source: Source, track_width: float) -> Road:
        assert self.file is not None
        with at_key("file"):
            path = source.path(self.file)
            table = source.once(
                (path, "road"), lambda: read_road(path, source.conventions, source.note)
            )
        if self.track_width is not None and table.cross is not None:
            raise VehicleError("track_width: does nothing beside a cross spectrum, leave it out")
        width, label = self._width(track_width), self.label or self.name
        road = source.once(
            (path, "road", self.speed, width),
            lambda: table.road(self.name, label, self.speed, width, source.note),
        )
        if not source.count_lines(len(road.frequency_hz)):
            return road  # no copy of what is refused once all are counted
        return replace(road, name=self.name, label=label)

    def _width(self, track_width: float) -> float:
        """Its own track width, or else the vehicle's."""
        return track_width if self.track_width is None else self.track_width


class WheelLoadRecord(Record, kw_only=True):
    """[[wheel_load]]."""

    name: Name
    kind: WheelLoadKind
    tyre: str
    amplitude: WheelLoadAmplitude

    @classmethod
    def of(cls, load: WheelLoad) -> Self:
        return cls(name=load.name, kind=load.kind, tyre=load.tyre, amplitude=load.amplitude)

    def build(self) -> WheelLoad:
        return WheelLoad(self.name, self.kind, self.tyre, self.amplitude)


class ForceRecord(Record, kw_only=True):
    """[[force]]: with an amplitude it is harmonic, with a PSD random."""

    depending: ClassVar[frozenset[str]] = frozenset(("amplitude", "psd"))

    name: Name
    body: str
    at: Position
    direction: Direction
    amplitude: ForceAmplitude | None = None
    psd: ForcePsd | None = None

    @classmethod
    def of(cls, force: Force, file: str) -> Self:
        peak = None if isinstance(force.amplitude, Spectrum) else force.amplitude
        return cls(
            name=force.name,
            body=force.body,
            at=_vector(force.position),
            direction=_vector(force.direction),
            amplitude=peak,
            psd=file if peak is None else None,
        )

    def build(self, source: Source) -> Force:
        key = _the_one({"amplitude": self.amplitude, "psd": self.psd})
        amplitude = _amplitude(source, self, key)
        position, direction = np.array(self.at), vector_along(self.direction)
        return Force(self.name, self.body, position, direction, amplitude)


class BaseMotionRecord(Record, kw_only=True):
    """[[base_motion]]: with an amplitude it is harmonic, with a PSD random."""

    depending: ClassVar[frozenset[str]] = frozenset(
        ("displacement", "acceleration", "displacement_psd", "acceleration_psd")
    )

    name: Name
    connections: tuple[str, ...] = ()
    """Whose ground ends move, all alike; none: every connection to the ground."""
    direction: Direction
    displacement: Displacement | None = None
    acceleration: Acceleration | None = None
    displacement_psd: DisplacementPsd | None = None
    acceleration_psd: AccelerationPsd | None = None

    @classmethod
    def of(cls, motion: BaseMotion, file: str) -> Self:
        peak = None if isinstance(motion.amplitude, Spectrum) else motion.amplitude
        moves = motion.quantity == "displacement"
        return cls(
            name=motion.name,
            connections=motion.connections,
            direction=_vector(motion.direction),
            displacement=peak if moves else None,
            acceleration=None if moves else peak,
            displacement_psd=file if moves and peak is None else None,
            acceleration_psd=file if not moves and peak is None else None,
        )

    def build(self, source: Source) -> BaseMotion:
        keys = ("displacement", "acceleration", "displacement_psd", "acceleration_psd")
        key = _the_one({key: getattr(self, key) for key in keys})
        quantity = "displacement" if quantity_of(type(self), key) == "length" else "acceleration"
        amplitude = _amplitude(source, self, key)
        direction = vector_along(self.direction)
        return BaseMotion(self.name, direction, quantity, amplitude, self.connections)


def _the_one(amplitudes: dict[str, float | str | None]) -> str:
    """The key of the one amplitude that is given.

    Raises:
        VehicleError: there is none, or more than one.
    """
    given = [key for key, value in amplitudes.items() if value is not None]
    if len(given) != 1:
        found = " and ".join(given) or "none"
        raise VehicleError(f"found {found}, expected one of {', '.join(amplitudes)}")
    return given[0]


def _amplitude(source: Source, record: Record, key: str) -> float | Spectrum:
    """A peak as it is, the spectrum in a file that is named."""
    given = getattr(record, key)
    if not isinstance(given, str):
        return given
    quantity = quantity_of(type(record), key)
    assert quantity is not None
    with at_key(key):
        path = source.path(given)
        spectrum = source.once(
            (path, quantity), lambda: read_spectrum(path, quantity, source.conventions, source.note)
        )
    source.count_lines(len(spectrum.frequency_hz))
    return spectrum


def _vector(values: Floats) -> Vector:
    x, y, z = values.tolist()
    return x, y, z
