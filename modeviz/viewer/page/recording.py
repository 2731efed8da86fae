"""A page without a server: what viser's page shows of a scene as it is, in one file."""

import viser
from viser import _messages

from modeviz.vehicle.arrays import Floats


def recorded_page(server: viser.ViserServer, dark: bool, position: Floats, look_at: Floats) -> str:
    """The HTML of a page with the scene of a server, which needs no network.

    Args:
        server: whose scene it is.
        dark: whether the page is.
        position: of the camera at first, m.
        look_at: what it looks at first, m.
    """
    recording = server.get_scene_serializer()
    for message in (
        _messages.SetCameraPositionMessage(_three(position)),
        _messages.SetCameraLookAtMessage(_three(look_at)),
        _messages.SetCameraNearMessage(server.initial_camera.near),
        _messages.SetCameraFarMessage(server.initial_camera.far),
    ):
        recording._insert_message(message)
    return recording.as_html(dark)


def _three(vector: Floats) -> tuple[float, float, float]:
    x, y, z = vector.tolist()
    return x, y, z
