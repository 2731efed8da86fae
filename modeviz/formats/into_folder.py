"""A body put into a vehicle folder, new or there, with words on what to fill in next."""

import shutil
from collections.abc import Iterator
from pathlib import Path

from modeviz.errors import VehicleError, located, quoted
from modeviz.files.disk import file_stems, read_text, replace_folder, write_text
from modeviz.files.folder import VEHICLE_FILE, read_vehicle
from modeviz.files.meshes import write_mesh
from modeviz.files.modal import write_flexible_body
from modeviz.files.toml_reader import tables_of
from modeviz.files.toml_writer import toml_value
from modeviz.formats.replaced_table import replaced_stem, with_table
from modeviz.units import WRITTEN_UNITS
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import FlexibleBody
from modeviz.vehicle.vehicle import Vehicle

TYRE_RADIUS = 0.3
"""m, of one to be filled in."""


def add_body(body: FlexibleBody, folder: Path, origin: str, replaces: bool = False) -> Vehicle:
    """Return the vehicle of a folder into which a body is put; it is made if it isn't there.

    What stands in its vehicle.toml stays to the letter; the body's table comes after it, or in the
    place of what it replaces.

    Args:
        body: in SI; its name is none of the vehicle's, unless it replaces that one.
        folder: of the vehicle.
        origin: of what it was made, to say so.
        replaces: whether the flexible body of its name gets its modes, mesh and attachments.

    Raises:
        VehicleError: the folder holds something else, has such a body, or none to replace, cannot be
            written, or would not be a vehicle; it is as it was then.
    """
    is_there = (folder / VEHICLE_FILE).is_file()
    if folder.exists() and not is_there and (not folder.is_dir() or any(folder.iterdir())):
        raise VehicleError(
            f"{folder}: is no vehicle folder, and not empty, so nothing is put into it; give a new one"
        )
    text = read_text(folder / VEHICLE_FILE) if is_there else "\n".join(_heading(folder.resolve().name))
    path = folder / VEHICLE_FILE
    if replaces:
        stem = replaced_stem(text, body.name, path)
        text = with_table(text, body.name, [*_table(body, stem, origin)], path)
    else:
        stem = _new_stem(text, body.name, path)
        table = [*_table(body, stem, origin), *([] if is_there else _next_steps(body))]
        text = text.rstrip() + "\n\n" + "\n".join(table) + "\n"
    vehicles = []

    def fill(new: Path) -> None:
        if is_there:
            shutil.copytree(folder, new, symlinks=True, dirs_exist_ok=True)
        write_text(new / VEHICLE_FILE, text)
        _write_arrays(body, new, stem, replaces)
        try:
            vehicles.append(read_vehicle(new))
        except VehicleError as error:
            raise VehicleError(str(error).replace(str(new), str(folder))) from None

    replace_folder(folder, fill)
    return vehicles[0]


def _new_stem(text: str, name: str, path: Path) -> str:
    """Of the files of a body that a vehicle's file does not have yet; raises VehicleError if it has."""
    with located(path):
        tables = tables_of(text)
    bodies = [*tables.get("flexible_body", []), *tables.get("rigid_body", [])]
    names = [str(body.get("name", "")) for body in bodies if isinstance(body, dict)]
    if name in names:
        raise VehicleError(
            f"{path.parent}: has a body {quoted(name)} already; put this one in its place with "
            "--replace, or give it another name with --name"
        )
    return file_stems([*names, name])[name]


def _write_arrays(body: FlexibleBody, folder: Path, stem: str, replaces: bool) -> None:
    for name in ("bodies", "meshes"):
        (folder / name).mkdir(exist_ok=True)
    for path in (folder / _modes_file(stem), folder / _mesh_file(stem)):
        if replaces:
            path.unlink(missing_ok=True)
        elif path.exists():
            raise VehicleError(f"{path.name}: is in the folder already; give the body another name")
    write_flexible_body(folder / _modes_file(stem), body)
    if body.mesh:
        write_mesh(folder / _mesh_file(stem), body.mesh)


def _modes_file(stem: str) -> str:
    return f"bodies/{stem}.npz"


def _mesh_file(stem: str) -> str:
    return f"meshes/{stem}.glb"


def _heading(name: str) -> Iterator[str]:
    yield f"name = {toml_value(name or 'vehicle')}"
    yield '#axes = "x forward, y left, z up"  # if its places are so; else x rearward, y right, z up'
    yield ""
    yield "[units]  # of the numbers in this file"
    yield from (f"{quantity} = {toml_value(unit)}" for quantity, unit in WRITTEN_UNITS.items())


def _table(body: FlexibleBody, stem: str, origin: str) -> Iterator[str]:
    """The lines of a body's table."""
    ratio = body.damping_ratio
    assumed = "" if isinstance(ratio, tuple) else "  # of critical, assumed: the file says none"
    ratios = list(ratio) if isinstance(ratio, tuple) else ratio
    yield f"# {len(body.omega_n_squared)} modes from {' '.join(origin.split())}"
    yield "[[flexible_body]]"
    yield f"name = {toml_value(body.name)}"
    yield f"role = {toml_value(body.role)}  # or cabin, frame, bed, powertrain, unsprung, linkage"
    yield f"modes = {toml_value(_modes_file(stem))}"
    if body.mesh:
        yield f"mesh = {toml_value(_mesh_file(stem))}"
    yield 'units = { length = "m", mass = "kg" }  # of the modes'
    yield f"damping_ratio = {toml_value(ratios)}{assumed}"
    yield f"#mass = {body.mass:.6g}  # what it weighs, if you know; its modes say so much"
    for attachment in body.attachments:
        x, y, z = attachment.position
        yield f"# attachment {toml_value(attachment.name)} at [{x:.6g}, {y:.6g}, {z:.6g}]"


def _place(place: Floats) -> str:
    return f"[{', '.join(f'{value:.6g}' for value in place)}]"


def _next_steps(body: FlexibleBody) -> Iterator[str]:
    """Comments with tables that can follow, of which each reads as it stands without its "#"."""
    first = [a.position for a in body.attachments][:1] or [body.nodes[0]]
    place, road = (_place(p) for p in (first[0], first[0] - [0.0, 0.0, TYRE_RADIUS]))
    name = toml_value(body.name)
    yield ""
    yield '# What to fill in next: take away the "#" before a line, and put your own numbers in.'
    if not body.attachments:
        yield "# This body has no attachment, so nothing holds on to it yet: import it with --attach."
    yield "# All tables and keys: docs/vehicle-folder.md."
    yield "#"
    yield "# Rubber mounts of one kind, which are tuned together:"
    yield "#[[mount_group]]"
    yield '#name = "M1"'
    yield "#rates = { vertical = 200.0, lateral = 100.0, fore_aft = 100.0 }"
    yield "#loss_factor = 0.1"
    yield "#[[mount_group.mount]]"
    yield '#name = "M1 left"'
    yield f'#bodies = [{name}, "ground"]  # the second may be another body'
    yield f"#at = {place}  # within 0.1 m of an attachment"
    yield "#"
    yield "# A spring that is not tuned, a damper, a bolt: [[spring]], [[damper]], [[bolt]]"
    yield "#[[spring]]"
    yield '#name = "spring 1"'
    yield f'#bodies = [{name}, "ground"]'
    yield f"#at = {place}"
    yield "#stiffness = [50.0, 50.0, 50.0]  # along x, y, z"
    yield "#"
    yield "# What moves as one piece:"
    yield "#[[rigid_body]]"
    yield '#name = "engine"'
    yield "#mass = 150.0"
    yield f"#center_of_gravity = {place}"
    yield "#inertia = [8.0, 10.0, 9.0]  # about the centre of gravity"
    yield "#"
    yield "# What lets roads in, a tyre at each wheel, which may be a body of its own:"
    yield "#[[tyre]]"
    yield '#name = "tyre 1"'
    yield f'#bodies = [{name}, "ground"]'
    yield f"#at = [{place}, {road}]  # the wheel, within 0.1 m of an attachment; the road beneath it"
    yield f"#wheel_center = {place}"
    yield "#stiffness = [0.0, 150.0, 250.0]  # along x, y, z"
    yield '#track = "left"  # of the road'
    yield "#"
    yield "# Where its motion is felt, the driver first; then [[road]], [[wheel_load]]:"
    yield "#[[response_point]]"
    yield '#name = "seat"'
    yield f"#body = {name}"
    yield f"#at = {place}"
