"""The truck's calibrated numbers: what the paper does not give, chosen so that its tables come out.

They are fitted, not predicted: 65 values against 15 frequencies, the fall of one road response and 32
entries of Tables 5 and 6, so that the agreement proves nothing. `assets/calibrate_truck.py` is the fit.
24 values lie on a bound, where the fit wants more than common sense allows: a light powertrain, soft
box sheet, hard rubber damping, tyres soft sideways.
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

    engine_mass: float = fitted(240.514, 240, 350)
    """With gearbox."""
    engine_ixx: float = fitted(12.4832, 9, 24)
    engine_iyy: float = fitted(49.9745, 24, 50)
    engine_izz: float = fitted(20.4797, 20, 45)
    engine_ixz: float = fitted(1.94935, -5, 5)
    engine_cg_x: float = fitted(0.395743, 0.02, 0.42)
    engine_cg_z: float = fitted(0.580019, 0.58, 0.82)
    engine_mount_x: float = fitted(0.251855, -0.15, 0.32)
    engine_mount_y: float = fitted(0.215915, 0.20, 0.38)
    engine_mount_z: float = fitted(0.669389, 0.48, 0.74)
    transmission_mount_x: float = fitted(1.16579, 1.16, 1.34)
    transmission_mount_z: float = fitted(0.534115, 0.38, 0.54)

    front_end_mount_x: float = fitted(-0.949988, -0.95, -0.78)
    front_end_mount_y: float = fitted(0.435729, 0.30, 0.44)
    front_end_mount_z: float = fitted(0.550687, 0.44, 0.56)
    cab_front_mount_x: float = fitted(1.03999, 0.84, 1.04)
    cab_front_mount_y: float = fitted(0.699985, 0.50, 0.70)
    cab_rear_mount_x: float = fitted(1.98999, 1.80, 1.99)
    cab_rear_mount_y: float = fitted(0.672308, 0.50, 0.70)
    cab_mount_z: float = fitted(0.500007, 0.50, 0.64)
    body_mount_loss_factor: float = fitted(0.151701, 0.06, 0.16)
    engine_mount_loss_factor: float = fitted(0.159994, 0.06, 0.16)

    cab_mass_factor: float = fitted(0.97465, 0.75, 1.15)
    front_end_mass_factor: float = fitted(0.750025, 0.75, 1.20)
    box_mass_factor: float = fitted(1.47589, 0.90, 1.50)
    cab_stiffness_factor: float = fitted(0.500304, 0.5, 2.0)
    front_end_stiffness_factor: float = fitted(1.82012, 0.4, 2.0)
    box_stiffness_factor: float = fitted(0.400139, 0.4, 2.5)
    box_mount_rate: float = fitted(1.25539e06, 1.2e6, 12e6)
    """Fore-aft and lateral; the vertical one is half as much again."""
    bolt_rate: float = fitted(1.10757e07, 1e7, 1e8)
    """Front end to cab, every direction."""
    rail_vertical_bending_factor: float = fitted(0.704973, 0.4, 2.2)
    rail_lateral_bending_factor: float = fitted(1.99615, 0.5, 2.0)
    rail_torsion_factor: float = fitted(0.450442, 0.15, 3.0)
    crossmember_bending_factor: float = fitted(4.35546, 0.7, 5.0)
    crossmember_torsion_factor: float = fitted(0.300312, 0.3, 5.0)

    knuckle_mass: float = fitted(44.7, 34, 52)
    """With hub and wheel, one side."""
    axle_mass: float = fitted(168.378, 140, 200)
    """With both wheels."""
    axle_ixx: float = fitted(54.2785, 35, 65)
    axle_iyy: float = fitted(3.26907, 3, 8)
    front_tyre_vertical_rate: float = fitted(251143.0, 1.8e5, 2.6e5)
    rear_tyre_vertical_rate: float = fitted(247481.0, 1.8e5, 2.6e5)
    front_tyre_lateral_rate: float = fitted(70141.3, 7e4, 2e5)
    rear_tyre_lateral_rate: float = fitted(70526.8, 7e4, 2e5)
    tyre_fore_aft_rate: float = fitted(220361.0, 1.2e5, 4.5e5)
    tyre_trail: float = fitted(0.0364325, 0.0, 0.04)
    coil_rate: float = fitted(172951.0, 6e4, 2.3e5)
    """At the coil, on the lower arm."""
    bush_rate: float = fitted(1.76594e07, 3e6, 2e7)
    relay_rod_rate: float = fitted(1.00121e06, 1e6, 8e6)
    """Lateral, relay rod to frame, mean of the sides."""
    relay_rod_asymmetry: float = fitted(0.808163, 0.0, 0.9)
    """The pitman arm on the left is this fraction stiffer than the mean, the idler arm softer."""
    half_leaf_rate: float = fitted(43086.6, 2.4e4, 5.5e4)
    """Vertical, front eye and rear shackle each."""
    leaf_fore_aft_rate: float = fitted(720977.0, 2e5, 2e6)
    leaf_lateral_rate: float = fitted(1.15792e06, 1.5e5, 1.5e6)
    leaf_half_length: float = fitted(0.726401, 0.55, 0.75)
    leaf_y: float = fitted(0.424219, 0.42, 0.58)
    leaf_z: float = fitted(0.553558, 0.42, 0.62)
    front_damping: float = fitted(1000.58, 1000, 4500)
    rear_damping: float = fitted(801.252, 800, 3500)

    driver_mass: float = fitted(42.2728, 40, 85)
    """What of the occupant the cab feels."""
    passenger_mass: float = fitted(42.7804, 0, 75)
    """With test gear."""
    tank_mass: float = fitted(69.9429, 0, 70)
    seat_x: float = fitted(1.13109, 1.00, 1.32)
    seat_y: float = fitted(0.60737, 0.28, 0.62)
    toe_x: float = fitted(0.560022, 0.56, 0.70)
    toe_y: float = fitted(0.284218, 0.20, 0.50)
    toe_z: float = fitted(0.785914, 0.60, 0.80)

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
