"""Input files of Nastran and what it punches: matrices and geometry on cards, read in one pass."""

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from modeviz.errors import VehicleError, located
from modeviz.formats.component import Component
from modeviz.formats.named_matrices import NamedMatrix
from modeviz.formats.nastran.bulk import cards
from modeviz.formats.nastran.deck import NAMES as GEOMETRY
from modeviz.formats.nastran.deck import GeometryCards
from modeviz.formats.nastran.dmig import NAMES as MATRICES
from modeviz.formats.nastran.dmig import MatrixCards
from modeviz.formats.nastran.geometry import without_modes
from modeviz.formats.nastran.model import basic_geometry
from modeviz.formats.nastran.punch_modes import PUNCH
from modeviz.vehicle.arrays import Array


@dataclass(frozen=True, eq=False)
class InputFile:
    """The cards of a file and of those it includes; what they mean is worked out where it is wanted."""

    path: Path
    _geometry: GeometryCards
    _matrices: MatrixCards

    @cached_property
    def matrices(self) -> list[NamedMatrix]:
        """The square real matrices of its DMIG cards; raises VehicleError if one is wrong."""
        with located(self.path):
            return self._matrices.matrices()

    @property
    def orders(self) -> list[Array]:
        """What rows of matrices may be, see `MatrixCards`; raises VehicleError if a GRID is wrong."""
        with located(self.path):
            return self._matrices.orders(grid.whole(0) for grid in self._geometry.grids)

    def geometry(self, *notes: str) -> Component:
        """Return its nodes and elements, with notes on what it lacks.

        Raises:
            VehicleError: there is no GRID, or they or their systems are wrong.
        """
        with located(self.path):
            model = self._geometry.model()
            return without_modes(model, *basic_geometry(model), notes)


def read_input(path: Path) -> InputFile:
    """Return what an input file has.

    Raises:
        VehicleError: a file is missing, a card is wrong, or what was punched is something else.
    """
    geometry, matrices = GeometryCards(), MatrixCards()
    with located(path):
        for card in cards(path, GEOMETRY | MATRICES):
            (matrices if card.name in MATRICES else geometry).add(card)
        if path.suffix.lower() == PUNCH and not (geometry.grids or matrices.found or matrices.external):
            raise VehicleError(
                "has neither modes ($EIGENVECTOR) nor matrices on DMIG cards nor GRIDs; punch modes by "
                "DISPLACEMENT(PUNCH)=ALL or VECTOR(PUNCH)=ALL in a run for modes"
            )
    return InputFile(path, geometry, matrices)
