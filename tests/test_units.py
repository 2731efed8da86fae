"""Units against their definitions, and what people type."""

import math

import pytest

from modeviz.errors import ModevizError, unknown
from modeviz.units import UNITS, factor, parse, parse_number, psd_factor


@pytest.mark.parametrize(
    ("unit", "quantity", "expected"),
    [
        ("N/cm", "stiffness", 100.0),
        ("kN/mm", "stiffness", 1e6),
        ("lbf/in", "stiffness", 175.12683524647636),  # NIST SP 811 rounds it to 175.1268
        ("N m/deg", "rotational_stiffness", 180 / math.pi),
        ("lb", "mass", 0.45359237),
        ("lbf", "force", 4.4482216152605),
        ("oz in", "unbalance", 0.45359237 / 16 * 0.0254),
        ("kg mm²", "inertia", 1e-6),
        ("mph", "speed", 1609.344 / 3600),
        ("km/h", "speed", 1 / 3.6),
    ],
)
def test_unit_is_what_its_definition_says(unit, quantity, expected):
    assert factor(unit, quantity) == pytest.approx(expected, rel=1e-15)


@pytest.mark.parametrize(
    ("unit", "quantity", "root"),
    [
        ("mm²/Hz", "length", 1e-3),
        ("mm2 / hz", "length", 1e-3),
        ("in^2/Hz", "length", 0.0254),
        ("(m/s²)²/Hz", "acceleration", 1.0),
        ("(mm/s^2)^2/Hz", "acceleration", 1e-3),
        ("m²/s⁴/Hz", "acceleration", 1.0),
        ("m^2/s^4/Hz", "acceleration", 1.0),
        ("mm²/(s⁴ Hz)", "acceleration", 1e-3),
        ("m² s⁻⁴ Hz⁻¹", "acceleration", 1.0),
        ("g²/Hz", "acceleration", 9.80665),
        ("kN²/Hz", "force", 1e3),
    ],
)
def test_a_psd_has_the_square_of_its_unit(unit, quantity, root):
    assert psd_factor(unit, quantity) == pytest.approx(root**2, rel=1e-15)


@pytest.mark.parametrize("unit", ["m/s²/Hz", "m²/s⁴", "mm²/Hz", "g/√Hz", "(g)³/Hz", "", "²/Hz"])
def test_no_psd_of_an_acceleration_is_told_what_is(unit):
    words = r"expected one of \(m/s²\)²/Hz, \(mm/s²\)²/Hz, g²/Hz$"
    with pytest.raises(ModevizError, match=words):
        psd_factor(unit, "acceleration")


@pytest.mark.parametrize("quantity", UNITS)
def test_every_quantity_has_its_si_unit(quantity):
    assert 1.0 in UNITS[quantity].values()


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("131 N/mm", 131e3),
        ("131N/mm", 131e3),
        ("  +.5  kN/mm ", 5e5),
        ("1e3 N/m", 1e3),
        ("1.5E-1N/mm", 150.0),
        ("-3. N/m", -3.0),
    ],
)
def test_number_and_unit_are_read_as_people_write_them(text, expected):
    assert parse(text, "stiffness") == pytest.approx(expected, rel=1e-15)


@pytest.mark.parametrize(
    "text", ["", "N/mm", "nan N/mm", "inf N/mm", "1_0 N/mm", "1,5 N/mm", "1e N/mm"]
)
def test_what_is_no_number_with_a_unit_is_refused(text):
    with pytest.raises(ModevizError, match=r"expected a number and a unit of stiffness|unknown unit"):
        parse(text, "stiffness")


def test_number_without_a_unit_is_told_the_units():
    with pytest.raises(ModevizError, match=r"'131' without a unit, expected one of N/m, N/mm, N/cm"):
        parse("131", "stiffness")


def test_unit_of_another_quantity_is_told_the_right_ones():
    with pytest.raises(ModevizError, match=r"unknown unit of speed 'kg': there are m/s, km/h, mph"):
        parse("3 kg", "speed")


def test_overflowing_number_is_refused():
    with pytest.raises(ModevizError, match="finite"):
        parse("1e308 kN/mm", "stiffness")


def test_unknown_name_gets_the_likeliest_one_whatever_its_case():
    assert unknown("body", "CABB", ["frame", "cab"]) == (
        "unknown body 'CABB': did you mean 'cab'? there are frame, cab"
    )
    assert unknown("body", "x", []) == "unknown body 'x': there are none"


def test_a_number_has_no_unit():
    assert parse_number(" +.25 ") == 0.25
    assert parse_number("2e-1") == 0.2
    for text in ("0.2 N/mm", "20 %", "nan", "soft", "", "1_0"):
        with pytest.raises(ModevizError, match="expected a number without a unit"):
            parse_number(text)
    with pytest.raises(ModevizError, match="found '1e999', expected a finite number"):
        parse_number("1e999")
