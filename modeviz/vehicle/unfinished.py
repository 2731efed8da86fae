"""What a vehicle still lacks, and what that keeps from being computed."""

from collections.abc import Iterator

from modeviz.vehicle.connections import Damper, Spring
from modeviz.vehicle.vehicle import Vehicle


def unfinished(vehicle: Vehicle) -> Iterator[str]:
    """Sentences on what cannot be computed of a vehicle, each with the table that it takes."""
    if not vehicle.all_connections:
        yield (
            "Nothing holds its bodies together, so there are no modes of the whole: give its "
            "vehicle.toml [[mount_group]] tables, or a [[spring]], a [[bolt]] or a [[tyre]]."
        )
    elif not vehicle.mount_groups:
        yield f"No rates can be tuned: give its vehicle.toml a [[mount_group]]{_of_parts(vehicle)}."
    if vehicle.usual_load is None and not (vehicle.harmonic_loads or vehicle.engines):
        yield (
            "Nothing shakes it, so there are no responses: give its vehicle.toml a [[tyre]] with "
            "stiffness along z, which roads of ISO 8608 move, an [[engine]] or a [[force]]."
        )
    if not vehicle.response_points:
        yield "Nobody feels it: give its vehicle.toml a [[response_point]]."


def _of_parts(vehicle: Vehicle) -> str:
    """Words for the tables that tune springs and dampers, as far as it has some."""
    kinds = {"spring": Spring, "damper": Damper}
    found = [key for key, kind in kinds.items() if any(type(c) is kind for c in vehicle.connections)]
    return "".join(f", or a [[{key}_group]] for its {key}s" for key in found)
