"""The whole page on the built-in pickup, used as an engineer would."""

import re
from itertools import pairwise

import numpy as np
import pytest
from apps import listening, n_bytes, open_app
from builtin_truck import builtin_truck, truck_modes
from charts import at_lines, has_lines
from mount_controls import box, drag, open_folder, position, thumb, type_rate
from pages import CLOSE_NOTICES, has_beside, send, wait_for, wait_until
from session_commands import Alter, Become
from shared_preparations import shared_preparations

from modeviz.analysis.exact_check import Check, check_exactly
from modeviz.analysis.modal_results import solve_modal
from modeviz.analysis.results import Conditions
from modeviz.text.wording import sentence_case
from modeviz.viewer.scene import stage
from modeviz.viewer.session import inquiry
from modeviz.viewer.session.commands.decisions import Pin, SetRate

GROUPS = ("F", "C1", "C2", "E", "T")
CAB = "/vehicle/cab"
SOLVE_S = 300
SINGLE_DB = 2.0**-18  # how far 128 dB are rounded in single precision

CHARTS = "Object.values(window.__viserTestpoints?.uplots ?? {})"
CURRENT = f"{CHARTS}.map((c) => [Array.from(c.chart.data[0]), Array.from(c.chart.data[2])])"
SHAPE = """
(() => {
  let found = null;
  window.__viserMutable.nodeRefFromName[a.name]?.traverse((object) => {
    found ??= object.geometry?.attributes?.modevizReal?.array;
  });
  return found && Array.from(found);
})()
"""
CHANGED = f"(now => now?.length === a.before.length && now.some((x, i) => x !== a.before[i]))({SHAPE})"
IN_PICTURE = """a.corners.every((corner) => {
  const { camera, nodeRefFromName } = window.__viserMutable;
  const place = nodeRefFromName["/vehicle"]?.localToWorld(camera.position.clone().set(...corner));
  const { x, y } = place?.project(camera) ?? {};
  return Math.abs(x) < 1 && Math.abs(y) < 1;
})"""
TITLE = "document.querySelector('.mv .title')?.textContent"


@pytest.fixture(scope="module", autouse=True)
def prepared_once():
    with shared_preparations():
        yield


@pytest.fixture(scope="module")
def app(server):
    """The truck's page; its answers are not checked, which takes seconds each time."""
    vehicle = builtin_truck()
    with pytest.MonkeyPatch.context() as patch:
        checked = Check(frequency_error=0.0, psd_error=0.0, n_lines=1, n_freqs=1)
        patch.setattr(inquiry, "check_exactly", lambda results: iter([checked]))
        with open_app(server, vehicle, Conditions("road 1", vehicle.speed)) as app:
            app.start()
            yield app


@pytest.fixture(scope="module")
def page(app, server, open_page):
    page = open_page(server, viewport=(980, 640))  # a narrow scene between the panels: drawn fast
    wait_for(page, "document.querySelectorAll('.mv-rates').length === 5")
    wait_for(page, f"{CHARTS}.length === 2 && {TITLE}")
    wait_for(page, SHAPE, name=CAB)
    page.evaluate(CLOSE_NOTICES)
    return page


@pytest.fixture(autouse=True)
def original(app, page):
    """Every test starts with the original rates solved and shown."""
    app.session.do(
        Alter(rates=app.session.vehicle.rates, mode="cab yaw", conditions=Conditions("road 1", 20.0))
    )
    assert app.session.wait(SOLVE_S)
    wait_for(page, f"{TITLE}?.startsWith(a.title)", title=title(app, "cab yaw"))


def title(app, name, rates=None):
    """How the card should be headed when the mode of that name is shown."""
    results = solve_modal(truck_modes(), rates or {})
    mode = results.mode_index(name)
    f, spoken = results.modes.frequency_hz[mode], results.names[mode].spoken
    return f"{sentence_case(spoken)}  {f:.2f} Hz"


def assert_drawn(drawn, record, direction):
    """Holds a curve of the driver's point, lines and levels, against a printed record."""
    (response,) = [
        r for r in record["responses"] if (r["point"], r["direction"]) == ("seat track left", direction)
    ]
    f, db = record["frequency_hz"], 10 * np.log10(response["psd_g2_per_hz"])
    assert has_lines(drawn[0], f)
    np.testing.assert_allclose(*at_lines(*drawn, f, db), atol=SINGLE_DB)


def difference(before, after):
    """How far two curves, lines and levels, are apart at most, dB."""
    return np.abs(np.interp(before[0], *after) - before[1]).max()


def test_dragged_rates_give_what_the_command_line_prints(app, page, printed_json):
    charts, shape = page.evaluate(CURRENT), page.evaluate(f"a => {SHAPE}", {"name": CAB})
    assert box(page, "C2", "lateral").input_value() == "294"
    open_folder(page, "C2")
    drag(page, thumb(page, "C2", "lateral"), 60)
    open_folder(page, "F")
    type_rate(page, "F", "fore-aft", "130")
    wait_until(page, lambda: app.session.state.design.rates["F"].fore_aft == 130e3)
    dragged = app.session.state.design.rates["C2"].lateral
    assert 100e3 < dragged < 150e3

    settings = "--set", f"C2.lateral={dragged} N/m", "--set", "F.fore-aft=130 N/mm"
    modes = printed_json("modes", *settings)["modes"]
    (yaw,) = [m["frequency_hz"] for m in modes if m["name"] == "cab yaw"]
    wait_for(page, f"{TITLE}.includes(a.title)", title=f"ab yaw  {yaw:.2f} Hz")
    assert yaw < 11.3

    record = printed_json("psd", *settings)
    for drawn, before, direction in zip(
        page.evaluate(CURRENT), charts, ("lateral", "vertical"), strict=True
    ):
        assert_drawn(drawn, record, direction)
        assert difference(before, drawn) > 1.0

    wait_for(page, CHANGED, name=CAB, before=shape)


def test_mode_and_spectra_follow_while_the_slider_moves(page):
    open_folder(page, "C2")
    slider = thumb(page, "C2", "lateral")
    slider.scroll_into_view_if_needed()
    handle, titles = slider.bounding_box(), [page.evaluate(TITLE)]
    charts = [page.evaluate(CURRENT)]
    x, y = handle["x"] + handle["width"] / 2, handle["y"] + handle["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    for step in range(1, 4):
        page.mouse.move(x - 5 * step, y)
        titles.append(wait_for(page, f"{TITLE} !== a.last && {TITLE}", last=titles[-1]))
        changed = f"JSON.stringify({CURRENT}) !== JSON.stringify(a.last) && {CURRENT}"
        charts.append(wait_for(page, changed, last=charts[-1]))
    page.mouse.up()
    frequencies = [float(t.split()[2]) for t in titles]
    assert frequencies == sorted(frequencies, reverse=True)
    for before, after in pairwise(charts):
        assert max(difference(*both) for both in zip(before, after, strict=True)) > 0.01


def test_optimised_rates_come_and_go_with_a_click(app, page):
    optimised = app.session.vehicle.rate_sets["optimised"]
    page.get_by_role("tab", name="Variants").click()
    page.locator(".mv .sets label", has_text="Optimised").click()
    wait_for(page, f"{TITLE}.startsWith(a.title)", title=title(app, "cab yaw", optimised))
    page.get_by_role("tab", name="Mounts").click()
    wait_until(page, lambda: box(page, "C1", "vertical").input_value() == "2100")
    page.get_by_role("button", name="Reset all", exact=True).click()
    wait_for(page, f"{TITLE}.startsWith(a.title)", title=title(app, "cab yaw"))
    wait_until(page, lambda: box(page, "C1", "vertical").input_value() == "1094")


def test_a_click_in_the_mode_table_shows_that_mode(app, page):
    before = page.evaluate(f"a => {SHAPE}", {"name": CAB})
    page.locator(".mv td label", has_text="First torsion").click()
    wait_for(page, f"{TITLE}.startsWith(a.title)", title=title(app, "first torsion"))
    wait_for(page, CHANGED, name=CAB, before=before)


def test_a_click_on_a_peaks_contributor_shows_that_mode(app, page):
    page.locator(".mv .pill label", has_text=re.compile(r"^First torsion")).first.click()
    wait_for(page, f"{TITLE}.startsWith(a.title)", title=title(app, "first torsion"))
    shares = app.session.answer.strain
    assert app.session.state.group == max(GROUPS, key=lambda group: shares[group])


def test_a_file_that_is_dropped_does_not_take_the_place_of_the_page(page):
    assert page.evaluate(
        """() => ["dragover", "drop"].map((kind) => {
            const carrier = new DataTransfer();
            carrier.items.add(new File(["x"], "run.op2"));
            const event = { dataTransfer: carrier, bubbles: true, cancelable: true };
            return document.querySelector("canvas").dispatchEvent(new DragEvent(kind, event));
        })"""
    ) == [False, False]


def test_what_a_page_loses_is_put_back(app, page):
    """viser throttles all widgets with one timer; the server's value must reach the screen."""
    row = app.screen.controls.mounts._folders["C2"]._rows["lateral"]
    send(page, row._slider, 100)
    # The page itself still draws the old value, as after a lost message; then it gets the server's.
    wait_until(page, lambda: position(thumb(page, "C2", "lateral")) == 100)
    assert app.session.wait(SOLVE_S)
    assert app.session.state.design.rates["C2"].lateral == row._travel.rate(100, 294e3)


def test_another_road_is_solved(page, printed_json):
    page.get_by_role("tab", name="Road").click()
    page.get_by_role("combobox", name="Road").click()
    page.get_by_role("option", name="Road 2").click()
    page.get_by_role("tab", name="Response").click()
    wait_for(page, "document.body.textContent.includes('Road 2, 72 km/h')")
    record = printed_json("psd", "--road", "road 2")
    wait_for(page, f"{CHARTS}.length === 2")
    assert_drawn(page.evaluate(CURRENT)[0], record, "lateral")


COMPARED = {"ghost": "compared", "overlaid": frozenset({"Optimised", "Pinned"}), "classic": True}
OPERATING = {"kind": "operating shape", "operating_hz": 40.0, **COMPARED}


@pytest.mark.parametrize(
    "switches",
    [
        {},
        {"kind": "damped mode", "coloring": "displacement", **COMPARED},
        {"coloring": "strain energy", **OPERATING},
        {"coloring": "kinetic energy", "load": "front left radial force", **OPERATING},
        {"kind": "sag", "load_case": "braking 1 g", "coloring": "displacement", **COMPARED},
    ],
    ids=["plain", "damped", "operating", "wheel", "sag"],
)
def test_a_move_of_a_slider_sends_less_than_200_kb_whatever_is_drawn(
    app, server, monkeypatch, switches
):
    """What an exact check sends, which is how far it is, is the same whatever is drawn: once here."""
    before = app.session.state
    app.session.do(Pin("Pinned"))
    app.session.do(Alter(**switches))
    assert app.session.wait_checked(SOLVE_S)
    with listening(server) as socket:
        if not switches:
            monkeypatch.setattr(inquiry, "check_exactly", check_exactly)
        app.session.do(SetRate("C2", "lateral", 250e3))
        assert app.session.wait_checked(SOLVE_S)
        sent = n_bytes(socket)
    app.session.do(Become(before))
    assert 20_000 < sent < 200_000


def test_the_motion_plays_and_stops_with_a_click(app, page):
    driver = app.scene.driver
    page.get_by_role("button", name="Play", exact=True).click()
    wait_until(page, lambda: driver._running)
    page.get_by_role("button", name="Pause", exact=True).click()
    wait_until(page, lambda: not driver._running)
    page.get_by_role("button", name="Play", exact=True).click()
    wait_until(page, lambda: driver._running)
    app.screen.motion.animation._run(False)


def test_a_fine_screen_is_as_large_as_a_coarse_one(app, server, open_page):
    known = set(server.get_clients())
    fine = open_page(server, viewport=(1280, 400), query="", scale=2)
    wait_until(fine, lambda: has_beside(fine, 1280 - 300 - 380))
    (number,) = set(server.get_clients()) - known
    camera = server.get_clients()[number].camera
    size = fine.evaluate("(({ clientWidth: w, clientHeight: h }) => [w, h])(__viserMutable.canvas)")
    wait_until(fine, lambda: [camera.image_width, camera.image_height] == size)
    wait_for(fine, IN_PICTURE, corners=stage.box(app.session.vehicle).corners.tolist())
    fine.context.close()
