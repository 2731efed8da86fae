"""The sheets and members the truck is made of."""

from modeviz.fem.mesh import BeamSection, ShellSection

STEEL = 2.07e11
"""Young's modulus, Pa."""
STEEL_DENSITY = 7850.0
"""kg/m³."""
POISSON = 0.3
GLASS_DENSITY = 2500.0


def steel_sheet(
    thickness: float, bending_factor: float, added_mass: float = 0.0, softening: float = 1.0
) -> ShellSection:
    """Swaged sheet: `bending_factor` keeps its flat idealisation from drumming in the ride band."""
    return ShellSection(
        thickness, STEEL * softening, POISSON, STEEL_DENSITY, bending_factor, added_mass
    )


def glass(thickness: float) -> ShellSection:
    """Curved glass."""
    return ShellSection(thickness, 7.0e10, 0.22, GLASS_DENSITY, bending_factor=6.0)


def box_member(width: float, height: float, thickness: float) -> BeamSection:
    """A thin-walled rectangular tube of steel (Bredt's torsion constant)."""
    w, h, t = width, height, thickness
    return BeamSection(
        area=2 * t * (w + h),
        bending_inertia_up=t * h**3 / 6 + w * t * h**2 / 2,
        bending_inertia_across=t * w**3 / 6 + h * t * w**2 / 2,
        torsion_constant=2 * t * (w * h) ** 2 / (w + h),
        youngs_modulus=STEEL,
        poisson_ratio=POISSON,
        density=STEEL_DENSITY,
    )


BRACKET = BeamSection(
    area=4e-3,
    bending_inertia_up=8e-6,
    bending_inertia_across=8e-6,
    torsion_constant=1.2e-5,
    youngs_modulus=STEEL,
    poisson_ratio=POISSON,
    density=800.0,
)
"""A stiff, light mount bracket."""


def is_glass(section: ShellSection) -> bool:
    """Whether a sheet is seen through."""
    return section.density == GLASS_DENSITY
