"""The command that opens a vehicle in the browser."""

from argparse import Namespace

from modeviz.commands.options import conditions, progress, vehicle_and_rates


def view(options: Namespace) -> None:
    """Serves the page until it is stopped."""
    from modeviz.viewer.app import serve  # viser alone takes a second to import

    vehicle, start = vehicle_and_rates(options)
    serve(
        vehicle,
        start,
        conditions(options, vehicle),
        options.host,
        options.port,
        options.token,
        options.dark,
        progress("preparing"),
    )
