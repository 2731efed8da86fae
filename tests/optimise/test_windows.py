import numpy as np
import pytest
from differences import central_difference
from mounted_cabin import mounted_cabin

from modeviz.analysis.modal_results import solve_modal
from modeviz.analysis.preparation import prepare_modes
from modeviz.analysis.sensitivity import frequency_sensitivity
from modeviz.dynamics.naming import ModeName
from modeviz.errors import VehicleError
from modeviz.optimise.windows import MARGIN, prepare_windows
from modeviz.vehicle.mount_rates import STIFFNESS_FIELDS, MountRates
from modeviz.vehicle.problem import FrequencyWindow

YAW_HZ = 10.675
RATES = {"A": MountRates(7e5, 2e5, 4.5e5), "B": MountRates(9e5, 2.8e5, 3.5e5)}


@pytest.fixture(scope="module")
def prepared():
    return prepare_modes(mounted_cabin())


def windows_of(prepared, *limits):
    return prepare_windows(prepared, [FrequencyWindow("cab yaw", *own) for own in limits])


@pytest.mark.parametrize(
    ("limits", "margins"),
    [
        ((0.0, 12.0), [1 - YAW_HZ / 12]),
        ((9.0, np.inf), [YAW_HZ / 9 - 1]),
        ((9.0, 12.0), [YAW_HZ / 9 - 1, 1 - YAW_HZ / 12]),
        ((11.0, 12.0), [YAW_HZ / 11 - 1, 1 - YAW_HZ / 12]),
        ((8.0, 10.0, False), [YAW_HZ / 10 - 1]),
        ((11.0, 14.0, False), [1 - YAW_HZ / 11]),
        ((10.0, 14.0, False), [1 - YAW_HZ / 10]),
        ((8.0, 11.0, False), [YAW_HZ / 11 - 1]),
    ],
)
def test_margins_are_what_is_left_to_the_ends(prepared, limits, margins):
    found, _ = windows_of(prepared, limits).margins({})
    np.testing.assert_allclose(found, np.subtract(margins, MARGIN), atol=1e-4)


def test_their_derivatives_are_central_differences(prepared):
    windows = windows_of(prepared, (9.0, 12.0), (11.0, 14.0, False), (8.0, 9.0, False))
    values, gradients = windows.margins(RATES)
    assert values.shape == (4,)
    for i, (group, name) in enumerate((g, n) for g in RATES for n in STIFFNESS_FIELDS):
        k = getattr(RATES[group], name)

        def margins(rate, group=group, name=name):
            fields = {n: getattr(RATES[group], n) for n in STIFFNESS_FIELDS} | {name: rate}
            return windows.margins({**RATES, group: MountRates(**fields)})[0]

        expected = central_difference(margins, k, step=1e-3)
        scale = np.abs(gradients).max(axis=1)
        assert (np.abs(gradients[:, i] - expected) < 1e-6 * scale).all()


def test_ends_are_spoken_in_the_order_of_the_margins(prepared):
    windows = windows_of(prepared, (9.0, 12.0), (0.0, 10.5), (14.0, np.inf), (11.0, 14.0, False))
    assert windows.spoken == [
        "cab yaw: at least 9 Hz", "cab yaw: at most 12 Hz", "cab yaw: at most 10.5 Hz",
        "cab yaw: at least 14 Hz", "cab yaw: not 11 Hz to 14 Hz",
    ]  # fmt: skip
    assert len(windows.margins({})[0]) == len(windows.spoken)


def test_where_no_mode_has_the_name_the_one_most_like_it_is_meant(prepared):
    """With mounts that are rigid sideways no mode is a yaw of the cab alone."""
    rigid = {group: MountRates(1e4, 1e7, 1e4) for group in "AB"}
    exact = solve_modal(prepared, rigid, "exact")
    assert exact.mode_index("cab yaw") is None
    own = solve_modal(prepared, {})
    shape = own.modes.shapes[:, own.mode_index("cab yaw")]
    mac = np.abs(exact.modes.shapes.T @ prepared.system.mass @ shape)
    (f,) = windows_of(prepared, (1.0, 12.0)).exact_frequencies(rigid)
    assert f == pytest.approx(exact.modes.frequency_hz[mac.argmax()], rel=1e-9)


def test_exact_frequencies_are_those_of_the_full_eigenproblem(prepared):
    windows = windows_of(prepared, (9.0, 12.0))
    (f,) = windows.exact_frequencies({})
    assert f == pytest.approx(YAW_HZ, abs=1e-3)
    margins, _ = windows.margins({})
    assert margins[0] == pytest.approx(f / 9 - 1 - MARGIN, abs=1e-6)


def test_a_mode_that_is_not_there_is_an_error(prepared):
    with pytest.raises(VehicleError, match=r"^window: unknown mode 'cab jaw': did you mean 'cab yaw'"):
        prepare_windows(prepared, [FrequencyWindow("cab jaw", high_hz=9.0)])


@pytest.mark.parametrize(("score", "is_as_good"), [(0.25, False), (0.415, True)])
def test_of_modes_with_one_motion_those_with_most_of_it_are_held(
    prepared, monkeypatch, score, is_as_good
):
    own = solve_modal(prepared, {})
    yaw = own.mode_index("cab yaw")

    def renamed(*arguments):
        results = solve_modal(*arguments)
        names = list(results.names)
        names[yaw - 1], names[yaw] = ModeName("cab yaw", score), ModeName("cab yaw 2", 0.42)
        vars(results)["names"] = tuple(names)
        return results

    windows = windows_of(prepared, (9.0, 12.0))
    monkeypatch.setattr("modeviz.optimise.windows.solve_modal", renamed)
    assert windows.exact_frequencies({}) == pytest.approx(YAW_HZ, abs=1e-3)
    (low, high), gradients = windows.margins({})
    lower = own.modes.frequency_hz[yaw - 1 if is_as_good else yaw]
    assert low == pytest.approx(lower / 9 - 1 - MARGIN, abs=1e-6)
    assert high == pytest.approx(1 - YAW_HZ / 12 - MARGIN, abs=1e-4)
    slopes = frequency_sensitivity(own)
    np.testing.assert_allclose(gradients[0], slopes[yaw - 1 if is_as_good else yaw] / 9, rtol=1e-9)
    np.testing.assert_allclose(gradients[1], -slopes[yaw] / 12, rtol=1e-9)


def test_a_namesake_is_held_by_its_shape_and_not_by_its_number(prepared, monkeypatch):
    """Of two with one name at the vehicle's own rates, the lower one is called something else later."""
    own = solve_modal(prepared, {})
    lateral, fore_aft = (own.mode_index(f"cab {motion}") for motion in ("lateral", "fore-aft"))

    def called(*new):
        def renamed(*arguments):
            results = solve_modal(*arguments)
            names = list(results.names)
            for mode, name in zip((lateral, fore_aft), new, strict=True):
                names[mode] = ModeName(name, 0.9)
            vars(results)["names"] = tuple(names)
            return results

        monkeypatch.setattr("modeviz.optimise.windows.solve_modal", renamed)

    called("cab sway", "cab sway 2")
    held = [FrequencyWindow(name, 1.0, 30.0) for name in ("cab sway", "cab sway 2")]
    windows = prepare_windows(prepared, held)
    for later in (("cab sway", "cab sway 2"), ("cab tilt", "cab sway"), ("cab sway", "cab tilt")):
        called(*later)
        expected = own.modes.frequency_hz[[lateral, fore_aft]]
        np.testing.assert_allclose(windows.exact_frequencies({}), expected, rtol=1e-6)


@pytest.mark.parametrize("limits", [(0.0, 45.0), (30.0, 45.0, False), (45.0, np.inf)])
def test_what_lies_above_all_modes_that_are_known_is_refused(prepared, limits):
    with pytest.raises(VehicleError, match="'cab yaw': found 45 Hz, expected 40 Hz at most, up to"):
        windows_of(prepared, limits)
