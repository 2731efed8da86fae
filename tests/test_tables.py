"""What the table of modes says in the terminal."""

from mounted_cabin import mounted_cabin

from modeviz.export.tables import modes_table
from modeviz.tuning.following import solve_followed
from modeviz.tuning.preparation import prepare_modes
from modeviz.vehicle.connections import MountRates


def told(rates):
    """What is said of each mode in the last column, and what is known of it."""
    followed = solve_followed(prepare_modes(mounted_cabin()), rates)
    header, _, *lines = modes_table(followed, 40.0).split("\n\n")[0].splitlines()
    return followed, [line[-60:].rsplit("  ", 1)[-1] for line in lines], header


def test_with_the_own_rates_every_mode_was_itself():
    followed, said, header = told({})
    assert header.endswith("was originally")
    base = followed.base
    assert said == [
        f"{name.name} {f:.2f}" for name, f in zip(base.names, base.modes.frequency_hz, strict=True)
    ]


def test_a_mode_that_was_in_several_says_how_much_of_it():
    rates = {"A": MountRates(4.49e5, 1.2e4, 4.2e4), "B": MountRates(2.21e5, 3.5e5, 2.4e4)}
    followed, said, _ = told(rates)
    base, now = followed.base, followed.now
    mac = (base.modes.shapes.T @ base.prepared.system.mass @ now.modes.shapes) ** 2
    i = now.mode_index("cab bounce")
    assert said[i] == f"cab bounce {base.modes.frequency_hz[base.mode_index('cab bounce')]:.2f}"
    i = now.mode_index("cab lateral 2")
    was = [j for j in (-mac[:, i]).argsort() if mac[j, i] > mac[:, i].max() / 2]
    assert len(was) == 2
    expected = (
        f"{100 * mac[j, i]:.0f} % {base.names[j].name} {base.modes.frequency_hz[j]:.2f}" for j in was
    )
    assert said[i] == ", ".join(expected)
