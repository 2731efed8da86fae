"""The command that puts a component out of another program's files into a vehicle folder."""

from argparse import ArgumentParser
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import get_args

import numpy as np

from modeviz.cli.command import Command
from modeviz.cli.importing_mounts import import_mounts, list_springs_beside
from modeviz.cli.importing_roads import import_road_file
from modeviz.cli.news import News
from modeviz.cli.results import check_printable, print_result
from modeviz.cli.terminal import remark
from modeviz.errors import VehicleError, listed
from modeviz.formats.attachments import Found
from modeviz.formats.body import uncoupled_because
from modeviz.formats.component import UNIT_SYSTEMS, Component
from modeviz.formats.effect import check_only, is_asked
from modeviz.formats.endings import check_taken
from modeviz.formats.imported import USUAL_PLANE, ImportSettings, import_body
from modeviz.formats.mounts.imported import (
    MountSettings,
    holds_mounts,
    is_deck_with_springs,
    is_property,
)
from modeviz.formats.places import FORMS
from modeviz.formats.poses import FORMS as POSE_FORMS
from modeviz.formats.reading import read_component
from modeviz.formats.residuals import FORMS as RESIDUAL_FORMS
from modeviz.formats.roads.imported import RoadSettings, holds_road
from modeviz.formats.solving import USUAL_MODES, Condensation, Wanted, solved
from modeviz.report.tables import table
from modeviz.report.truncation import import_notes
from modeviz.units import factor
from modeviz.vehicle.bodies import FlexibleBody
from modeviz.vehicle.residual_estimate import estimate_residuals
from modeviz.vehicle.residuals import modal_compliance

UNKNOWN = "unknown"

ROUNDING = 1e-9
"""So small a part of the compliance of an attachment is none."""

OF_A_BODY = (
    "units",
    "name",
    "attach",
    "residual",
    "pose",
    "antisymmetric",
    "plane",
    "mesh",
    "mesh_unit",
    "replace",
)
"""What only a body that is written has."""

OF_SPRINGS = ("frequency", "bodies")
"""What only the springs of an input file have."""

OF_MATRICES = ("modes", "up_to", "condense")
"""What only a body of matrices has."""


@dataclass(frozen=True, kw_only=True)
class ImportOptions:
    """What `modeviz import` is asked for."""

    files: tuple[Path, ...]
    """Of one component."""
    output: Path | None = None
    """The vehicle folder to put it into; None: it is only listed."""
    units: str | None = None
    """One of `UNIT_SYSTEMS`; None: as the files say."""
    name: str | None = None
    """Of the body; None: that of the first file."""
    attach: tuple[str, ...] = ()
    """Places, as `parse_place` reads them."""
    residual: tuple[str, ...] = ()
    """What the modes leave out, as `with_given_compliance` reads it."""
    pose: str | None = None
    """Where it stands in the vehicle, as `parse_pose` reads it."""
    antisymmetric: tuple[Path, ...] = ()
    """The files of a half model's antisymmetric run."""
    plane: str | None = None
    """Where the half is cut; None: `USUAL_PLANE`."""
    mesh: Path | None = None
    """What it looks like."""
    mesh_unit: str | None = None
    """Of the mesh; None: as it says, else that of the files."""
    modes: int | None = None
    """How many to compute where the files have matrices; None: `USUAL_MODES`."""
    up_to: float | None = None
    """Hz, instead: all modes up to it."""
    condense: Condensation | None = None
    """How matrices are condensed first, as `Wanted` has it."""
    frequency: float | None = None
    """Hz, at which mounts have the rates that an input file has over frequency."""
    replace: bool = False
    """Whether it takes the place of the body of that name."""
    bodies: tuple[str, ...] = ()
    """Two, that the springs of an input file join; none: those where its grids are."""
    track_width: float | None = None
    """m, of a road; None: the vehicle's."""

    @property
    def road(self) -> RoadSettings:
        """What is asked for of a road; raises VehicleError for what has no effect on one."""
        self.check_only("a road", "name", "track_width")
        if self.name is not None and self.output is None:
            raise VehicleError("--name is of a road that is written; say where with --output")
        return RoadSettings(name=self.name, track_width=self.track_width)

    @property
    def mounts(self) -> MountSettings:
        """What is asked for of mounts; raises VehicleError for what has no effect on them."""
        if any(is_property(file) for file in self.files):
            self.check_only("a property file, which says its units")
        self.check_only("mounts", "units", "frequency", "bodies", "pose")
        return MountSettings(
            units=self.units, frequency=self.frequency, bodies=self.bodies, pose=self.pose
        )

    def check_only(self, what: str, *names: str) -> None:
        """Checks that nothing else is asked for than what these fields say; raises VehicleError."""
        check_only(vars(self), what, "files", "output", *names)

    def check_none(self, what: str, names: Sequence[str]) -> None:
        """Checks that nothing is asked for that only what is written has; raises VehicleError."""
        if given := [name for name in names if is_asked(vars(self)[name])]:
            option = given[0].replace("_", "-")
            raise VehicleError(f"--{option} is of {what} written; say where with --output")


def import_component(options: ImportOptions) -> None:
    """Lists what files have of a component, and puts it into a vehicle folder if there is one."""
    check_printable()
    check_taken(options.files)
    if holds_road(options.files):
        import_road_file(options.files, options.output, options.road)
        return
    if holds_mounts(options.files, is_put=options.output is not None):
        import_mounts(options.files, options.output, options.mounts)
        return
    _check_body(options)
    wanted = Wanted(n_modes=options.modes, up_to_hz=options.up_to, condensed=options.condense)
    component = read_component(options.files)
    for note in component.notes:
        remark(f"{component.source}: {note}")
    if options.output is None:
        print_result(listing(solved(component, wanted)))
        list_springs_beside(options.files)
        return
    settings = ImportSettings(
        units=options.units,
        attach=options.attach,
        residual=options.residual,
        pose=options.pose,
        antisymmetric=options.antisymmetric,
        plane=options.plane,
        mesh=options.mesh,
        mesh_unit=options.mesh_unit,
        wanted=wanted,
        replaces=options.replace,
    )
    news = News(options.output)
    imported = import_body(component, options.name or options.files[0].stem, settings, options.output)
    assert imported.vehicle
    for note in (*imported.notes, *import_notes(imported.body)):
        remark(note)
    news.tell(imported.vehicle, imported.body.name)
    print_result(summary(imported.body, imported.attachments, options.output))


def _check_body(options: ImportOptions) -> None:
    """Checks that all that is asked for has an effect on a body, or on a list of its modes."""
    if options.output is None:
        options.check_none("a body that is", OF_A_BODY)
        has_springs = (options.frequency is not None or options.bodies) and is_deck_with_springs(
            options.files
        )
        if has_springs:
            options.check_none("springs that are", OF_SPRINGS)
    options.check_only("a body", *OF_MATRICES, *OF_A_BODY)


def listing(component: Component) -> str:
    """Return the modes of a component as a table, and what it is made of."""
    counts = [
        f"{len(corners)} {kind}{'s' if len(corners) != 1 else ''}"
        for kind, corners in component.elements.items()
    ]
    known = component.units.name if component.units else UNKNOWN
    reason = uncoupled_because(component)
    lines = [
        f"{component.source}: {len(component.node_ids)} nodes, {', '.join(counts) or 'no elements'}; "
        f"units {known}",
        f"It cannot be coupled to others: {reason}." if reason else "It can be coupled to others.",
    ]
    if not component.n_modes:
        return "\n".join(lines)
    modes = component.modes
    first_residual = component.n_modes - modes.n_residuals
    rows = [
        [
            f"{number + 1}" if number < first_residual else f"{number + 1}, residual vector",
            f"{frequency:.5g}",
            _known(mass, "{:.5g}"),
            _known(100 * ratio, "{:.2f}"),
        ]
        for number, (frequency, mass, ratio) in enumerate(
            zip(modes.frequency_hz, modes.modal_mass, modes.damping_ratio, strict=True)
        )
    ]
    return "\n".join([*lines, "", table(["mode", "Hz", "modal mass", "damping %"], rows)])


def _known(value: float, form: str) -> str:
    return form.format(value) if np.isfinite(value) else UNKNOWN


def summary(body: FlexibleBody, attachments: tuple[Found, ...], folder: Path) -> str:
    """Return what an engineer can compare with what they know of a body that was written."""
    _, inertia = body.rigid_fit.mass_about_center_of_gravity
    elastic = body.natural_frequency_hz[body.n_rigid : body.n_normal][:5]
    n_elastic = body.n_normal - body.n_rigid
    residual = f", {body.n_residuals} residual vectors" if body.n_residuals else ""
    lines = [
        f"{folder}: body {body.name!r}, {body.n_rigid} rigid and {n_elastic} elastic modes{residual}",
        f"mass {body.mass:.5g} kg, centre of gravity {_places(body.center_of_gravity)} m, "
        f"moments of inertia {_listed(np.diag(inertia))} kg m²",
        f"first elastic modes {', '.join(f'{f:.4g}' for f in elastic) or 'none'} Hz",
    ]
    modal, missing = modal_compliance(body), estimate_residuals(body).compliance
    what = "its modes and residual vectors are" if body.n_residuals else "its modes are"
    for found, attachment, own, more in zip(attachments, body.attachments, modal, missing, strict=True):
        far = f", {1000 * found.distance:.3g} mm from where it was asked for" if found.distance else ""
        truer = f", and about {_stiffness(own + more)} with those left out" if more.any() else ""
        lines.append(
            f"attachment {found.name!r} at {_places(attachment.position)} m{far}; {what} "
            f"{_stiffness(own)} N/mm stiff there{truer}{_unmoved_words(own)}"
        )
    if not attachments:
        lines.append("no attachments, so nothing can hold on to it: import it with --attach")
    return "\n".join(lines)


def _stiffness(compliance: np.ndarray) -> str:
    """N/mm of what gives way so much, "rigid" where it does not."""
    values = [
        "rigid" if still else f"{1 / own / factor('N/mm', 'stiffness'):.4g}"
        for own, still in zip(compliance, _unmoved(compliance), strict=True)
    ]
    return f"[{', '.join(values)}]"


def _unmoved(compliance: np.ndarray) -> np.ndarray:
    """Along which directions no mode moves an attachment but by rounding."""
    return compliance <= ROUNDING * compliance.max()


def _unmoved_words(compliance: np.ndarray) -> str:
    along = [axis for axis, still in zip("xyz", _unmoved(compliance), strict=True) if still]
    return f"; no elastic mode moves it along {listed(along)}" if along else ""


def _places(metres: np.ndarray) -> str:
    """To a nanometre, so that rounding is no place."""
    return _listed(np.round(metres, 9) + 0.0)


def _listed(values: np.ndarray) -> str:
    return f"[{', '.join(f'{value:.4g}' for value in values)}]"


def _add_options(command: ArgumentParser) -> None:
    command.add_argument(
        "files",
        nargs="+",
        type=Path,
        metavar="FILE",
        help="of one body, whose geometry and modes may be in several; or a table of mounts, or a road",
    )
    command.add_argument(
        "--output", type=Path, metavar="FOLDER", help="vehicle folder to put it into, new or there"
    )
    command.add_argument(
        "--units",
        metavar="NAME",
        help=f"of the files, where they do not say: {', '.join(UNIT_SYSTEMS)}",
    )
    command.add_argument("--name", metavar="NAME", help="of the body (default: the first file's)")
    command.add_argument(
        "--replace",
        action="store_true",
        help="give the body of that name in the folder new modes, mesh and attachments; what stands in "
        "vehicle.toml else stays",
    )
    command.add_argument(
        "--attach",
        action="append",
        metavar="PLACE",
        help=f"where others hold on to it: {FORMS}; may be repeated",
    )
    command.add_argument("--pose", metavar="POSE", help=f"where it stands in the vehicle: {POSE_FORMS}")
    command.add_argument(
        "--antisymmetric",
        nargs="+",
        type=Path,
        metavar="FILE",
        help="of a half model's run with antisymmetric conditions at the plane in which it is cut; the "
        "other files are of the symmetric run, and both become the whole",
    )
    command.add_argument(
        "--plane",
        metavar="PLANE",
        help=f"in which a half model is cut, in the files' units (default: {USUAL_PLANE})",
    )
    command.add_argument(
        "--mesh",
        type=Path,
        metavar="FILE",
        help="what it looks like, in the files' coordinates (.stl, .obj, .ply, .glb, .dae, .step); its "
        "nodes move that (default: the faces of its elements)",
    )
    command.add_argument(
        "--mesh-unit", metavar="UNIT", help="of the mesh (default: as it says, else that of the files)"
    )
    command.add_argument(
        "--modes",
        type=int,
        metavar="N",
        help="of matrices: compute so many modes, the six rigid ones included "
        f"(default: {USUAL_MODES})",
    )
    command.add_argument(
        "--up-to", type=float, metavar="HZ", help="of matrices: compute all modes up to this frequency"
    )
    command.add_argument(
        "--condense",
        choices=get_args(Condensation),
        help="of matrices: to few degrees of freedom first, enough for --up-to and for attachments",
    )
    command.add_argument(
        "--frequency",
        type=float,
        metavar="HZ",
        help="of mounts whose rates an input file has over frequency: where to take them",
    )
    command.add_argument(
        "--bodies",
        nargs=2,
        metavar=("FIRST", "SECOND"),
        help="that the springs of an input file join (default: those where its grids are)",
    )
    command.add_argument(
        "--residual",
        action="append",
        metavar="COMPLIANCE",
        help=f"what the modes leave out: {RESIDUAL_FORMS}, in the files' units; may be repeated",
    )
    command.add_argument(
        "--track-width",
        type=float,
        metavar="M",
        help="of a road: how far its tracks are apart, m (default: as the vehicle's tyres are)",
    )


IMPORT = Command(
    "import",
    "bodies, mounts and roads of other programs into a vehicle folder",
    ImportOptions,
    _add_options,
    import_component,
)
