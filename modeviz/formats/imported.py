"""A component out of another program's files as a body, in one step: what the command and Python do."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from modeviz.errors import VehicleError, located
from modeviz.files.folder import VEHICLE_FILE
from modeviz.files.meshes import read_mesh
from modeviz.files.records.vehicle import VehicleRecord
from modeviz.files.schema.axes import axes_of
from modeviz.files.toml_reader import read_toml
from modeviz.formats.attachments import Found, far_notes, find_attachments
from modeviz.formats.body import chosen_units, flexible_body, uncoupled_because
from modeviz.formats.component import Component, UnitSystem
from modeviz.formats.halves import Whole, join_halves, parse_plane
from modeviz.formats.into_folder import add_body
from modeviz.formats.places import parse_place
from modeviz.formats.poses import misfit_notes, parse_pose
from modeviz.formats.reading import read_component
from modeviz.formats.residuals import with_given_compliance
from modeviz.formats.solving import Condensation, Wanted, solved
from modeviz.formats.surface import COLOR
from modeviz.units import factor
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import FlexibleBody, Mesh
from modeviz.vehicle.pose import Pose
from modeviz.vehicle.vehicle import Vehicle

USUAL_PLANE = "y=0"

LEFT = np.array([0.0, -1.0, 0.0])
"""In our axes."""

ASSUMED_SIDES = (
    "left is where y is below zero, since no axes are said (x rearward, y right, z up are taken); "
    "where the component's are others, say so with --pose, such as 'x forward, y left, z up'"
)


@dataclass(frozen=True, kw_only=True)
class ImportSettings:
    """How a component becomes a body; texts are as the command has them."""

    units: str | None = None
    """One of `UNIT_SYSTEMS`; None: as the files say."""
    attach: tuple[str, ...] = ()
    """Places, as `parse_place` reads them."""
    residual: tuple[str, ...] = ()
    """What the modes leave out, as `with_given_compliance` reads it."""
    pose: str | Pose | None = None
    """Where it stands in the vehicle, as `parse_pose` reads it; None: as its coordinates say."""
    antisymmetric: tuple[Path, ...] = ()
    """Of a half model's antisymmetric run; the component is then that of the symmetric one."""
    plane: str | None = None
    """Where the half is cut; None: `USUAL_PLANE`."""
    mesh: Path | None = None
    """Of its looks, in the coordinates of the component; None: the faces of its elements."""
    mesh_unit: str | None = None
    """Of that; None: as the mesh says, else as the component."""
    wanted: Wanted = field(default_factory=Wanted)
    """The modes of matrices."""
    replaces: bool = False
    """Whether the body of that name in the folder is replaced."""

    def __post_init__(self) -> None:
        if self.plane is not None and not self.antisymmetric:
            raise VehicleError(
                "--plane is of two halves: give the files of the other with --antisymmetric"
            )
        if self.mesh_unit is not None and self.mesh is None:
            raise VehicleError("--mesh-unit is of a mesh: give its file with --mesh")


@dataclass(frozen=True, eq=False)
class Imported:
    """A body, and what there is to know of how it was made."""

    body: FlexibleBody
    attachments: tuple[Found, ...]
    """Where they were found, in the component's coordinates."""
    notes: tuple[str, ...]
    vehicle: Vehicle | None = None
    """Of the folder that it was put into."""


def import_component(
    *files: Path | str,
    output: Path | str | None = None,
    name: str | None = None,
    units: str | None = None,
    attach: Sequence[str] = (),
    residual: Sequence[str] = (),
    pose: str | Pose | None = None,
    antisymmetric: Sequence[Path | str] = (),
    plane: str | None = None,
    mesh: Path | str | None = None,
    mesh_unit: str | None = None,
    n_modes: int | None = None,
    up_to_hz: float | None = None,
    condense: Condensation | None = None,
    replaces: bool = False,
) -> Imported:
    """Return a body made of another program's files, as `modeviz import` makes it.

    Args:
        files: of one component.
        output: the vehicle folder to put it into, new or there; if not given, it is not written.
        name: of the body; if not given, that of the first file.
        units: one of "m-kg-s", "mm-t-s", "mm-kg-mN", "in-lbf-s", "ft-lbf-s"; if not given, the files'.
        attach: where others hold on to it, such as "seat=12" or "seat=mean:12,13,14".
        residual: what its modes leave out there, such as "seat=0.001,0,0.002", or a CSV file.
        pose: where it stands in the vehicle.
        antisymmetric: files of a half model's antisymmetric run; `files` are of the symmetric one.
        plane: where the half is cut; if not given, at y=0.
        mesh: what it looks like, in its coordinates; if not given, the faces of its elements.
        mesh_unit: of the mesh, such as "mm"; if not given, as it says, else that of the files.
        n_modes: of matrices, how many to compute.
        up_to_hz: of matrices, up to which frequency instead.
        condense: of matrices, how to condense them first, "guyan" or "craig-bampton"; needs `up_to_hz`.
        replaces: whether the body of that name in the folder `output` gets new modes, mesh and
            attachments.

    Raises:
        VehicleError: the files cannot be read, or make no body that can be coupled to others, or
            something is given that has no effect on such files.
    """
    paths = [Path(file) for file in files]
    if not paths:
        raise VehicleError("found no file, expected those of a component")
    settings = ImportSettings(
        units=units,
        attach=tuple(attach),
        residual=tuple(residual),
        pose=pose,
        antisymmetric=tuple(map(Path, antisymmetric)),
        plane=plane,
        mesh=None if mesh is None else Path(mesh),
        mesh_unit=mesh_unit,
        wanted=Wanted(n_modes=n_modes, up_to_hz=up_to_hz, condensed=condense),
        replaces=replaces,
    )
    folder = None if output is None else Path(output)
    component = read_component(paths)
    imported = import_body(component, name or paths[0].stem, settings, folder)
    return replace(imported, notes=(*component.notes, *imported.notes))


def import_body(
    component: Component, name: str, settings: ImportSettings, folder: Path | None = None
) -> Imported:
    """Return a component that was read as a body, put into a vehicle folder if there is one.

    The notes are those beyond the component's own.

    Raises:
        VehicleError: it cannot be coupled to others, or the settings do not fit to it.
    """
    if settings.replaces and folder is None:
        raise VehicleError("--replace is of a body in a folder; say which with --output")
    units = _units(component, settings)
    axes = _axes_of(folder)
    pose = settings.pose
    if isinstance(pose, str):
        with located("--pose"):
            pose = parse_pose(pose, component, units.length, np.eye(3) if axes is None else axes)
    component, found, said = _attached(component, settings, units, pose, axes)
    n_notes = len(component.notes)
    component = solved(component, settings.wanted, found, units.length)
    said = (*said, *component.notes[n_notes:])
    body, notes = flexible_body(component, units, name, found)
    with located("--residual"):
        body = with_given_compliance(body, settings.residual, units)
    if settings.mesh:
        body = replace(body, mesh=_looks(settings.mesh, settings.mesh_unit, units))
    if pose is not None:
        body, said = pose.moved(body), (*misfit_notes(pose), *said)
    vehicle = add_body(body, folder, component.source, settings.replaces) if folder else None
    return Imported(body, found, (*said, *far_notes(found), *notes), vehicle)


def _units(component: Component, settings: ImportSettings) -> UnitSystem:
    """Those of a component; where they are not said, what else is in the way is said with that."""
    try:
        return chosen_units(component, settings.units)
    except VehicleError as error:
        is_whole = component.matrices is None and not settings.antisymmetric
        reason = uncoupled_because(component) if is_whole else None
        if not reason:
            raise
        raise VehicleError(f"{error}; and it cannot be coupled to others: {reason}") from None


def _attached(
    component: Component,
    settings: ImportSettings,
    units: UnitSystem,
    pose: Pose | None,
    axes: Floats | None,
) -> tuple[Component, tuple[Found, ...], tuple[str, ...]]:
    """The component, the whole if it is a half, its attachments, and what is to be said of that."""
    half, whole = component, _whole(component, settings) if settings.antisymmetric else None
    component = whole.component if whole else half
    with located("--attach"):
        found = find_attachments(component, [parse_place(text) for text in settings.attach], units)
    if whole is None:
        return component, found, ()
    turn = (np.eye(3) if axes is None else axes) @ (np.eye(3) if pose is None else pose.rotation)
    both = whole.attachments(found, turn.T @ LEFT, units.length)
    notes = [note for note in component.notes if note not in half.notes]
    if axes is None and pose is None and len(both) > len(found):
        notes.append(ASSUMED_SIDES)
    return component, both, tuple(notes)


def _looks(path: Path, unit: str | None, units: UnitSystem) -> Mesh:
    """The mesh of a file, m, as it stands in the component's coordinates, whatever is up in it."""
    with located("--mesh-unit"):
        length = factor(unit, "length") if unit is not None else None
    with located("--mesh"):
        return read_mesh(path, COLOR, length, np.eye(3), units.length)


def _whole(half: Component, settings: ImportSettings) -> Whole:
    """The structure of which a component is the symmetric half."""
    with located("--plane"):
        plane = parse_plane(settings.plane or USUAL_PLANE)
    with located("--antisymmetric"):
        return join_halves(half, read_component(settings.antisymmetric), plane)


def _axes_of(folder: Path | None) -> Floats | None:
    """What turns the axes of a vehicle folder's file into ours; None if there is none yet."""
    path = folder / VEHICLE_FILE if folder else None
    return axes_of(read_toml(path, VehicleRecord).axes) if path and path.is_file() else None
