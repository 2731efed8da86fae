"""Property files of bushings, as Adams Car and Altair's manual have them."""

import numpy as np
import pytest

from modeviz.cli import main
from modeviz.errors import VehicleError
from modeviz.files import read_vehicle
from modeviz.formats.mounts.property_file import read_property
from modeviz.units import POUND, STANDARD_GRAVITY

ADAMS = """$------------------------------------------------MDI_HEADER
[MDI_HEADER]
 FILE_TYPE     =  'bus'
 FILE_VERSION  =  4.0
 FILE_FORMAT   =  'ASCII'
(COMMENTS)
{comment_string}
'front mount'
$------------------------------------------------UNITS
[UNITS]
 LENGTH  =  'mm'
 ANGLE   =  'degrees'
 FORCE   =  'newton'
 MASS    =  'kg'
 TIME    =  'second'
$------------------------------------------------DAMPING
[DAMPING]
 FX_DAMPING  =  0.5
 FY_DAMPING  =  0.6
 FZ_DAMPING  =  0.7
 TX_DAMPING  =  10
 TY_DAMPING  =  20
 TZ_DAMPING  =  30
"""
SLOPES = {"FX": 1000.0, "FY": 750.5, "FZ": 2e3, "TX": 50.0, "TY": 60.0, "TZ": 0.0}


def curve(name, slope):
    lines = [f" {x:.1f}  {slope * x:.3E}" for x in (-10.0, -1.0, 0.0, 2.5, 10.0)]
    return "\n".join([f"[{name}_CURVE]", f"{{   {name[1].lower()}   {name.lower()} }}", *lines, ""])


def adams(**slopes):
    return ADAMS + "".join(curve(name, slope) for name, slope in (SLOPES | slopes).items())


ALTAIR = """$---------------------------------------------------------- HEADER
[HEADER]
FILE_TYPE     = 'gbs'
FILE_VERSION  = '1.1'
FILE_FORMAT   = 'ASCII'
$---------------------------------------------------------- UNITS
[UNITS]
(BASE)
{ length force angle mass time }
LENGTH = 'meter'
FORCE  = 'pound_force'
ANGLE  = 'radians'
MASS   = 'kg'
TIME   = 'sec'
[DIRECTIONS]
(ACTIVITY)
{ formulation             FX FY FZ TX TY TZ }
'SPLINE_STIFFNESS'         0  1  0  0  0  0
'CUBIC_STIFFNESS'          0  0  0  0  0  0
'CONSTANT_STIFFNESS'       1  0  1  1  0  0
'CONSTANT_DAMPING'         0  0  1  0  0  0
'RUBBER_DAMPING'           0  0  0  0  0  0
'HYDROMOUNT_DAMPING'       0  0  0  0  0  0
[CONSTANT_STIFFNESS_FX]
K = 6000.0
[CONSTANT_STIFFNESS_FZ]
K = 7000.0
[CONSTANT_STIFFNESS_TX]
K = 8.0D1
[CONSTANT_DAMPING_FZ]
C = 600.0
[SPLINE_STIFFNESS_FY]
(SPLINE_DATA)
{  disp       force  }
   -4.48   -448
    0.83     83
    4.47    447
[CUBIC_STIFFNESS_FX]
K1 = 5
"""


@pytest.fixture
def read(tmp_path):
    def read(text, name="c.bus"):
        (tmp_path / name).write_text(text)
        return read_property(tmp_path / name)

    return read


def test_a_bus_file_has_the_slopes_of_its_curves_and_its_dampings(read):
    found = read(adams())
    per_degree = 180 / np.pi / 1000  # N mm/deg in N m/rad
    expected = np.array(list(SLOPES.values())) * [*[1000] * 3, *[per_degree] * 3]
    np.testing.assert_allclose(found.stiffness, expected)
    np.testing.assert_allclose(
        found.damping, [500, 600, 700, 10 * per_degree, 20 * per_degree, 30 * per_degree]
    )


def test_dampings_are_in_the_times_of_their_file(read):
    found = read(adams().replace("'second'", "'millisecond'"))
    np.testing.assert_allclose(found.damping[:3], [0.5, 0.6, 0.7])


def test_a_gbs_file_has_the_rates_of_its_active_formulations(read):
    found = read(ALTAIR, "c.gbs")
    np.testing.assert_allclose(
        found.stiffness, np.array([6000, 100, 7000, 80, 0, 0]) * POUND * STANDARD_GRAVITY
    )
    np.testing.assert_allclose(found.damping, np.array([0, 0, 600, 0, 0, 0]) * POUND * STANDARD_GRAVITY)


@pytest.mark.parametrize(
    ("name", "text", "expected"),
    [
        ("c.bus", "", "without \\[UNITS\\]"),
        ("c.bus", ADAMS, "expected \\[DAMPING\\] and \\[FX_CURVE\\]"),
        ("c.bus", adams().replace("'mm'", "'smoot'"), "\\[UNITS\\] LENGTH: found 'smoot'"),
        ("c.bus", adams(FX=-5.0), "FX: found a stiffness of -5"),
        ("c.bus", adams().replace("FZ_DAMPING", "F_DAMPING"), "\\[DAMPING\\] FZ_DAMPING: missing"),
        ("c.bus", adams().replace(" 2.5  2.500E+03", " 2.5  9.9E+03"), "is no straight line"),
        ("c.bus", adams().replace(" 2.5  2.500E+03", " 2.5"), "expected a deflection and a force"),
        ("c.bus", adams().replace(" 2.5  2.500E+03", " -2.5 1"), "rising deflections"),
        ("c.bus", adams().replace(" 2.5  2.500E+03", " nan 1"), "found 'nan', expected a number"),
        ("c.bus", adams() + curve("FX", 1.0), "is there twice"),
        ("c.gbs", adams(), "without \\[DIRECTIONS\\]"),
        ("c.gbs", ALTAIR.replace("'CUBIC_STIFFNESS'          0", "'CUBIC_STIFFNESS' 1"), "not linear"),
        ("c.gbs", ALTAIR.replace("1  0  1  1  0  0", "1  0  1  1"), "six of 0 and 1"),
        ("c.gbs", ALTAIR.replace("[CONSTANT_STIFFNESS_FX]", "''\n[CONSTANT_FX]"), "six of"),
        ("c.gbs", ALTAIR.replace("K = 6000.0", ""), "\\[CONSTANT_STIFFNESS_FX\\] K: missing"),
        ("c.txt", adams(), "expected one of .bus, .gbs"),
    ],
)
def test_what_is_not_linear_or_not_described_is_refused(read, name, text, expected):
    with pytest.raises(VehicleError, match=f"{name}.*{expected}"):
        read(text, name)


def test_a_mount_table_takes_rates_from_a_property_file(tmp_path):
    folder = tmp_path / "v"
    folder.mkdir()
    (folder / "vehicle.toml").write_text(
        'name = "block"\nunits = { length = "m", mass = "kg", inertia = "kg m²", stiffness = "N/mm", '
        'rotational_stiffness = "N m/rad", damping = "N s/m", rotational_damping = "N m s/rad" }\n'
        '[[rigid_body]]\nname = "block"\nmass = 1.0\ncenter_of_gravity = [0, 0, 0]\n'
        "inertia = [1, 1, 1]\n"
    )
    (tmp_path / "c1.bus").write_text(adams())
    path = tmp_path / "m.csv"
    path.write_text("name,body_1,body_2,x [m],y [m],z [m],property\na,block,ground,0,0,0,c1.bus\n")
    assert main(["import", str(path), "--output", str(folder)]) == 0
    (mount,) = read_vehicle(folder).mounts
    np.testing.assert_allclose(mount.stiffness, [1e6, 750_500, 2e6])
    np.testing.assert_allclose(mount.damping, [500, 600, 700])


def test_a_property_file_alone_is_listed_and_no_connection(tmp_path, capsys):
    path = tmp_path / "c1.bus"
    path.write_text(adams())
    assert main(["import", str(path)]) == 0
    assert "750.5 N/mm" in capsys.readouterr().out
    assert main(["import", str(path), "--output", str(tmp_path / "v")]) == 2
    assert "neither bodies nor places" in capsys.readouterr().err
