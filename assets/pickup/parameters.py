"""The truck's calibrated numbers: what the paper does not give, chosen so that its tables come out.

They are fitted, not predicted: 65 values against 15 frequencies, the identity of 11 modes, the change
of one road response and 32 table entries. `assets/calibrate_truck.py` is the fit. Values on a bound are
what the fit wants and common sense holds back.
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

    engine_mass: float = fitted(240.496, 240, 350)
    """With gearbox."""
    engine_ixx: float = fitted(12.5597, 9, 24)
    engine_iyy: float = fitted(49.6236, 24, 50)
    engine_izz: float = fitted(20.3093, 20, 45)
    engine_ixz: float = fitted(1.39660, -5, 5)
    engine_cg_x: float = fitted(0.373472, 0.02, 0.42)
    engine_cg_z: float = fitted(0.580024, 0.58, 0.82)
    engine_mount_x: float = fitted(0.260867, -0.15, 0.32)
    engine_mount_y: float = fitted(0.209697, 0.20, 0.38)
    engine_mount_z: float = fitted(0.666363, 0.48, 0.74)
    transmission_mount_x: float = fitted(1.17336, 1.16, 1.34)
    transmission_mount_z: float = fitted(0.532184, 0.38, 0.54)

    front_end_mount_x: float = fitted(-0.949983, -0.95, -0.78)
    front_end_mount_y: float = fitted(0.433754, 0.30, 0.44)
    front_end_mount_z: float = fitted(0.550396, 0.44, 0.56)
    cab_front_mount_x: float = fitted(1.03998, 0.84, 1.04)
    cab_front_mount_y: float = fitted(0.699976, 0.50, 0.70)
    cab_rear_mount_x: float = fitted(1.98998, 1.80, 1.99)
    cab_rear_mount_y: float = fitted(0.679355, 0.50, 0.70)
    cab_mount_z: float = fitted(0.507890, 0.50, 0.64)
    body_mount_loss_factor: float = fitted(0.149514, 0.06, 0.16)
    engine_mount_loss_factor: float = fitted(0.159926, 0.06, 0.16)

    cab_mass_factor: float = fitted(1.01877, 0.75, 1.15)
    front_end_mass_factor: float = fitted(0.750035, 0.75, 1.20)
    box_mass_factor: float = fitted(1.45753, 0.90, 1.50)
    cab_stiffness_factor: float = fitted(0.526353, 0.5, 2.0)
    front_end_stiffness_factor: float = fitted(1.81567, 0.4, 2.0)
    box_stiffness_factor: float = fitted(0.400073, 0.4, 2.5)
    box_mount_rate: float = fitted(1.28275e6, 1.2e6, 12e6)
    """Fore-aft and lateral; the vertical one is half as much again."""
    bolt_rate: float = fitted(1.21564e7, 1e7, 1e8)
    """Front end to cab, every direction."""
    rail_vertical_bending_factor: float = fitted(0.699231, 0.4, 2.2)
    rail_lateral_bending_factor: float = fitted(1.99419, 0.5, 2.0)
    rail_torsion_factor: float = fitted(0.521502, 0.15, 3.0)
    crossmember_bending_factor: float = fitted(4.30027, 0.7, 5.0)
    crossmember_torsion_factor: float = fitted(0.300085, 0.3, 5.0)

    knuckle_mass: float = fitted(42.9777, 34, 52)
    """With hub and wheel, one side."""
    axle_mass: float = fitted(169.630, 140, 200)
    """With both wheels."""
    axle_ixx: float = fitted(53.2567, 35, 65)
    axle_iyy: float = fitted(3.30185, 3, 8)
    front_tyre_vertical_rate: float = fitted(251082.0, 1.8e5, 2.6e5)
    rear_tyre_vertical_rate: float = fitted(249078.0, 1.8e5, 2.6e5)
    front_tyre_lateral_rate: float = fitted(70309.0, 7e4, 2e5)
    rear_tyre_lateral_rate: float = fitted(71292.4, 7e4, 2e5)
    tyre_fore_aft_rate: float = fitted(224489.0, 1.2e5, 4.5e5)
    tyre_trail: float = fitted(0.0358689, 0.0, 0.04)
    coil_rate: float = fitted(177235.0, 6e4, 2.3e5)
    """At the coil, on the lower arm."""
    bush_rate: float = fitted(1.78677e7, 3e6, 2e7)
    relay_rod_rate: float = fitted(1.00021e6, 1e6, 8e6)
    """Lateral, relay rod to frame, mean of the sides."""
    relay_rod_asymmetry: float = fitted(0.805403, 0.0, 0.9)
    """The pitman arm on the left is this fraction stiffer than the mean, the idler arm softer."""
    half_leaf_rate: float = fitted(42982.9, 2.4e4, 5.5e4)
    """Vertical, front eye and rear shackle each."""
    leaf_fore_aft_rate: float = fitted(758832.0, 2e5, 2e6)
    leaf_lateral_rate: float = fitted(1.17533e6, 1.5e5, 1.5e6)
    leaf_half_length: float = fitted(0.727258, 0.55, 0.75)
    leaf_y: float = fitted(0.427735, 0.42, 0.58)
    leaf_z: float = fitted(0.574745, 0.42, 0.62)
    front_damping: float = fitted(1038.02, 1000, 4500)
    rear_damping: float = fitted(838.075, 800, 3500)

    driver_mass: float = fitted(42.7568, 40, 85)
    """What of the occupant the cab feels."""
    passenger_mass: float = fitted(45.6879, 0, 75)
    """With test gear."""
    tank_mass: float = fitted(69.9859, 0, 70)
    seat_x: float = fitted(1.13486, 1.00, 1.32)
    seat_y: float = fitted(0.590378, 0.28, 0.62)
    toe_x: float = fitted(0.560933, 0.56, 0.70)
    toe_y: float = fitted(0.293707, 0.20, 0.50)
    toe_z: float = fitted(0.783806, 0.60, 0.80)

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
