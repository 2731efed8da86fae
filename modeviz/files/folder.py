"""The vehicle folder: `vehicle.toml`, and beside it the bodies' modes and meshes and the roads.

FOLDER/vehicle.toml says everything but arrays, in the units that its `units` table declares; the keys
are the fields of the records in `records`. FOLDER/bodies/NAME.npz has the modes of a
flexible body, FOLDER/meshes/NAME.glb a display mesh, FOLDER/roads/NAME.csv a road's spectra,
FOLDER/spectra/NAME.csv that of a force or a motion of the ground, FOLDER/rates/NAME.csv a mount's rates
over frequency; all in SI.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, get_args

import msgspec

from modeviz.errors import ModevizError, VehicleError, at_key, located
from modeviz.files.disk import file_stems, read_text, replace_folder, write_text
from modeviz.files.engine_tables import write_orders
from modeviz.files.meshes import write_mesh
from modeviz.files.modal import write_flexible_body
from modeviz.files.own_tables import with_tables
from modeviz.files.rate_tables import write_rate_table
from modeviz.files.records.absorbers import AbsorberRecord
from modeviz.files.records.bodies import AddedMassRecord, FlexibleBodyRecord, RigidBodyRecord
from modeviz.files.records.connections import (
    ConnectionRecord,
    JointRecord,
    MountGroupRecord,
    RodRecord,
    TyreRecord,
)
from modeviz.files.records.decoupling import DecouplingRecord
from modeviz.files.records.engines import EngineRecord
from modeviz.files.records.load_cases import LoadCaseRecord
from modeviz.files.records.loads import (
    BaseMotionRecord,
    ForceRecord,
    RoadRecord,
    WheelLoadRecord,
)
from modeviz.files.records.problems import ProblemRecord
from modeviz.files.records.rates import RateSetRecord
from modeviz.files.records.tuned_parts import DamperGroupRecord, SpringGroupRecord
from modeviz.files.records.vehicle import (
    ModeDampingRecord,
    ResponsePointRecord,
    VehicleRecord,
)
from modeviz.files.roads import write_road
from modeviz.files.schema.axes import axes_of, turned
from modeviz.files.schema.conventions import Conventions
from modeviz.files.source import Source
from modeviz.files.spectra import write_spectrum
from modeviz.files.toml_reader import in_si, tables_of
from modeviz.files.toml_writer import to_toml
from modeviz.files.workload import check_workload
from modeviz.units import WRITTEN_UNITS
from modeviz.vehicle.absorber_parts import absorbers_of
from modeviz.vehicle.bodies import Body, FlexibleBody, RigidBody
from modeviz.vehicle.connections import Bolt, Connection, Damper, Rod, Spring
from modeviz.vehicle.doubts import doubts
from modeviz.vehicle.dynamic_rates import RateTable
from modeviz.vehicle.engine import Engine
from modeviz.vehicle.loads import Road, Spectrum
from modeviz.vehicle.mesh_doubts import mesh_doubts
from modeviz.vehicle.mount_group import MountGroup, PartKind
from modeviz.vehicle.orientation import orientation_doubts
from modeviz.vehicle.place_doubts import place_doubts
from modeviz.vehicle.rate_doubts import rate_doubts
from modeviz.vehicle.size_doubts import size_doubts
from modeviz.vehicle.vehicle import Vehicle

VEHICLE_FILE = "vehicle.toml"
CONTENT = {VEHICLE_FILE, "bodies", "meshes", "roads", "spectra", "rates", "engines"}
"""What a vehicle folder holds."""


def builtin_vehicle() -> Path:
    """The folder of the truck that comes with modeviz, installed or in a checkout.

    Raises:
        VehicleError: it is in neither place.
    """
    package = Path(__file__).parents[1]
    for home in (package, package.parent):
        if (home / "assets" / "truck" / VEHICLE_FILE).is_file():
            return home / "assets" / "truck"
    raise VehicleError(
        f"the built-in truck is not at {package}/assets/truck: install modeviz again, or run "
        "assets/build_truck.py in a checkout"
    )


def read_vehicle(folder: Path | str) -> Vehicle:
    """The vehicle in a folder: flexible bodies first, connections as in `CONNECTION_KINDS`.

    Raises:
        VehicleError: something is missing, damaged or wrong; the text names file, key, what was found
            and what would be right.
    """
    folder = Path(folder)
    text = read_vehicle_text(folder)
    with located(folder / VEHICLE_FILE):
        vehicle = vehicle_of(tables_of(text), Source(folder))
        check_workload(vehicle)
        return vehicle


def check_is_folder(path: Path) -> None:
    """Checks that there is a folder; raises VehicleError, with what to do with a file that is there."""
    if path.is_file():
        use = "modeviz view looks at files of other programs, modeviz import puts them into a folder"
        own = f"give its folder, {path.parent}" if path.name == VEHICLE_FILE else use
        raise VehicleError(f"{path}: is a file, expected the folder of a vehicle; {own}")
    if not path.exists():
        raise VehicleError(f"{path}: there is no such folder")


def read_vehicle_text(folder: Path) -> str:
    """The vehicle file in a folder.

    Raises:
        VehicleError: it is missing, or no text.
    """
    check_is_folder(folder)
    if not (folder / VEHICLE_FILE).is_file():
        raise VehicleError(
            f"{folder}: found no {VEHICLE_FILE}; a vehicle is a folder with a {VEHICLE_FILE}, and the "
            "modes, meshes and roads that it names"
        )
    return read_text(folder / VEHICLE_FILE)


def vehicle_of(tables: Mapping[str, Any], source: Source) -> Vehicle:
    """The vehicle that the tables of a file say, with notes on what is likely wrong with it.

    Args:
        tables: as they stand in the file.
        source: the folder that it is in.

    Raises:
        FaultsError: something is wrong at keys of the file or in a file that they name.
        PartError: a part of the vehicle does not fit the others.
        VehicleError: it is too large, or has no bodies.
    """
    record = in_si(tables, VehicleRecord)
    with at_key("axes"):
        axes = axes_of(record.axes)
    whole = with_tables(record, source, axes)
    ours = turned(msgspec.to_builtins(whole.record), VehicleRecord, axes)
    own = replace(source, conventions=Conventions(record.units, axes))
    try:
        vehicle = msgspec.convert(ours, VehicleRecord).build(own)
    except ModevizError as error:
        raise whole.located(error) from None
    if not own.stand_ins:
        of_bodies = (
            *doubts(vehicle),
            *size_doubts(vehicle),
            *place_doubts(vehicle),
            *rate_doubts(vehicle),
            *mesh_doubts(vehicle),
        )
        for doubt in (*of_bodies, *orientation_doubts(vehicle, axes)):
            own.note(doubt)
    file = str(own.folder / VEHICLE_FILE)
    return replace(vehicle, notes=(*vehicle.remarks, *own.notes), file=file, axes=record.axes)


def write_vehicle(vehicle: Vehicle, folder: Path | str) -> None:
    """Writes the vehicle as a folder, in place of a vehicle that is there.

    The same numbers give the same bytes on any machine.

    Raises:
        VehicleError: the folder holds something else, or cannot be written.
    """
    folder = Path(folder)
    check_vehicle_folder(folder)
    replace_folder(folder, lambda new: _write_content(vehicle, new))


def check_vehicle_folder(folder: Path) -> None:
    """Raises VehicleError unless a vehicle may be written there, before the work for it begins."""
    if folder.exists() and not _replaceable(folder):
        raise VehicleError(
            f"{folder}: is not a vehicle folder and nothing else, so it is not overwritten; "
            "give a new or empty folder"
        )


def _replaceable(folder: Path) -> bool:
    if not folder.is_dir():
        return False
    names = {path.name for path in folder.iterdir()}
    return not names or ((folder / VEHICLE_FILE).is_file() and names <= CONTENT)


def _write_content(vehicle: Vehicle, folder: Path) -> None:
    for name in ("bodies", "meshes", "roads"):
        (folder / name).mkdir()
    write_text(folder / VEHICLE_FILE, to_toml(_record(vehicle, folder)))


def _record(vehicle: Vehicle, folder: Path) -> VehicleRecord:
    """The content of the vehicle's file, with the files it names written."""
    absorbers = absorbers_of(vehicle)
    masses = {absorber.body_name for absorber in absorbers}
    guides = {absorber.guide_name for absorber in absorbers}
    its_groups = {absorber.name for absorber in absorbers}
    bodies = [body for body in vehicle.bodies if body.name not in masses]
    connections = [c for c in vehicle.connections if c.name not in guides]
    mount_groups = tuple(g for g in vehicle.mount_groups if g.name not in its_groups)
    of_kind = {kind: [g for g in mount_groups if g.kind == kind] for kind in get_args(PartKind)}
    tuned = {
        kind: [mount for group in groups for mount in group.mounts] for kind, groups in of_kind.items()
    }
    stems = file_stems(body.name for body in vehicle.bodies)
    spectra = _spectrum_files(vehicle, folder)
    flexible = [b for b in bodies if isinstance(b, FlexibleBody)]
    rigid = [b for b in bodies if isinstance(b, RigidBody)]
    return VehicleRecord(
        units=_units(vehicle),
        name=vehicle.name,
        speed=vehicle.speed,
        highest_frequency=vehicle.highest_frequency,
        frequency_step=vehicle.frequency_step,
        remarks=list(vehicle.remarks),
        flexible_body=[_record_of_flexible(b, stems[b.name], folder) for b in flexible],
        rigid_body=[RigidBodyRecord.of(b, _mesh_file(b, stems[b.name], folder)) for b in rigid],
        added_mass=[AddedMassRecord.of(m) for m in vehicle.added_masses],
        absorber=[AbsorberRecord.of(absorber) for absorber in absorbers],
        mount_group=_group_records(of_kind["mount"], folder),
        spring=[JointRecord.of(c) for c in (*_of_type(connections, Spring), *tuned["spring"])],
        rod=[RodRecord.of(c) for c in connections if isinstance(c, Rod)],
        bolt=[JointRecord.of(c) for c in _of_type(connections, Bolt)],
        damper=[ConnectionRecord.of(c) for c in (*_of_type(connections, Damper), *tuned["damper"])],
        spring_group=[SpringGroupRecord.of(group) for group in of_kind["spring"]],
        damper_group=[DamperGroupRecord.of(group) for group in of_kind["damper"]],
        tyre=[TyreRecord.of(c) for c in vehicle.tyres],
        response_point=[ResponsePointRecord.of(p) for p in vehicle.response_points],
        road=_road_records(vehicle.roads, folder),
        wheel_load=[WheelLoadRecord.of(load) for load in vehicle.wheel_loads],
        force=[ForceRecord.of(f, spectra.get(f.name, "")) for f in vehicle.forces],
        base_motion=[BaseMotionRecord.of(m, spectra.get(m.name, "")) for m in vehicle.base_motions],
        rates={
            name: {
                group: RateSetRecord.of(r, vehicle.mount_group(group).fields)
                for group, r in rates.items()
            }
            for name, rates in vehicle.rate_sets.items()
        },
        mode_damping=[ModeDampingRecord.of(damping) for damping in vehicle.mode_damping],
        problem=[ProblemRecord.of(problem) for problem in vehicle.problems],
        decoupling=DecouplingRecord.of(vehicle.decoupling),
        engine=_engine_records(vehicle.engines, folder),
        load_case=[LoadCaseRecord.of(case) for case in vehicle.load_cases],
    )


def _units(vehicle: Vehicle) -> dict[str, str]:
    """The units of the vehicle's file, without those of roads and loads which it does not have."""
    rare = {
        # local axes are written as vectors
        "angle": any(group.angles for problem in vehicle.problems for group in problem.groups),
        "roughness": any(road.roughness for road in vehicle.roads),
        "torque": any(load.torque.any() for case in vehicle.load_cases for load in case.loads),
    }
    return {key: unit for key, unit in WRITTEN_UNITS.items() if rare.get(key, True)}


def _record_of_flexible(body: FlexibleBody, stem: str, folder: Path) -> FlexibleBodyRecord:
    modes = f"bodies/{stem}.npz"
    write_flexible_body(folder / modes, body)
    return FlexibleBodyRecord.of(body, modes, _mesh_file(body, stem, folder))


def _mesh_file(body: Body, stem: str, folder: Path) -> str | None:
    """The file of the body's mesh, now that it is written."""
    if not body.mesh:
        return None
    name = f"meshes/{stem}.glb"
    write_mesh(folder / name, body.mesh)
    return name


def _road_records(roads: tuple[Road, ...], folder: Path) -> list[RoadRecord]:
    stems = file_stems(road.name for road in roads)
    records = [RoadRecord.of(road, f"roads/{stems[road.name]}.csv") for road in roads]
    for road, record in zip(roads, records, strict=True):
        if record.file:
            write_road(folder / record.file, road)
    return records


def _of_type(connections: Iterable[Connection], kind: type[Connection]) -> list[Connection]:
    return [connection for connection in connections if type(connection) is kind]


def _group_records(groups: Sequence[MountGroup], folder: Path) -> list[MountGroupRecord]:
    """The records of mount groups, now that the tables of their rates over frequency are written."""
    stems = file_stems(group.name for group in groups)
    tables = {g.name: g.dynamic for g in groups if isinstance(g.dynamic, RateTable)}
    if tables:
        (folder / "rates").mkdir()
    files = {group.name: f"rates/{stems[group.name]}.csv" for group in groups}
    for name, rates in tables.items():
        write_rate_table(folder / files[name], rates)
    return [MountGroupRecord.of(group, files[group.name]) for group in groups]


def _engine_records(engines: tuple[Engine, ...], folder: Path) -> list[EngineRecord]:
    """The records of engines, now that the tables of their orders are written."""
    files = {n: f"engines/{stem}.csv" for n, stem in file_stems(e.name for e in engines).items()}
    if engines:
        (folder / "engines").mkdir()
    for engine in engines:
        orders = {o.order: (o.frequency_hz / o.order, o.loads) for o in engine.orders}
        write_orders(folder / files[engine.name], orders)
    return [EngineRecord.of(engine, files[engine.name]) for engine in engines]


def _spectrum_files(vehicle: Vehicle, folder: Path) -> dict[str, str]:
    """The files of the spectra of random loads, by the loads' names, now that they are written."""
    random = [
        (load.name, load.amplitude)
        for load in (*vehicle.forces, *vehicle.base_motions)
        if isinstance(load.amplitude, Spectrum)
    ]
    if random:
        (folder / "spectra").mkdir()
    files = {name: f"spectra/{stem}.csv" for name, stem in file_stems(n for n, _ in random).items()}
    for name, spectrum in random:
        write_spectrum(folder / files[name], spectrum)
    return files
