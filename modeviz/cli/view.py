"""The command that opens a vehicle in the browser."""

from argparse import Namespace

from modeviz.cli.interrupt import ended_by_interrupt
from modeviz.cli.options import shown, vehicle_and_rates
from modeviz.cli.terminal import progress


def view(options: Namespace) -> None:
    """Serves the page until it is stopped."""
    with ended_by_interrupt():
        from modeviz.viewer.app import serve  # viser alone takes a second to import
        from modeviz.viewer.page.tokens import chosen_token

    token = chosen_token(options.token, options.token_file, options.has_token)
    vehicle, start = vehicle_and_rates(options)
    vehicle, chosen = shown(options, vehicle)
    serve(
        vehicle,
        start,
        chosen,
        options.host,
        options.port,
        token,
        options.dark,
        progress("preparing"),
        options.public_names,
    )
