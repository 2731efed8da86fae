import tracemalloc

import numpy as np
import pytest
from mounted_cabin import mounted_cabin
from small_systems import resonant_rate, two_masses

from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.mount_rates import mount_stiffness
from modeviz.dynamics.reanalysis import BLOCK, Receptances, prepare_receptances
from modeviz.dynamics.spring_law import constant_law
from modeviz.errors import SolveError

F = np.array([0.3, 2.7, 8.0, 11.9, 40.0])
OUTPUTS, INPUTS = np.eye(12)[:4], np.eye(12)[3:]

TOLERANCE = {"rigid": 1e-8, "none": 1e-8}
"""Beside 1e-10: the direct solution loses what 4e11 N/m is above the tyres, and the live one what free
motion at 0.3 Hz is above that on mounts."""


@pytest.fixture(scope="module")
def system():
    return assemble(mounted_cabin())


@pytest.fixture(scope="module")
def receptances(system):
    return prepare_receptances(system, F, OUTPUTS, INPUTS)


def dense(system, stiffness, rows, columns):
    """Receptances from the full matrices with other rates."""
    R = system.mount_motions
    K = system.stiffness + 1j * system.structural_damping
    K = K + (R.T * (stiffness - mount_stiffness(system.vehicle))) @ R
    omegas = 2 * np.pi * F
    Z = [K - w**2 * system.mass + 1j * w * system.damping for w in omegas]
    return np.array([rows @ np.linalg.solve(z, columns.T) for z in Z])


def error(found, expected):
    """The largest difference relative to the largest at the same frequency."""
    return (np.abs(found - expected).max(axis=(1, 2)) / np.abs(expected).max(axis=(1, 2))).max()


def rates(system, kind):
    own = mount_stiffness(system.vehicle)
    rng = np.random.default_rng(4)
    return {
        "base": own,
        "one": np.where(np.arange(12) == 7, 3 * own, own),
        "one removed": np.where(np.arange(12) == 7, 0, own),
        "softer": own * rng.uniform(0.01, 1, 12),
        "any": own * 10 ** rng.uniform(-2, 2, 12),
        "loss alone": own.real * (1 + 0.4j),
        "none": 0 * own,
        "rigid": np.where(np.arange(12) < 3, 1e6 * own, own),
    }[kind]


KINDS = ("base", "one", "one removed", "softer", "any", "loss alone", "none", "rigid")


@pytest.mark.parametrize("kind", KINDS)
def test_response_is_the_direct_solution_at_any_rates(system, receptances, kind):
    stiffness = rates(system, kind)
    expected = dense(system, stiffness, OUTPUTS, INPUTS)
    assert error(receptances.response(stiffness), expected) < TOLERANCE.get(kind, 1e-10)


def test_many_responses_are_the_same_as_one_by_one(system, receptances):
    stiffness = np.array([rates(system, kind) for kind in KINDS])
    found = receptances.responses(stiffness)
    for kind, own, response in zip(KINDS, stiffness, found, strict=True):
        assert error(response, receptances.response(own)) < TOLERANCE.get(kind, 1e-10)


def test_many_responses_depend_by_rounding_only_on_how_many_are_solved_at_once(system, receptances):
    n_sets = BLOCK // (16 * 12**2) + 2
    stiffness = np.tile([rates(system, kind) for kind in ("softer", "any")], (n_sets // 2, 1))
    H = receptances.responses(stiffness)
    np.testing.assert_allclose(H[2:], np.tile(H[:2], (len(H) // 2 - 1, 1, 1, 1)), rtol=1e-11)


def test_receptances_can_be_asked_at_some_frequencies_and_outputs_only(system, receptances):
    lines, outputs = np.array([1, 3]), np.array([2, 0])
    stiffness = rates(system, "any")
    found = receptances.at(lines).with_outputs(outputs).response(stiffness)
    expected = receptances.response(stiffness)[np.ix_(lines, outputs)]
    np.testing.assert_allclose(found, expected, rtol=1e-12)


@pytest.mark.parametrize("kind", KINDS)
def test_all_receptances_can_be_moved_to_other_rates(system, receptances, kind):
    stiffness = rates(system, kind)
    moved = receptances.modified(stiffness)
    R, tolerance = system.mount_motions, TOLERANCE.get(kind, 1e-10)
    np.testing.assert_array_equal(moved.mount_stiffness, stiffness)
    assert error(moved.springs, dense(system, stiffness, R, R)) < tolerance
    assert error(moved.outputs, dense(system, stiffness, R, OUTPUTS)) < tolerance
    assert error(moved.inputs, dense(system, stiffness, R, INPUTS)) < tolerance
    assert error(moved.direct, dense(system, stiffness, OUTPUTS, INPUTS)) < tolerance


def test_there_and_back_is_where_it_began(system, receptances):
    back = receptances.modified(rates(system, "any")).modified(rates(system, "base"))
    assert error(back.springs, receptances.springs) < 1e-10
    assert error(back.direct, receptances.direct) < 1e-10


def test_a_rigid_spring_does_not_stretch(system, receptances):
    stiffness = rates(system, "rigid")
    _, _, to_inputs = receptances.response_gradient(stiffness)
    before = np.abs(receptances.inputs[:, :3]).max()
    assert np.abs(to_inputs[:, :3]).max() < 1e-4 * before


def test_the_response_has_a_limit_as_springs_become_rigid(system, receptances):
    own = mount_stiffness(system.vehicle)
    stiffer, stiff = (receptances.response(factor * own) for factor in (1e8, 1e6))
    # What gives way is of order k_tyre / k, 1e-5 here.
    assert error(stiff, stiffer) < 1e-4


@pytest.mark.parametrize("kind", KINDS)
def test_the_gradient_is_made_of_receptances_at_the_new_rates(system, receptances, kind):
    stiffness = rates(system, kind)
    H, to_outputs, to_inputs = receptances.response_gradient(stiffness)
    R, tolerance = system.mount_motions, TOLERANCE.get(kind, 1e-10)
    assert error(H, dense(system, stiffness, OUTPUTS, INPUTS)) < tolerance
    assert error(to_outputs, dense(system, stiffness, R, OUTPUTS)) < tolerance
    assert error(to_inputs, dense(system, stiffness, R, INPUTS)) < tolerance


def test_inputs_can_be_summed_into_loads(system, receptances):
    amplitudes = np.random.default_rng(0).normal(size=(len(F), len(INPUTS), 2)) * (1 + 2j)
    driven = receptances.driven(amplitudes, np.zeros((len(F), len(system.mount_motions), 2)))
    stiffness = rates(system, "any")
    expected = receptances.response(stiffness) @ amplitudes
    assert error(driven.response(stiffness), expected) < 1e-12


def test_memory_is_that_of_the_arrays(receptances):
    n_values = len(F) * (12 * 12 + 12 * 4 + 12 * 9 + 4 * 9)
    assert receptances.n_bytes == 16 * n_values


def test_a_response_takes_little_memory_beside_the_receptances():
    rng = np.random.default_rng(0)
    n_freqs, n_springs = 400, 60
    large = Receptances(
        np.arange(1.0, n_freqs + 1),
        np.ones(n_springs, complex),
        rng.normal(size=(n_freqs, n_springs, n_springs)) + 100j * np.eye(n_springs),
        *(rng.normal(size=(n_freqs, n_springs, 2)) + 0j for _ in range(2)),
        rng.normal(size=(n_freqs, 2, 2)) + 0j,
        constant_law(n_springs),
    )
    tracemalloc.start()
    large.response(np.full(n_springs, 2 + 0j))
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 4 * BLOCK < large.springs.nbytes


def test_what_outputs_do_to_each_other_is_not_kept(system):
    f, outputs = np.arange(1.0, 101), np.tile(OUTPUTS, (50, 1))
    tracemalloc.start()
    prepare_receptances(system, f, outputs, INPUTS)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 16 * len(f) * len(outputs) ** 2


def two_mass_receptances(frequency_hz, damping=0.0):
    z = np.eye(12)[[2, 8]]
    return prepare_receptances(two_masses(1.0, damping), np.array([0.1, frequency_hz, 30.0]), z, z)


@pytest.mark.parametrize("frequency_hz", [1.0, 4.0, 10.0])
@pytest.mark.parametrize("beside", [0.0, 1e-15, 1e-12, 1e-9])
def test_rates_that_put_an_undamped_resonance_on_a_line_are_an_error(frequency_hz, beside):
    receptances = two_mass_receptances(frequency_hz)
    stiffness = mount_stiffness(two_masses(resonant_rate(frequency_hz) * (1 + beside)).vehicle)
    for answer in (receptances.response, receptances.modified, receptances.response_gradient):
        with pytest.raises(
            SolveError, match=rf"at {frequency_hz} Hz: an undamped resonance lies there"
        ):
            answer(stiffness)


@pytest.mark.parametrize("frequency_hz", [1.0, 4.0, 10.0])
def test_a_rate_a_thousandth_beside_is_answered(frequency_hz):
    rate = 1.001 * resonant_rate(frequency_hz)
    H = two_mass_receptances(frequency_hz).response(mount_stiffness(two_masses(rate).vehicle))[1]
    square = (2 * np.pi * frequency_hz) ** 2
    low, high = 800.0 - 2.0 * square, -3.0 * square
    by_hand = np.array([[rate + high, rate], [rate, rate + low]]) / (low * high + rate * (low + high))
    np.testing.assert_allclose(H, by_hand, rtol=1e-10)


def test_with_a_little_damping_the_resonance_is_answered():
    rate, f = resonant_rate(4.0), 4.0
    stiffness = mount_stiffness(two_masses(rate).vehicle)
    H = two_mass_receptances(f, damping=1e-2).response(stiffness)[1]
    omega = 2 * np.pi * f
    low, high = 800.0 - 2.0 * omega**2 + 1e-2j * omega, -3.0 * omega**2
    by_hand = np.array([[rate + high, rate], [rate, rate + low]]) / (low * high + rate * (low + high))
    np.testing.assert_allclose(H, by_hand, rtol=1e-8)


def test_a_spring_too_stiff_for_arithmetic_is_an_error(system, receptances):
    with pytest.raises(SolveError, match="too stiff beside the others"):
        receptances.response(np.full(12, 1e100 + 0j))


@pytest.mark.parametrize(
    ("frequency_hz", "found"),
    [([0.0, 1.0], "0 Hz at place 1"), ([1.0, 1.0], "1 Hz twice"), ([1.0, np.nan], "nan Hz at place 2"),
     ([1.0, np.inf], "inf Hz at place 2"), ([2.0, 1.0], "2 Hz before 1 Hz"), ([-1.0], "-1 Hz")],
)  # fmt: skip
def test_frequencies_are_checked(system, frequency_hz, found):
    with pytest.raises(SolveError, match=rf"^frequency_hz: found {found}"):
        prepare_receptances(system, np.array(frequency_hz), OUTPUTS, INPUTS)
