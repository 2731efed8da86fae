"""Sets of rates: pinned, compared, swapped, and as files."""

import pytest
from apps import SOLVE_S, open_solved_cabin
from mounted_cabin import mounted_cabin
from pages import wait_for, wait_until
from session_commands import Alter

from modeviz.files.rate_files import parse_rates, rates_text
from modeviz.vehicle.mount_rates import MountRates
from modeviz.viewer.page.wire.uploads import LARGEST_FILE
from modeviz.viewer.session.commands.decisions import AddVariant, Forget, Load, Pin, TakeRates
from modeviz.viewer.session.commands.looks import CompareWith, Overlay

TRIED = {"A": MountRates(4e5, 131.4e3, 4e5), "B": MountRates(8e5, 3e5, 4e5)}
ROWS = "Array.from(document.querySelectorAll('.mv .sets tr'), r => r.textContent)"
NOTICE = "Array.from(document.querySelectorAll('.mantine-Notification-root'), n => n.textContent)"


@pytest.fixture(scope="module")
def app(server):
    with open_solved_cabin(server) as app:
        yield app


@pytest.fixture(scope="module")
def page(app, server, open_page):
    page = open_page(server, viewport=(980, 760))
    page.get_by_role("tab", name="Variants").click()
    wait_for(page, f"{ROWS}.length === 3")
    return page


@pytest.fixture(autouse=True)
def original(app, page):
    """Every test starts with the vehicle's own rates and sets."""
    app.session.do(Load("Original"))
    app.session.do(Alter(variants={}, against="Original", overlaid=frozenset(), ghost="none"))
    assert app.session.wait(SOLVE_S)
    wait_for(page, f"{ROWS}.length === 3")


def press(page, name):
    page.get_by_role("button", name=name, exact=True).click()


def type_name(app, page, name):
    box = app.screen.controls.variants._name._box
    page.locator(".mantine-TextInput-input:visible").fill(name)
    wait_until(page, lambda: box.value == name)


def test_without_a_variant_it_says_what_to_do(page):
    wait_for(page, "document.body.textContent.includes('No variant yet: change a rate, then pin it.')")


def test_present_rates_are_pinned_under_the_name_typed_and_loaded_again(app, page):
    app.session.do(TakeRates(TRIED))
    wait_for(page, f"{ROWS}.at(-1).startsWith('not pinned')")
    type_name(app, page, "Softer front")
    press(page, "Pin")
    wait_for(page, f"{ROWS}.at(-1).startsWith('Softer front')")
    page.locator(".mv .sets label", has_text="Original").click()
    wait_until(page, lambda: app.session.state.design.rates == mounted_cabin().rates)
    page.locator(".mv .sets label", has_text="Softer front").click()
    wait_until(page, lambda: app.session.state.design.rates == TRIED)
    page.locator(".mv .sets label", has_text="×").click()
    wait_until(page, lambda: not app.session.state.design.variants)


def test_the_names_of_the_vehicles_own_sets_are_refused(app, page):
    type_name(app, page, "Soft")
    press(page, "Pin")
    wait_for(page, f"{NOTICE}.some(n => n.includes('one of the vehicle'))")
    assert not app.session.state.design.variants


def test_key_b_swaps_with_the_set_compared_with_and_back(app, page):
    app.session.do(Load("Soft"))
    soft = app.session.state.design.rates
    page.locator("canvas").first.focus()
    page.keyboard.press("b")
    wait_until(page, lambda: app.session.state.against == "Soft")
    assert app.session.state.design.rates == mounted_cabin().rates
    press(page, "A/B")
    wait_until(page, lambda: app.session.state.against == "Original")
    assert app.session.state.design.rates == soft


def test_another_set_is_compared_with_and_the_differences_are_listed(app, page):
    page.get_by_role("combobox", name="Compare with").click()
    page.get_by_role("option", name="Soft").click()
    wait_until(page, lambda: app.session.state.against == "Soft")
    wait_for(
        page, "document.querySelector('.mv .beside')?.textContent.includes('A vertical200800+300 %')"
    )


@pytest.mark.parametrize("file_format", ["csv", "json"])
def test_a_set_that_is_saved_and_read_again_is_the_same(app, page, tmp_path, file_format):
    app.session.do(TakeRates(TRIED))
    assert app.session.wait(SOLVE_S)
    with page.expect_download() as download:
        press(page, file_format.upper())
    assert download.value.suggested_filename == f"cabin-trial-1.{file_format}"
    text = download.value.path().read_text("utf-8")
    assert parse_rates(text, file_format, mounted_cabin()) == TRIED
    app.session.do(Load("Original"))
    path = tmp_path / f"My set.{file_format}"
    path.write_text(text, "utf-8")
    page.locator("input[type=file]").set_input_files(path)
    wait_until(page, lambda: "My set" in app.session.state.design.variants)
    assert app.session.state.design.variants["My set"].rates == TRIED
    assert app.session.state.design.rates == mounted_cabin().rates


def test_a_file_called_as_another_set_is_one_beside_it_and_says_so(app, page, tmp_path):
    app.session.do(Pin("My set"))
    path = tmp_path / "My set.csv"
    path.write_text(rates_text(TRIED, "csv"), "utf-8")
    page.locator("input[type=file]").set_input_files(path)
    wait_for(page, f"{NOTICE}.some(n => n.includes('so this is My set 2.'))")
    rates = {name: variant.rates for name, variant in app.session.state.design.variants.items()}
    assert rates == {"My set": mounted_cabin().rates, "My set 2": TRIED}


@pytest.mark.parametrize(
    ("name", "content", "complaint"),
    [
        ("wrong.csv", b"group,units\nA,N/mm\n", "expected the columns group, vertical"),
        ("wrong.json", b"\xff\xfe", "not a text in UTF-8"),
        ("wrong.png", b"", "expected a file of rates, .csv or .json"),
        ("large.csv", b" " * (LARGEST_FILE + 1), "expected a file of at most 1000 kB"),
    ],
)
def test_a_wrong_file_is_refused_in_one_sentence_and_changes_nothing(
    app, page, tmp_path, name, content, complaint
):
    path = tmp_path / name
    path.write_bytes(content)
    state = app.session.state
    page.locator("input[type=file]").set_input_files(path)
    wait_for(page, f"{NOTICE}.some(n => n.includes(a.complaint))", complaint=complaint)
    assert app.session.state is state


def test_the_colours_of_curves_stay_when_an_earlier_set_is_forgotten(app, page):
    marks = """Array.from(document.querySelectorAll('.mv .sets .mark'))
        .map(m => m.style.getPropertyValue('--mark'))"""
    app.session.do(Pin("First"))
    app.session.do(AddVariant("Second", TRIED))
    app.session.do(Overlay("Second", drawn=True))
    colors = wait_for(page, f"(m => m.length === 4 && m)({marks})")
    app.session.do(Forget("First"))
    wait_for(page, f"JSON.stringify({marks}) === JSON.stringify(a.left)", left=colors[:2] + colors[3:])
    keys = "Array.from(document.querySelectorAll('.mv .keyed .key'), k => k.innerHTML)"
    wait_for(page, f"{keys}.some(k => k.includes('Second') && k.includes(a.color))", color=colors[3])


def test_its_outlines_give_way_to_those_before(app, page):
    app.session.do(Alter(ghost="rest"))
    outlines = page.get_by_label("Its outlines")
    outlines.check()
    wait_until(page, lambda: app.session.state.look.ghost == "compared")
    outlines.uncheck()
    wait_until(page, lambda: app.session.state.look.ghost == "rest")


def test_a_set_without_an_answer_says_why_and_leaves_the_others_theirs(app, page):
    app.session.do(AddVariant("Rigid", {"A": MountRates(1e16, 1e16, 1e16)}))
    app.session.do(CompareWith("Rigid"))
    wait_for(page, f"{ROWS}.length === 4 && {ROWS}[3].startsWith('Rigid––––')")
    wait_for(page, "document.body.textContent.includes('Rigid has no answer: no accurate response')")
    wait_for(page, "document.body.textContent.includes('see Variants: compared with Original')")
