"""What is said of columns whose headers have no unit, which are taken in those of the vehicle file."""

from collections.abc import Callable, Mapping

from modeviz.errors import listed
from modeviz.files.schema.conventions import Conventions
from modeviz.units import QuantityName


def note_untold_units(
    where: str,
    units: Mapping[str, str],
    quantities: Mapping[str, QuantityName],
    conventions: Conventions,
    note: Callable[[str], None],
) -> None:
    """Tells in what units the columns of a table are taken that say none, a sentence a quantity.

    Args:
        where: to begin with.
        units: by column, "" where the header says none.
        quantities: of the columns that have one.
        conventions: with the units that are taken.
        note: told.
    """
    untold: dict[QuantityName, list[str]] = {}
    for name, quantity in quantities.items():
        if name in units and not units[name]:
            untold.setdefault(quantity, []).append(name)
    for quantity, names in untold.items():
        say, columns = ("says", "column") if len(names) == 1 else ("say", "columns")
        unit = conventions.units[quantity]
        note(
            f"{where}: {columns} {listed(names)} {say} no unit: taken in {unit}, the {quantity} of "
            "[units]"
        )
