"""What is asked of files on which it has no effect."""

from collections.abc import Mapping

from modeviz.errors import VehicleError


def is_asked(value: object) -> bool:
    """Return whether an option has been given: it is not None, False or (), but may be 0."""
    return value is not None and value is not False and value != ()


def check_only(asked: Mapping[str, object], what: str, *names: str) -> None:
    """Checks that nothing else is asked for than what these names say.

    Args:
        asked: values by the names of options.
        what: the files hold, such as "a road".
        names: of what has an effect on that.

    Raises:
        VehicleError: something is, which would have no effect.
    """
    for name, value in asked.items():
        if is_asked(value) and name not in names:
            raise VehicleError(f"--{name.replace('_', '-')}: has no effect on {what}; leave it out")
