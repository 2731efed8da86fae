"""The designs that a search may choose from: each within its limits, checked from the rates alone."""

from dataclasses import replace

import numpy as np
import pytest
from builtin_truck import builtin_truck
from cabin_problem import cabin_search
from limits_kept import excess
from mounted_cabin import mounted_cabin

from modeviz.errors import VehicleError
from modeviz.optimise.design_space import design_space
from modeviz.optimise.run import optimise, search_globally
from modeviz.optimise.starts import start_points
from modeviz.vehicle.mount_rates import STIFFNESS_FIELDS, MountRates
from modeviz.vehicle.problem import DesignGroup

START = MountRates(8e5, 3e5, 4e5)
BOUNDS = MountRates(2e5, 1e5, 1e5), MountRates(4e6, 2e6, 1e6)
LIMITED = DesignGroup("A", bounds=BOUNDS, ratio_limits=(0.25, 0.8))
FIXED = DesignGroup("B", fixed_ratios=True)
ROUNDING = 1e-12


@pytest.fixture(scope="module")
def truck():
    return builtin_truck()


@pytest.fixture(scope="module")
def of_paper(truck):
    return design_space(truck, truck.problem("paper").groups)


@pytest.fixture(scope="module")
def of_cabin():
    return design_space(mounted_cabin(), (LIMITED, FIXED))


def worst(rates, bounds, ratio_limits) -> float:
    """By how much a group's rates leave their bounds or ratios, relative, at worst."""
    k, low, high = (np.array(r.as_tuple()) for r in (rates, *bounds))
    over = [low / k - 1, k / high - 1]
    if ratio_limits:
        ratios = k[1:] / k[0]
        over += [ratio_limits[0] / ratios - 1, ratios / ratio_limits[1] - 1]
    return float(np.concatenate(over).max())


def scaled(rates, factors):
    return MountRates(*np.multiply(rates.as_tuple(), factors).tolist())


def test_the_papers_problem_has_eleven_variables(of_paper):
    """Table 4 has 15 rates; the engine's and the transmission's go together."""
    assert of_paper.n_variables == 3 * 3 + 2
    assert of_paper.members.sum() == 15
    spoken = [v.spoken for v in of_paper.variables]
    assert spoken[-3:] == ["C2 fore-aft", "E rates", "T rates"]


def test_every_sample_keeps_bounds_ratios_and_fixed_ratios(truck, of_paper):
    fixed = {g.group for g in truck.problem("paper").groups if g.fixed_ratios}
    for x in of_paper.samples(200, seed=1):
        rates = of_paper.rates(x)
        for group in truck.mount_groups:
            limits = None if group.name in fixed else group.ratio_limits
            assert worst(rates[group.name], group.bounds, limits) < ROUNDING
            if group.name in fixed:
                factors = np.divide(rates[group.name].as_tuple(), group.rates.as_tuple())
                np.testing.assert_allclose(factors, factors[0], rtol=1e-15)


def test_own_bounds_and_ratios_go_before_those_of_the_mounts(of_cabin):
    samples = of_cabin.samples(200, seed=2)
    found = [of_cabin.rates(x)["A"] for x in samples]
    assert max(worst(rates, BOUNDS, (0.25, 0.8)) for rates in found) < ROUNDING
    # The whole range of the vertical rate is used, as far as ratios of the others leave it.
    vertical = [rates.vertical for rates in found]
    assert min(vertical) == pytest.approx(2e5, rel=0.02)
    assert max(vertical) == pytest.approx(4e6, rel=0.02)


def test_samples_are_a_latin_hypercube_that_a_seed_repeats(of_cabin):
    """In logarithms every tenth of the range of a rate that nothing else limits has its sample."""
    samples = of_cabin.samples(10, seed=7)
    np.testing.assert_array_equal(samples, of_cabin.samples(10, seed=7))
    assert not np.array_equal(samples, of_cabin.samples(10, seed=8))
    for i, variable in enumerate(of_cabin.variables):
        if variable.lead == "vertical":
            low, high = of_cabin.lower[i], of_cabin.upper[i]
            tenths = np.floor(10 * (samples[:, i] - low) / (high - low))
            assert sorted(tenths) == list(range(10))
    assert of_cabin.samples(0, seed=7).shape == (0, of_cabin.n_variables)


@pytest.mark.parametrize("name", ["of_paper", "of_cabin"])
def test_admitted_leaves_feasible_designs_alone_and_brings_others_in(name, request):
    space = request.getfixturevalue(name)
    for x in space.samples(50, seed=3):
        np.testing.assert_allclose(space.admitted(x), x, rtol=0, atol=1e-15)
    for x in np.random.default_rng(4).normal(0, 3, (50, space.n_variables)):
        inside = space.admitted(x)
        assert excess(space, inside) < ROUNDING
        np.testing.assert_array_equal(space.admitted(inside), inside)


def test_rates_and_designs_are_each_others_inverse(of_paper):
    for x in of_paper.samples(20, seed=5):
        np.testing.assert_allclose(of_paper.to_x(of_paper.rates(x)), x, rtol=0, atol=1e-14)
    np.testing.assert_array_equal(of_paper.to_x({}), 0)
    assert of_paper.rates(np.zeros(of_paper.n_variables)) == of_paper.vehicle.rates


def test_rates_beyond_a_limit_become_the_nearest_design(truck, of_paper):
    """The paper's F mounts have ratios of 0.245 and 0.247, below its own limit of 0.25."""
    paper = truck.rate_sets["optimised"]
    nearest = of_paper.rates(of_paper.to_x(paper))
    assert nearest["C1"].as_tuple() == pytest.approx(paper["C1"].as_tuple(), rel=1e-14)
    assert nearest["F"].vertical == pytest.approx(paper["F"].vertical, rel=1e-14)
    assert nearest["F"].lateral == pytest.approx(0.25 * paper["F"].vertical, rel=1e-14)
    # Fixed ratios take the mean of the factors' logarithms.
    factors = np.divide(paper["E"].as_tuple(), truck.rates["E"].as_tuple())
    assert nearest["E"].vertical == pytest.approx(1.4e6 * factors.prod() ** (1 / 3), rel=1e-14)
    removed = of_paper.rates(of_paper.to_x({"C2": MountRates(0.0, 0.0, 0.0)}))["C2"]
    assert removed.vertical == pytest.approx(0.25 * truck.rates["C2"].vertical, rel=1e-14)


def test_excess_is_the_logarithm_of_the_worst_limit(of_cabin):
    bounds, own = of_cabin.vehicle.mount_group("B").bounds, START
    for x in np.random.default_rng(6).normal(0, 2, (50, of_cabin.n_variables)):
        rates = of_cabin.rates(x)
        over = max(worst(rates["A"], BOUNDS, (0.25, 0.8)), worst(rates["B"], bounds, None))
        assert excess(of_cabin, x) == pytest.approx(np.log(1 + over), abs=1e-12)
        assert rates["B"] == scaled(own, np.exp(x[-1]))


def test_locked_rates_and_loss_factors_stay():
    vehicle = mounted_cabin()
    base = {"A": MountRates(5e5, 2e5, 3e5, loss_factor=0.4)}
    locked = frozenset({("A", "fore_aft")})
    space = design_space(vehicle, (LIMITED,), base, locked)
    assert [v.spoken for v in space.variables] == ["A vertical", "A lateral"]
    for x in space.samples(20, seed=1):
        rates = space.rates(x)
        assert rates["A"].fore_aft == 3e5
        assert rates["A"].loss_factor == 0.4
        assert rates["B"] == vehicle.rates["B"]


def test_a_locked_rate_locks_a_group_of_fixed_ratios():
    locked = frozenset({("B", "lateral")})
    space = design_space(mounted_cabin(), (LIMITED, FIXED), locked=locked)
    assert {v.group for v in space.variables} == {"A"}


@pytest.mark.parametrize("kept", STIFFNESS_FIELDS)
def test_ratios_to_a_rate_that_is_kept_are_limited_too(kept):
    locked = frozenset({("A", kept)})
    space = design_space(mounted_cabin(), (replace(LIMITED, bounds=None),), locked=locked)
    found = [space.rates(x)["A"] for x in space.samples(100, seed=1)]
    bounds = mounted_cabin().mount_group("A").bounds
    over = [worst(rates, bounds, (0.25, 0.8)) for rates in found]
    assert max(over) < ROUNDING
    assert max(over) > -0.05  # one of them is close to a limit
    assert {getattr(rates, kept) for rates in found} == {getattr(START, kept)}
    assert excess(space, space.to_x({})) < ROUNDING


def test_a_limit_says_what_it_is_of(of_cabin):
    spoken = {limit.spoken for limit in of_cabin.limits}
    assert {
        "A vertical: lower bound",
        "A fore-aft: upper ratio limit",
        "B rates: upper bound",
    } <= spoken
    kept = design_space(mounted_cabin(), (LIMITED,), locked=frozenset({("A", "vertical")}))
    assert "A lateral: lower ratio limit" in {limit.spoken for limit in kept.limits}
    assert not kept.ratios.any()


def test_a_ratio_without_a_lower_limit_has_one_side():
    group = replace(LIMITED, ratio_limits=(0.0, 0.8))
    limits = design_space(mounted_cabin(), (group,)).limits
    assert [limit.spoken for limit in limits if "ratio" in limit.spoken] == [
        "A lateral: upper ratio limit",
        "A fore-aft: upper ratio limit",
    ]


SOFT_SIDES = MountRates(2e5, 1e3, 1e3), MountRates(4e6, 4e4, 1e6)


@pytest.mark.parametrize(
    ("group", "base", "locked", "words"),
    [
        (DesignGroup("C"), None, [], "unknown mount group 'C': there are A, B"),
        (LIMITED, None, STIFFNESS_FIELDS, "nothing may change: every rate of the problem is locked"),
        # Lateral at most 40 N/mm is below a quarter of the softest vertical, 50 N/mm.
        (
            replace(LIMITED, bounds=SOFT_SIDES),
            None,
            [],
            "A: vertical is at least 200 N/mm, but lateral is at most 40 N/mm and at least 0.25",
        ),
        (
            replace(LIMITED, bounds=SOFT_SIDES),
            None,
            ["vertical"],
            "A: vertical is kept at 800 N/mm, but lateral is at most 40 N/mm and at least 0.25",
        ),
        (
            LIMITED,
            {"A": MountRates(8e5, 3e6, 1e5)},
            ["lateral", "fore_aft"],
            "A: lateral is kept at 3000 N/mm and at most 0.8 of vertical",
        ),
        (
            replace(LIMITED, bounds=(MountRates(1e5, 5e5, 1e5), MountRates(2e5, 9e5, 1e5))),
            None,
            [],
            "A: lateral is at least 500 N/mm and at most 0.8 of vertical, which asks for vertical at "
            "least 625 N/mm, but vertical is at most 200 N/mm; widen the bounds or the ratio limits",
        ),
        # Neither contradicts the vertical rate alone.
        (
            replace(LIMITED, bounds=(MountRates(1e5, 5e5, 1e4), MountRates(9e5, 9e5, 1e5))),
            None,
            [],
            "A: lateral is at least 500 N/mm and at most 0.8 of vertical, which asks for vertical at "
            "least 625 N/mm, but fore-aft is at most 100 N/mm and at least 0.25 of vertical, which "
            "asks for vertical at most 400 N/mm",
        ),
        (LIMITED, {"A": MountRates(8e5, 3e5, 0.0)}, [], "A fore-aft: rate: found 0 N/m, expected more"),
        (LIMITED, {"A": MountRates(0.0, 3e5, 3e5)}, [], "A vertical: rate: found 0 N/m, expected more"),
        (
            replace(LIMITED, bounds=(MountRates(1e5, 0.0, 1e5), BOUNDS[1])),
            None,
            [],
            "A lateral: softest: found 0 N/m, expected more than zero",
        ),
        (
            DesignGroup("B", bounds=BOUNDS, fixed_ratios=True),
            {"B": MountRates(1e6, 1e4, 1e6)},
            [],
            "B rates: no rate keeps the bounds of every direction at fixed ratios",
        ),
    ],
)
def test_a_space_without_designs_is_refused_with_the_rate(group, base, locked, words):
    with pytest.raises(VehicleError) as caught:
        design_space(
            mounted_cabin(), (group,), base, frozenset((group.group, field) for field in locked)
        )
    assert str(caught.value).startswith(words)


@pytest.mark.parametrize("kept", STIFFNESS_FIELDS)
def test_a_kept_rate_of_zero_limits_no_ratio(kept):
    base = {"A": replace(START, **{kept: 0.0})}
    space = design_space(mounted_cabin(), (LIMITED,), base, frozenset({("A", kept)}))
    limited = {limit.spoken.partition(":")[0] for limit in space.limits if "ratio" in limit.spoken}
    assert limited == {"vertical": set(), "lateral": {"A fore-aft"}, "fore_aft": {"A lateral"}}[kept]
    assert all(getattr(space.rates(x)["A"], kept) == 0 for x in space.samples(5, seed=1))


def test_a_rate_of_zero_that_nothing_changes_is_no_matter():
    base = {"A": MountRates(8e5, 0.0, 4e5), "B": MountRates(0.0, 0.0, 0.0)}
    space = design_space(mounted_cabin(), (DesignGroup("A", ("vertical",)),), base)
    assert space.rates(np.array([np.log(2.0)]))["A"].as_tuple() == pytest.approx((1.6e6, 0, 4e5))


def test_a_design_is_told_with_its_rates(of_cabin):
    x = np.zeros(of_cabin.n_variables)
    x[0], x[-1] = np.log(1.5), np.log(1.2)
    assert (
        of_cabin.spoken(x)
        == "A vertical 1200 N/mm, A lateral 300 N/mm, A fore-aft 400 N/mm, B rates × 1.2"
    )


def test_a_rate_whose_bounds_are_the_same_is_held_and_the_others_are_searched():
    """Also where ratio limits leave but one rate, and at fixed ratios."""
    soft, stiff = MountRates(1e5, 2e5, 1e5), MountRates(2e6, 2e5, 2e6)
    one = replace(LIMITED, bounds=(soft, stiff), ratio_limits=(0.4, 0.4))
    vertical = 2e5 / 0.4
    harder = scaled(START, 3.7)
    both = cabin_search(groups=(one, DesignGroup("B", bounds=(harder, harder), fixed_ratios=True)))
    for x in both.space.samples(5, 0):
        rates = both.space.rates(x)
        assert rates["A"].as_tuple() == pytest.approx((vertical, 2e5, 2e5), rel=1e-12)
        assert rates["B"].as_tuple() == pytest.approx(harder.as_tuple(), rel=1e-12)
    free = cabin_search(groups=(replace(one, ratio_limits=None), DesignGroup("B")))
    for optimum in (
        optimise(free, start_points(free, {}, 2)),
        search_globally(free, budget=300),
    ):
        assert optimum.rates["A"].lateral == pytest.approx(2e5, rel=1e-12)
        assert optimum.value < free.value(free.space.to_x({}))
        assert excess(free.space, optimum.x) < ROUNDING
