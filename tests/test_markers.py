import numpy as np

from modeviz.vehicle.connections import Mount, MountGroup, MountRates
from modeviz.viewer.markers import card_text

BOUNDS = (MountRates(1.0, 1.0, 1.0), MountRates(1e6, 1e6, 1e6))
RATES = MountRates(1.64e6, 1.21e6, 4.8e5)


def group(*names):
    mounts = tuple(Mount(name, "", ("cab", "frame"), np.zeros((2, 3))) for name in names)
    return MountGroup("C1", "cab front", MountRates(1e5, 1e5, 1e5), 0.1, BOUNDS, mounts)


def test_card_names_the_group_its_sides_its_rates_and_its_share():
    text = card_text(group("C1 left", "C1 right"), RATES, 0.234, "cab yaw")
    assert text == (
        "C1  cab front, left + right\n"
        "vertical 1640  lateral 1210  fore-aft 480 N/mm\n"
        "23 % of strain energy in cab yaw"
    )


def test_lone_mount_has_no_side():
    assert card_text(group("C1"), RATES, 0.0, "pitch").splitlines()[0] == "C1  cab front"
