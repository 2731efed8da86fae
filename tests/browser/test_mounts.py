"""The mounts panel, used as an engineer would, on the small cabin."""

import numpy as np
import pytest
from apps import open_app
from mount_controls import DIRECTIONS, IS_OPEN, box, drag, open_folder, position, thumb, type_rate
from mounted_cabin import mounted_cabin
from pages import CLOSE_NOTICES, wait_for, wait_until
from session_commands import Alter
from viser.transforms import SO3

from modeviz.analysis.results import Conditions
from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.modes import solve_modes
from modeviz.units import WRITTEN_UNITS
from modeviz.vehicle.alterations import Alterations, altered
from modeviz.vehicle.mount_rates import STIFFNESS_FIELDS
from modeviz.viewer.session.commands.decisions import Load, SetRate

SOLVE_S = 60
REFUSED = "document.body.textContent.includes('expected 0 to 1000000 N/mm')"
ALL_TO_THE_END = """(group) => {
  const marker = document.querySelector(`.mv-rates[data-group="${group}"]`);
  const thumbs = marker.closest(".mantine-Paper-root").querySelectorAll(".mantine-Slider-thumb");
  for (const thumb of [...thumbs].slice(0, 3))
    for (const key of ["ArrowLeft", "ArrowLeft", "End"])
      thumb.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true }));
}"""


@pytest.fixture(scope="module")
def app(server):
    with open_app(server, mounted_cabin(), Conditions("flat", 20.0)) as app:
        app.start()
        yield app


@pytest.fixture(scope="module")
def page(app, server, open_page):
    page = open_page(server, viewport=(980, 640))
    wait_for(page, "document.querySelectorAll('.mv-rates').length === 2")
    page.evaluate(CLOSE_NOTICES)
    return page


@pytest.fixture(autouse=True)
def original(app, page):
    """Every test starts with the original rates, nothing locked or linked, the first group selected."""
    app.session.do(
        Alter(
            rates=app.session.vehicle.rates,
            locked=frozenset(),
            linked=frozenset(),
            units=dict(WRITTEN_UNITS),
            group="A",
        )
    )
    assert app.session.wait(SOLVE_S)
    wait_for(page, "document.querySelector('.mv-selected').dataset.group === 'A'")
    for group in "AB":
        open_folder(page, group)
        wait_until(page, lambda g=group: box(page, g, "vertical").input_value() == "800")


def rate(app, group, field):
    return getattr(app.session.state.design.rates[group], field)


def text(page, group):
    """All that is written in the folder of a group."""
    return page.locator(
        f'.mantine-Paper-root[data-with-border]:has(.mv-rates[data-group="{group}"])'
    ).inner_text()


def test_a_dragged_slider_moves_rate_number_and_label(app, page):
    slider = thumb(page, "A", "vertical")
    start = position(slider)
    drag(page, slider, start + 41)
    stiffer = 1e4 * 1000 ** ((start + 41) / 695)  # from 10 to 10 000 N/mm in steps of 1 %
    wait_until(page, lambda: rate(app, "A", "vertical") == pytest.approx(stiffer, rel=5e-4))
    number = f"{rate(app, 'A', 'vertical') / 1e3:g}"
    wait_until(page, lambda: box(page, "A", "vertical").input_value() == number)
    wait_until(page, lambda: "Vertical +50 %" in text(page, "A").replace("  ", " "))


def test_back_at_the_mark_a_slider_gives_exactly_the_original_rate(app, page):
    slider = thumb(page, "A", "vertical")
    start = position(slider)
    drag(page, slider, start - 30)
    wait_until(page, lambda: rate(app, "A", "vertical") < 7e5)
    drag(page, slider, start)
    wait_until(page, lambda: rate(app, "A", "vertical") == 8e5)


def test_sliders_that_move_at_the_same_time_are_all_heard(app, page):
    for direction in DIRECTIONS:
        thumb(page, "A", direction).wait_for()
    page.evaluate(ALL_TO_THE_END, "A")
    wait_until(page, lambda: [rate(app, "A", field) for field in STIFFNESS_FIELDS] == [1e7, 1e7, 1e7])


def test_a_number_with_decimals_is_taken_in_full_and_undone_at_once(app, page):
    type_rate(page, "B", "lateral", "131.4")
    wait_until(page, lambda: rate(app, "B", "lateral") == 131.4e3)
    assert box(page, "B", "lateral").input_value() == "131.4"
    wait_until(page, lambda: app.session.wait(SOLVE_S) and position(thumb(page, "B", "lateral")) < 300)
    page.get_by_role("button", name="Undo", exact=True).click()
    wait_until(page, lambda: box(page, "B", "lateral").input_value() == "300")
    assert rate(app, "B", "lateral") == 3e5
    page.get_by_role("button", name="Redo", exact=True).click()
    wait_until(page, lambda: box(page, "B", "lateral").input_value() == "131.4")


def test_undo_and_redo_have_hot_keys(app, page):
    type_rate(page, "A", "lateral", "250")
    wait_until(page, lambda: rate(app, "A", "lateral") == 2.5e5)
    page.keyboard.press("Control+z")
    wait_until(page, lambda: rate(app, "A", "lateral") == 3e5)
    page.keyboard.press("Control+Shift+z")
    wait_until(page, lambda: rate(app, "A", "lateral") == 2.5e5)


def test_a_removed_mount_and_a_rigid_one_are_taken_with_the_slider_at_its_ends(app, page):
    slider = thumb(page, "A", "fore-aft")
    type_rate(page, "A", "fore-aft", "0")
    wait_until(page, lambda: rate(app, "A", "fore_aft") == 0 and position(slider) == 0)
    type_rate(page, "A", "fore-aft", "1000000")
    end = int(slider.get_attribute("aria-valuemax"))
    wait_until(page, lambda: rate(app, "A", "fore_aft") == 1e9 and position(slider) == end)


@pytest.mark.parametrize("keys", [["Delete"], ["a", "b", "c"]])
def test_a_number_box_left_without_a_number_says_it_again(app, page, keys):
    number = box(page, "A", "vertical")
    number.scroll_into_view_if_needed()
    number.click()
    number.press("ControlOrMeta+a")
    for key in keys:
        number.press(key)
    assert not number.input_value()
    number.blur()
    wait_until(page, lambda: number.input_value() == "800")
    assert rate(app, "A", "vertical") == 8e5


@pytest.mark.parametrize("typed", ["-50", "2000000"])
def test_what_no_rate_can_be_is_refused_once_and_put_back(app, page, typed):
    type_rate(page, "A", "vertical", typed)
    wait_for(page, REFUSED)
    wait_until(page, lambda: box(page, "A", "vertical").input_value() == "800")
    assert rate(app, "A", "vertical") == 8e5
    assert page.get_by_text("expected 0 to 1000000 N/mm").count() == 1
    page.evaluate(CLOSE_NOTICES)
    wait_for(page, f"!{REFUSED}")


def test_a_locked_rate_stays_while_a_loaded_set_moves_it(app, page):
    page.locator(".effects label").first.click()
    wait_until(page, lambda: app.session.state.design.locked == {("A", "vertical")})
    wait_until(page, lambda: box(page, "A", "vertical").is_disabled())
    app.session.do(SetRate("A", "vertical", 1e6))
    app.session.do(SetRate("A", "lateral", 1e5))
    wait_until(page, lambda: box(page, "A", "lateral").input_value() == "100")
    assert rate(app, "A", "vertical") == 8e5
    app.session.do(Load("Soft"))
    wait_until(page, lambda: box(page, "A", "vertical").input_value() == "200")
    assert box(page, "A", "vertical").is_disabled()


def test_linked_rates_keep_their_ratios(app, page):
    page.get_by_label("Keep ratios").first.check()
    wait_until(page, lambda: app.session.state.design.linked == {"A"})
    type_rate(page, "A", "vertical", "400")
    wait_until(page, lambda: box(page, "A", "lateral").input_value() == "150")
    wait_until(page, lambda: box(page, "A", "fore-aft").input_value() == "200")


def test_another_unit_changes_every_number_and_no_rate(app, page):
    before = app.session.state.design.rates
    page.get_by_role("combobox", name="Rates in").click()
    page.get_by_role("option", name="N/cm").click()
    wait_until(page, lambda: box(page, "B", "lateral").input_value() == "3000")
    assert app.session.state.design.rates == before
    type_rate(page, "B", "lateral", "1314")
    wait_until(page, lambda: rate(app, "B", "lateral") == 131.4e3)


def test_one_rate_a_group_and_all_go_back(app, page):
    for group, direction in (("A", "vertical"), ("A", "lateral"), ("B", "vertical"), ("A", "fore-aft")):
        type_rate(page, group, direction, "500")
        field = direction.replace("-", "_")
        wait_until(page, lambda g=group, f=field: rate(app, g, f) == 5e5)
    page.get_by_title("Back to Original", exact=True).first.click()
    wait_until(page, lambda: rate(app, "A", "vertical") == 8e5)
    assert rate(app, "A", "lateral") == rate(app, "B", "vertical") == 5e5
    page.get_by_role("button", name="Reset group", exact=True).click()
    wait_until(page, lambda: rate(app, "A", "lateral") == 3e5)
    assert rate(app, "B", "vertical") == 5e5
    page.get_by_role("button", name="Reset all", exact=True).click()
    wait_until(page, lambda: app.session.state.design.rates == dict(app.session.vehicle.rates))


def test_a_click_on_a_mount_opens_its_folder(app, page):
    for group in "AB":
        page.evaluate(
            """(group) => document.querySelector(`.mv-rates[data-group="${group}"]`)
                .closest(".mantine-Paper-root").firstElementChild.click()""",
            group,
        )
        wait_for(page, f"!({IS_OPEN})(a.group)", group=group)
    app._select("B")
    wait_for(page, f"({IS_OPEN})('B')")
    assert app.session.state.group == "B"
    wait_until(page, lambda: "Keep ratios" in text(page, "B"))
    assert not page.evaluate(IS_OPEN, "A")


def test_a_click_on_a_mount_brings_the_mounts_up_from_another_tab(app, page):
    page.get_by_role("tab", name="View").click()
    wait_for(page, "!document.querySelector('.mv-rates')?.offsetParent")
    app._select("A")
    wait_for(page, f"({IS_OPEN})('A')")


def test_the_table_says_what_ten_percent_do_and_is_dimmed_while_that_is_old(app, page):
    assert app.session.wait_checked(SOLVE_S)
    wait_for(page, "document.querySelector('.effects:not(.old)')?.textContent.includes(' Hz')")
    assert " %" in page.locator(".effects").first.inner_text()


def test_the_loss_factor_of_a_group_is_its_own(app, page):
    number = page.locator(".mantine-Slider-root + div input >> visible=true").nth(0)
    wait_until(page, lambda: number.input_value() == "0.15")
    number.fill("0.2")
    wait_until(page, lambda: rate(app, "A", "loss_factor") == 0.2)
    assert rate(app, "B", "loss_factor") is None
    page.get_by_role("button", name="Reset group", exact=True).click()
    wait_until(page, lambda: rate(app, "A", "loss_factor") is None)


def test_mounts_that_are_turned_give_what_a_vehicle_with_such_mounts_gives(app, page):
    """Typed on the page; frequencies and the marker's axes are those of a fresh solve, until undone."""
    before = app.session.answer.now.modes.frequency_hz
    page.get_by_text("Place", exact=True).locator("visible=true").click()
    number = page.locator(".mantine-Slider-root + div input >> visible=true").nth(1)
    wait_until(page, lambda: number.input_value() == "0")
    number.fill("30")
    wait_until(
        page,
        lambda: (
            app.session.state.design.alterations.placement("A").angles[0]
            == pytest.approx(np.radians(30))
        ),
    )
    assert app.session.wait(SOLVE_S)
    turned = altered(mounted_cabin(), app.session.state.design.alterations)
    fresh = solve_modes(assemble(turned), below_hz=20.0).frequency_hz
    found = app.session.answer.now.modes.frequency_hz[: len(fresh)]
    assert found == pytest.approx(fresh, rel=1e-9)
    marker, mount = app.scene._markers._mounts["A"][0], turned.mount_group("A").mounts[0]
    wait_until(page, lambda: np.allclose(marker._frame.wxyz, SO3.from_matrix(mount.axes.T).wxyz))
    page.get_by_role("button", name="Undo", exact=True).click()
    wait_until(page, lambda: app.session.state.design.alterations == Alterations())
    assert app.session.wait(SOLVE_S)
    assert app.session.answer.now.modes.frequency_hz == pytest.approx(before, rel=1e-9)


def test_controls_that_have_nothing_to_do_look_so(app, page):
    idle = "document.querySelector('.mv-history').dataset.idle"
    wait_for(page, f"{idle}.includes('group') && {idle}.includes('all')")
    button = page.get_by_role("button", name="Reset all", exact=True)
    assert float(button.evaluate("(b) => getComputedStyle(b).opacity")) < 0.5
    app.session.do(SetRate("B", "lateral", 1e5))
    wait_for(page, f"!{idle}.includes('all') && !{idle}.includes('group')")
    wait_until(page, lambda: button.evaluate("(b) => getComputedStyle(b).opacity") == "1")


def test_the_page_keeps_its_looks_when_the_card_is_put_away(app, page):
    mark = "getComputedStyle(document.documentElement).getPropertyValue('--mv-good')"
    page.get_by_label("Minimize panel", exact=True).click()
    wait_for(page, "!document.querySelector('.mv .title')?.offsetParent")
    assert page.evaluate(mark)
    page.get_by_label("Expand panel", exact=True).click()
    wait_for(page, "document.querySelector('.mv .title')?.offsetParent")
