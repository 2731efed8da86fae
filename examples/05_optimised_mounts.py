"""Which mounts ride best, and are they the paper's?

A. E. Duncan's program went down from the original rates and added up squared accelerations on a road
and under wheel loads as they are, g²/Hz and g². Here the same is done on the built-in pickup, and then
a search from twenty starts in which every load case counts by what it was. Which rates do they find,
beside the paper's Table 4, and what is gained?
"""

from dataclasses import replace

import modeviz as mv

study = mv.Study()
problem = study.vehicle.problem("paper")
downhill = study.optimise(replace(problem, is_normalised=False), starts=1)
best = study.optimise(problem, starts=20, seed=0)

sets = {
    "original": study.vehicle.rates,
    "paper": study.vehicle.rate_sets["optimised"],
    "downhill": downhill.rates,
    "best of 20": best.rates,
}
cab_yaw_hz, rating = {}, {}
for name, rates in sets.items():
    study.rates.use(rates)
    cab_yaw_hz[name] = study.modes()["cab yaw"].frequency_hz
    rating[name] = study.ride("road 1").rating.mean_personal_rating


def part(found: mv.OptimiseResult, name: str) -> float:
    """What an objective is with a set of rates, as a part of what it was."""
    return found.objective(sets[name]) / found.original


if __name__ == "__main__":
    print(f"{'Rates, N/mm':22}" + "".join(f"{name:>12}" for name in sets))
    for group in study.vehicle.mount_groups:
        for direction in ("vertical", "lateral", "fore_aft"):
            row = [getattr(rates[group.name], direction) / 1e3 for rates in sets.values()]
            print(f"{group.name + ' ' + direction:22}" + "".join(f"{rate:12.0f}" for rate in row))
    for title, number in (
        ("plain sum", lambda name: part(downhill, name)),
        ("normalised sum", lambda name: part(best, name)),
        ("rating gained", lambda name: rating[name] - rating["original"]),
        ("cab yaw, Hz", cab_yaw_hz.__getitem__),
    ):
        print(f"{title:22}" + "".join(f"{number(name):12.3f}" for name in sets))
    dearest = best.limits[0]
    print(f"relaxing “{dearest.name}” by a tenth would take off another {dearest.gain:.1%}")
