"""Which mounts ride best, and are they the paper's?

A. E. Duncan's program went down from the original rates and added up squared accelerations on a road
and under wheel loads as they are, g²/Hz and g². Here the same is done on the built-in pickup, and then
a search from twenty starts in which every load case counts by what it was. Which rates do they find,
beside the paper's Table 4, and what is gained?
"""

from dataclasses import replace

import modeviz as mv

vehicle = mv.read_vehicle(mv.builtin_vehicle())
problem = vehicle.problem("paper")
plain, normalised = (
    mv.prepare_search(
        vehicle, replace(problem, is_normalised=is_normalised), vehicle.rates, vehicle.speed
    )
    for is_normalised in (False, True)
)
downhill = mv.optimise(plain, mv.start_points(plain, vehicle.rates, n_starts=1))
best = mv.optimise(normalised, mv.start_points(normalised, vehicle.rates, n_starts=20, seed=0))

sets = {
    "original": vehicle.rates,
    "paper": vehicle.rate_sets["optimised"],
    "downhill": downhill.rates,
    "best of 20": best.rates,
}
prepared, conditions = mv.prepare(vehicle), mv.Conditions("road 1", vehicle.speed)
results = {name: mv.solve(prepared, rates, conditions) for name, rates in sets.items()}


def part(search: mv.Search, name: str) -> float:
    """What a sum is with a set of rates, as a part of what it was."""
    return search.goal.value(sets[name]) / search.goal.value({})


def gain(name: str) -> float:
    """Change of the mean personal rating on road 1."""
    before, after = (results[n].rating.mean_personal_rating for n in ("original", name))
    return after - before


def cab_yaw_hz(name: str) -> float:
    """Natural frequency of the mode that bears the name."""
    return float(results[name].modes.frequency_hz[results[name].mode_index("cab yaw")])


if __name__ == "__main__":
    print(f"{'Rates, N/mm':22}" + "".join(f"{name:>12}" for name in sets))
    for variable in mv.rate_variables(vehicle):
        row = [getattr(rates[variable.group], variable.direction) / 1e3 for rates in sets.values()]
        name = f"{variable.group} {variable.direction.replace('_', '-')}"
        print(f"{name:22}" + "".join(f"{rate:12.0f}" for rate in row))
    for title, number in (
        ("plain sum", lambda name: part(plain, name)),
        ("normalised sum", lambda name: part(normalised, name)),
        ("rating gained", gain),
        ("cab yaw, Hz", cab_yaw_hz),
    ):
        print(f"{title:22}" + "".join(f"{number(name):12.3f}" for name in sets))
    dearest = best.active[0]
    print(f"relaxing “{dearest.name}” by a tenth would take off another {dearest.gain:.1%}")
