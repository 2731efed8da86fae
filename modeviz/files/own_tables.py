"""The tables of bodies and mounts beside a vehicle file, as records that would say the same in it."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import msgspec

from modeviz.errors import Fault, FaultsError, ModevizError, PartError, at_key, located
from modeviz.files.body_tables.table import TableBody, names_in, read_body_table
from modeviz.files.mount_tables.bushing import Bushing
from modeviz.files.mount_tables.reading import Reading, named_directions
from modeviz.files.mount_tables.records import Joined, connection_tables
from modeviz.files.mount_tables.table import mount_names_in, read_mount_table
from modeviz.files.records.record import Record
from modeviz.files.records.vehicle import VehicleRecord
from modeviz.files.source import Source
from modeviz.vehicle.arrays import Floats

BODIES, MOUNTS = "body_table", "mount_table"
"""The keys of a vehicle file that name them."""

Lines = Mapping[str, Fault]
"""The key of the file and the line of a table from which something is, as a fault that it has."""


@dataclass(frozen=True, eq=False)
class WholeRecord:
    """A vehicle file with what stands in the tables beside it."""

    record: VehicleRecord
    lines: Lines
    """By the key that it has in `record`, and by kind and name."""

    def located(self, error: ModevizError) -> ModevizError:
        """Return an error about something of a table as one of its line."""
        if isinstance(error, FaultsError):
            return FaultsError(*map(self._of_line, error.faults))
        if isinstance(error, PartError) and (line := self.lines.get(f"{error.kind} {error.name}")):
            return FaultsError(replace(line, words=f"{line.words}: {error}"))
        return error

    def _of_line(self, fault: Fault) -> Fault:
        key = max((k for k in self.lines if fault.path.startswith(k)), key=len, default="")
        if not key:
            return fault
        column = fault.path[len(key) :].lstrip(".")
        where = f"{self.lines[key].words}, column {column}" if column else self.lines[key].words
        return Fault(self.lines[key].path, f"{where}: {fault.words}")


def with_tables(record: VehicleRecord, source: Source, axes: Floats) -> WholeRecord:
    """Return a vehicle file with the bodies and mounts of its tables after its own.

    Args:
        record: in SI and the file's axes.
        source: the folder that it is in.
        axes: (3, 3), what turns these into ours.

    Raises:
        FaultsError: tables are missing or wrong; the text names file, line and column.
    """
    faults: list[Fault] = []
    bodies: Sequence[TableBody] = ()
    bushings: Sequence[Bushing] = ()
    new: dict[str, list[Record]] = {}
    try:
        bodies = _bodies(record, source)
    except FaultsError as error:
        faults += error.faults
    try:
        bushings = _bushings(record, source, axes)
        new = dict(_connections(record, bushings, axes))
    except FaultsError as error:
        faults += error.faults
    if faults:
        raise FaultsError(*faults)
    new["rigid_body"] = [body.record for body in bodies]
    whole = {key: [*getattr(record, key), *records] for key, records in new.items()}
    lines = {**_lines_of_bodies(record, bodies), **_lines_of_mounts(record, bushings, new)}
    return WholeRecord(msgspec.structs.replace(record, **whole), lines)


def names_in_body_table(name: object, source: Source) -> tuple[str, ...]:
    """Return the names of the bodies in a file of the folder, of which all else may be wrong.

    Args:
        name: of the file, as far as it is one.
        source: the folder.
    """
    try:
        return names_in(source.path(name)) if isinstance(name, str) else ()
    except ModevizError:
        return ()


def names_in_mount_table(name: object, source: Source) -> tuple[str, ...]:
    """Return the names of mounts and groups in a file of the folder; as `names_in_body_table`."""
    try:
        return mount_names_in(source.path(name)) if isinstance(name, str) else ()
    except ModevizError:
        return ()


def _bodies(record: VehicleRecord, source: Source) -> Sequence[TableBody]:
    name = record.body_table
    if name is None:
        return ()
    with at_key(BODIES):
        path = source.path(name)
        return source.once((BODIES, path), lambda: read_body_table(path))


def _bushings(record: VehicleRecord, source: Source, axes: Floats) -> Sequence[Bushing]:
    name = record.mount_table
    if name is None:
        return ()
    own = (body.name for body in (*record.flexible_body, *record.rigid_body, *source.stand_ins))
    bodies = tuple(dict.fromkeys((*own, *names_in_body_table(record.body_table, source))))
    with at_key(MOUNTS):
        path = source.path(name)
        reading = Reading(named_directions(axes), source.note, bodies=bodies)
        return source.once((MOUNTS, path, bodies), lambda: read_mount_table(path, reading))


def _connections(
    record: VehicleRecord, bushings: Sequence[Bushing], axes: Floats
) -> Iterator[tuple[str, list[Record]]]:
    """The tables of a vehicle file that mounts become, by their key."""
    joined = {bushing.name: _joined(bushing) for bushing in bushings}
    with at_key(MOUNTS), located(record.mount_table):
        yield from connection_tables(bushings, joined, named_directions(axes))


def _joined(bushing: Bushing) -> Joined:
    first, second = bushing.ends
    assert first.place is not None
    assert second.place is not None
    return Joined((first.body, second.body), (first.place, second.place))


def _lines_of_bodies(record: VehicleRecord, bodies: Sequence[TableBody]) -> Lines:
    lines: dict[str, Fault] = {}
    for number, body in enumerate(bodies, len(record.rigid_body)):
        line = Fault(BODIES, f"{record.body_table}: {body.where}")
        lines[f"rigid_body[{number}]"] = lines[f"body {body.record.name}"] = line
    return lines


def _lines_of_mounts(
    record: VehicleRecord, bushings: Sequence[Bushing], new: Mapping[str, Sequence[Record]]
) -> Lines:
    of_mount = {b.name: Fault(MOUNTS, f"{record.mount_table}: {b.where}") for b in bushings}
    lines = {f"connection {name}": line for name, line in of_mount.items()}
    for group in {bushing.group for bushing in bushings if bushing.group}:
        first = next(bushing for bushing in bushings if bushing.group == group)
        lines[f"mount group {group}"] = of_mount[first.name]
    for key, records in new.items():
        for number, part in enumerate(records, len(getattr(record, key))):
            mounts = getattr(part, "mount", [part])
            for place, mount in enumerate(mounts):
                if mount.name in of_mount:
                    lines[f"{key}[{number}].mount[{place}]"] = of_mount[mount.name]
            if mounts[0].name in of_mount:
                lines[f"{key}[{number}]"] = of_mount[mounts[0].name]
    return lines
