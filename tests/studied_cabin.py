"""A study of the small cabin with a problem, whose searches take no time."""

from dataclasses import replace

from cabin_problem import PROBLEM
from mounted_cabin import mounted_cabin

from modeviz.study.study import Study


def cabin_study(**changes) -> Study:
    """The cabin with a problem of its own, as a vehicle that differs so."""
    return Study(replace(mounted_cabin(), **{"problems": (PROBLEM,), **changes}))
