"""The truck's calibrated numbers: what the paper does not give, chosen so that its tables come out.

They are fitted, not predicted: 65 values, and 16 of the roads, against 15 frequencies, the fall of one
road response, 32 entries of Tables 5 and 6 and 18 names of Tables 2 and 3, so that the agreement proves
nothing. `assets/calibrate_truck.py` is the fit. 17 values lie on a bound, where the fit wants more than
common sense allows: soft box sheet, hard rubber damping, tyres soft sideways.
"""

from dataclasses import dataclass, field

from pickup.sides import Place

WHEELBASE = 2.98
SHACKLE_RISE = 0.05
"""m: how much higher the leaf's rear shackle is than its front eye."""


def fitted(value: float, low: float, high: float) -> float:
    """A field the calibration may move between `low` and `high`."""
    return field(default=value, metadata={"bounds": (low, high)})


@dataclass(frozen=True)
class Parameters:
    """SI; x aft of the front axle, y to the right, z above ground; places are the right side's."""

    engine_mass: float = fitted(250.092, 240, 350)
    """With gearbox."""
    engine_ixx: float = fitted(18.3085, 9, 24)
    engine_iyy_share: float = fitted(0.962746, 0.7, 0.98)
    """Of Ixx + Izz, which is the most that any body can have."""
    engine_izz: float = fitted(37.8467, 20, 45)
    engine_ixz: float = fitted(0.206276, -5, 5)
    engine_cg_x: float = fitted(0.385398, 0.02, 0.42)
    engine_cg_z: float = fitted(0.58, 0.58, 0.82)
    engine_mount_x: float = fitted(0.20386, -0.15, 0.32)
    engine_mount_y: float = fitted(0.222148, 0.20, 0.38)
    engine_mount_z: float = fitted(0.700139, 0.48, 0.74)
    transmission_mount_x: float = fitted(1.16371, 1.16, 1.34)
    transmission_mount_z: float = fitted(0.522038, 0.38, 0.54)

    front_end_mount_x: float = fitted(-0.95, -0.95, -0.78)
    front_end_mount_y: float = fitted(0.436692, 0.30, 0.44)
    front_end_mount_z: float = fitted(0.5513, 0.44, 0.56)
    cab_front_mount_x: float = fitted(1.03194, 0.84, 1.04)
    cab_front_mount_y: float = fitted(0.7, 0.50, 0.70)
    cab_rear_mount_x: float = fitted(1.99, 1.80, 1.99)
    cab_rear_mount_y: float = fitted(0.663666, 0.50, 0.70)
    cab_mount_z: float = fitted(0.549439, 0.50, 0.64)
    body_mount_loss_factor: float = fitted(0.12129, 0.06, 0.16)
    engine_mount_loss_factor: float = fitted(0.159166, 0.06, 0.16)

    cab_mass_factor: float = fitted(0.872814, 0.75, 1.15)
    front_end_mass_factor: float = fitted(0.75, 0.75, 1.20)
    box_mass_factor: float = fitted(1.47793, 0.90, 1.50)
    cab_stiffness_factor: float = fitted(0.5, 0.5, 2.0)
    front_end_stiffness_factor: float = fitted(1.14222, 0.4, 2.0)
    box_stiffness_factor: float = fitted(0.4, 0.4, 2.5)
    box_mount_rate: float = fitted(1.2e06, 1.2e6, 12e6)
    """Fore-aft and lateral; the vertical one is half as much again."""
    bolt_rate: float = fitted(1e07, 1e7, 1e8)
    """Front end to cab, every direction."""
    rail_vertical_bending_factor: float = fitted(0.691803, 0.4, 2.2)
    rail_lateral_bending_factor: float = fitted(1.93285, 0.5, 2.0)
    rail_torsion_factor: float = fitted(0.683234, 0.15, 3.0)
    crossmember_bending_factor: float = fitted(4.01288, 0.7, 5.0)
    crossmember_torsion_factor: float = fitted(0.3, 0.3, 5.0)

    knuckle_mass: float = fitted(46.028, 34, 52)
    """With hub and wheel, one side."""
    axle_mass: float = fitted(173.241, 140, 200)
    """With both wheels."""
    axle_ixx: float = fitted(56.8298, 35, 65)
    axle_iyy: float = fitted(3.79696, 3, 8)
    front_tyre_vertical_rate: float = fitted(260000, 1.8e5, 2.6e5)
    rear_tyre_vertical_rate: float = fitted(256173, 1.8e5, 2.6e5)
    front_tyre_lateral_rate: float = fitted(82920.6, 7e4, 2e5)
    rear_tyre_lateral_rate: float = fitted(70000, 7e4, 2e5)
    tyre_fore_aft_rate: float = fitted(225678, 1.2e5, 4.5e5)
    tyre_trail: float = fitted(0.0327877, 0.0, 0.04)
    coil_rate: float = fitted(165855, 6e4, 2.3e5)
    """At the coil, on the lower arm."""
    bush_rate: float = fitted(1.59515e07, 3e6, 2e7)
    relay_rod_rate: float = fitted(1e06, 1e6, 8e6)
    """Lateral, relay rod to frame, mean of the sides."""
    relay_rod_asymmetry: float = fitted(0.718888, 0.0, 0.9)
    """The pitman arm on the left is this fraction stiffer than the mean, the idler arm softer."""
    half_leaf_rate: float = fitted(43031.5, 2.4e4, 5.5e4)
    """Vertical, front eye and rear shackle each."""
    leaf_fore_aft_rate: float = fitted(688370, 2e5, 2e6)
    leaf_lateral_rate: float = fitted(1.13992e06, 1.5e5, 1.5e6)
    leaf_half_length: float = fitted(0.721466, 0.55, 0.75)
    leaf_y: float = fitted(0.422839, 0.42, 0.58)
    leaf_z: float = fitted(0.530161, 0.42, 0.62)
    front_damping: float = fitted(2170.52, 1000, 4500)
    rear_damping: float = fitted(800, 800, 3500)

    driver_mass: float = fitted(61.1981, 40, 85)
    """What of the occupant the cab feels."""
    passenger_mass: float = fitted(54.7663, 0, 75)
    """With test gear."""
    tank_mass: float = fitted(69.1552, 0, 70)
    seat_x: float = fitted(1.14773, 1.00, 1.32)
    seat_y: float = fitted(0.58615, 0.28, 0.62)
    toe_x: float = fitted(0.58236, 0.56, 0.70)
    toe_y: float = fitted(0.23449, 0.20, 0.50)
    toe_z: float = fitted(0.763702, 0.60, 0.80)

    @property
    def engine_iyy(self) -> float:
        return self.engine_iyy_share * (self.engine_ixx + self.engine_izz)

    @property
    def engine_mount(self) -> Place:
        return self.engine_mount_x, self.engine_mount_y, self.engine_mount_z

    @property
    def transmission_mount(self) -> Place:
        return self.transmission_mount_x, 0.0, self.transmission_mount_z

    @property
    def front_end_mount(self) -> Place:
        return self.front_end_mount_x, self.front_end_mount_y, self.front_end_mount_z

    @property
    def cab_front_mount(self) -> Place:
        return self.cab_front_mount_x, self.cab_front_mount_y, self.cab_mount_z

    @property
    def cab_rear_mount(self) -> Place:
        return self.cab_rear_mount_x, self.cab_rear_mount_y, self.cab_mount_z

    @property
    def leaf_eye(self) -> Place:
        """The front end of the leaf spring, fixed to the frame."""
        return WHEELBASE - self.leaf_half_length, self.leaf_y, self.leaf_z

    @property
    def leaf_shackle(self) -> Place:
        """The rear end of the leaf spring, free to swing."""
        return WHEELBASE + self.leaf_half_length, self.leaf_y, self.leaf_z + SHACKLE_RISE
