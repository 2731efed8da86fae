"""A state as a vehicle can have it: what fits is kept, and what does not is said."""

from dataclasses import dataclass, replace

from modeviz.errors import ModevizError
from modeviz.vehicle.absorbers import with_absorbers
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.session.encoding.fit_design import fitted_absorbers, fitted_design
from modeviz.viewer.session.encoding.fit_looks import fitted_looks
from modeviz.viewer.session.encoding.remarks import Remarks
from modeviz.viewer.session.state import State


@dataclass(frozen=True)
class Fitted:
    """A state that a vehicle can have."""

    state: State
    remarks: tuple[str, ...]
    """What of the state that was asked for does not fit, sentences without their stops."""


def fitted(state: State, usual: State, vehicle: Vehicle) -> Fitted:
    """Return a state as far as it fits a vehicle.

    Args:
        state: that is asked for, by whomever.
        usual: the first one of the vehicle, for what does not fit.
        vehicle: as in its file.
    """
    remarks = Remarks()
    alterations = state.design.alterations
    absorbers = fitted_absorbers(alterations.absorbers, vehicle, remarks)
    whole = with_absorbers(vehicle, absorbers)
    near = replace(state.design, alterations=replace(alterations, absorbers=absorbers))
    design = fitted_design(near, usual.design, vehicle, whole, remarks)
    looking = fitted_looks(replace(state, design=design), usual, whole, remarks)
    return Fitted(looking, remarks.sentences)


def check_fits(state: State, usual: State, vehicle: Vehicle, what: str) -> None:
    """Raises ModevizError unless a vehicle can have a state; `what` it is."""
    remarks = fitted(state, usual, vehicle).remarks
    if remarks:
        raise ModevizError(f"{what}: {'; '.join(remarks)}")
