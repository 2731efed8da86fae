"""What can be asked of an import."""

from argparse import ArgumentParser
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import get_args

from modeviz.errors import VehicleError
from modeviz.formats.component import UNIT_SYSTEMS
from modeviz.formats.effect import check_only, is_asked
from modeviz.formats.imported import USUAL_PLANE, ImportSettings
from modeviz.formats.mounts.imported import MountSettings, is_deck_with_springs, is_property
from modeviz.formats.places import FORMS
from modeviz.formats.poses import FORMS as POSE_FORMS
from modeviz.formats.residuals import FORMS as RESIDUAL_FORMS
from modeviz.formats.roads.imported import RoadSettings
from modeviz.formats.solving import USUAL_MODES, Condensation, Wanted

Add = Callable[..., object]
"""Adds an option to a group of them."""

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

    @property
    def body(self) -> ImportSettings:
        """What is asked for of a body; raises VehicleError for what has no effect on it."""
        self._check_listed()
        self.check_only("a body", *OF_MATRICES, *OF_A_BODY)
        return ImportSettings(
            units=self.units,
            attach=self.attach,
            residual=self.residual,
            pose=self.pose,
            antisymmetric=self.antisymmetric,
            plane=self.plane,
            mesh=self.mesh,
            mesh_unit=self.mesh_unit,
            wanted=Wanted(n_modes=self.modes, up_to_hz=self.up_to, condensed=self.condense),
            replaces=self.replace,
        )

    def _check_listed(self) -> None:
        """Checks that a body, or its springs, are written if what only then has an effect is given."""
        if self.output is not None:
            return
        self._check_none("a body that is", OF_A_BODY)
        if (self.frequency is not None or self.bodies) and is_deck_with_springs(self.files):
            self._check_none("springs that are", OF_SPRINGS)

    def check_only(self, what: str, *names: str) -> None:
        """Checks that nothing else is asked for than what these fields say; raises VehicleError."""
        check_only(vars(self), what, "files", "output", *names)

    def _check_none(self, what: str, names: Sequence[str]) -> None:
        """Checks that nothing is asked for that only what is written has; raises VehicleError."""
        if given := [name for name in names if is_asked(vars(self)[name])]:
            option = given[0].replace("_", "-")
            raise VehicleError(f"--{option} is of {what} written; say where with --output")


def add_options(command: ArgumentParser) -> None:
    """Lets a parser read what can be asked of an import."""
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
    command.add_argument(
        "--name", metavar="NAME", help="of the body, or the road (default: the first file's)"
    )
    command.add_argument("--pose", metavar="POSE", help=f"where it stands in the vehicle: {POSE_FORMS}")
    _add_body(command.add_argument_group("a body").add_argument)
    _add_half(command.add_argument_group("half a body").add_argument)
    _add_matrices(command.add_argument_group("a body of matrices").add_argument)
    _add_springs(command.add_argument_group("the springs of an input file").add_argument)
    command.add_argument_group("a road").add_argument(
        "--track-width",
        type=float,
        metavar="M",
        help="how far its tracks are apart, m (default: as the vehicle's tyres are)",
    )


def _add_body(add: Add) -> None:
    add(
        "--replace",
        action="store_true",
        help="give the body of that name in the folder new modes, mesh and attachments; what stands in "
        "vehicle.toml else stays",
    )
    add(
        "--attach",
        action="append",
        metavar="PLACE",
        help=f"where others hold on to it: {FORMS}; may be repeated",
    )
    add(
        "--residual",
        action="append",
        metavar="COMPLIANCE",
        help=f"what the modes leave out: {RESIDUAL_FORMS}, in the files' units; may be repeated",
    )
    add(
        "--mesh",
        type=Path,
        metavar="FILE",
        help="what it looks like, in the files' coordinates (.stl, .obj, .ply, .glb, .dae, .step); its "
        "nodes move that (default: the faces of its elements)",
    )
    add("--mesh-unit", metavar="UNIT", help="of the mesh (default: as it says, else that of the files)")


def _add_half(add: Add) -> None:
    add(
        "--antisymmetric",
        nargs="+",
        type=Path,
        metavar="FILE",
        help="of a half model's run with antisymmetric conditions at the plane in which it is cut; the "
        "other files are of the symmetric run, and both become the whole",
    )
    add(
        "--plane",
        metavar="PLANE",
        help=f"in which a half model is cut, in the files' units (default: {USUAL_PLANE})",
    )


def _add_matrices(add: Add) -> None:
    add(
        "--modes",
        type=int,
        metavar="N",
        help=f"compute so many modes, the six rigid ones included (default: {USUAL_MODES})",
    )
    add("--up-to", type=float, metavar="HZ", help="compute all modes up to this frequency")
    add(
        "--condense",
        choices=get_args(Condensation),
        help="to few degrees of freedom first, enough for --up-to and for attachments",
    )


def _add_springs(add: Add) -> None:
    add(
        "--frequency",
        type=float,
        metavar="HZ",
        help="where to take rates that it has over frequency",
    )
    add(
        "--bodies",
        nargs=2,
        metavar=("FIRST", "SECOND"),
        help="that they join (default: those where its grids are)",
    )
