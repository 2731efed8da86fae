"""The report's section on rates that depend on frequency."""

from dataclasses import replace

from dynamic_mounts import HYDRAULIC, OTHER_RATES, measured, on_mounts

from modeviz.analysis.preparation import prepare
from modeviz.report.comparison import RateSet, compare
from modeviz.report.html.rubber import rubber


def section_of(vehicle):
    sets = RateSet("drawn", {}), RateSet("stiff", {"E": OTHER_RATES})
    return rubber(compare(prepare(vehicle), *sets, None))


def test_what_varies_of_each_group_is_drawn_with_its_table():
    table = replace(measured(HYDRAULIC, 16), amplitude=1e-4)
    html = section_of(on_mounts(table))
    assert html.count("<h3>") == 2
    assert html.count("<figure>") == 4, "of a hydraulic mount the vertical rate alone"
    assert "E, vertical: Dynamic stiffness, N/mm" in html
    assert "at 0.1 mm" in html
    below = (table.frequency_hz > 0) & (table.frequency_hz <= 40)
    assert html.count("<circle") == 4 * below.sum()


def test_it_is_not_there_without_such_mounts():
    assert section_of(on_mounts(None)) == ""
