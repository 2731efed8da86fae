"""A component as a flexible body in SI, as far as its files say enough for that."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import PurePath

import numpy as np

from modeviz.errors import VehicleError, listed, quoted
from modeviz.files.modal import with_zeros
from modeviz.formats.attachments import LOOSE, Found
from modeviz.formats.component import LARGEST, UNIT_SYSTEMS, Component, UnitSystem
from modeviz.formats.nastran import SUFFIXES as NASTRAN
from modeviz.formats.nastran.reader import DECKS
from modeviz.formats.surface import display_mesh
from modeviz.vehicle.arrays import Array, Floats
from modeviz.vehicle.bodies import Attachment, FlexibleBody, Role
from modeviz.vehicle.rigid_fit import fit_rigid

USUAL_DAMPING_RATIO = 0.01
"""Of a component whose file has none."""

STILL = 1e-6
"""So small a part of the largest motion of a rigid mode is none."""

MOST_NODES_TIMES_MODES = 2_000_000
"""Of a body that is written, 48 MB: more nodes are thinned out, since they only carry the drawing."""


def chosen_units(component: Component, name: str | None) -> UnitSystem:
    """Return the units that a component is in: those that its files say, or else those of a name.

    Raises:
        VehicleError: neither says them, both do and differ, or there are none of that name.
    """
    if name is not None and name not in UNIT_SYSTEMS:
        raise VehicleError(f"found the units {quoted(name)}, expected one of {', '.join(UNIT_SYSTEMS)}")
    said, asked = component.units, UNIT_SYSTEMS.get(name or "")
    if (
        said
        and asked
        and not np.allclose([said.length, said.mass], [asked.length, asked.mass], rtol=1e-3)
    ):
        raise VehicleError(
            f"{component.source}: the file says that it is in {said.name!r} (a length of "
            f"{said.length:g} m, a mass of {said.mass:g} kg), which {asked.name} is not"
        )
    if chosen := said or asked:
        return chosen
    raise VehicleError(
        f"{component.source}: the file doesn't say its units, and they are not guessed; "
        f"say them, one of {', '.join(UNIT_SYSTEMS)}"
    )


def uncoupled_because(component: Component) -> str | None:
    """Return all that keeps a component from being coupled to others, in words; None: nothing does."""
    if not component.n_modes:
        return "it has no modes"
    if component.is_complex:
        return "its shapes are complex, those of a damped structure; expected normal modes"
    reasons = (_without_masses(component), _without_places(component), _not_free(component))
    return "; and ".join(filter(None, reasons)) or None


def _without_masses(component: Component) -> str:
    """Words if a mode has no modal mass."""
    modes = component.modes
    unknown = np.flatnonzero(~((modes.modal_mass > 1 / LARGEST) & (modes.modal_mass < LARGEST)))
    if not len(unknown):
        return ""
    return (
        f"the modal mass of {len(unknown)} of its {component.n_modes} modes is not in the file, "
        f"such as that at {modes.frequency_hz[unknown[0]]:.4g} Hz; without it nobody knows what "
        f"force moves them{_where_masses_may_be(component)}"
    )


def _without_places(component: Component) -> str:
    """Words if it has no geometry."""
    if component.has_place.any():
        return ""
    return "none of the nodes that it moves has a place; give the file with the geometry too"


def _not_free(component: Component) -> str:
    """Words if its modes are not those of a free structure."""
    zeros, _ = with_zeros(_omega_n_squared(component.modes.frequency_hz))
    if (zeros < 0).any():
        return (
            f"{int(np.sum(zeros < 0))} of its modes are unstable, down to an ω² of {zeros.min():.3g} "
            "rad²/s²"
        )
    n_rigid = int((zeros == 0).sum())
    if n_rigid in (FlexibleBody.N_RIGID - 1, FlexibleBody.N_RIGID):
        return ""
    half = "; of a half model, give its other run with --antisymmetric" if n_rigid == 3 else ""
    return (
        f"{n_rigid} of its modes are near zero Hz (the lowest is at "
        f"{component.modes.frequency_hz[0]:.4g} Hz), expected the six rigid ones of a free structure: "
        f"solve it without supports and with all modes from zero up{half}"
    )


def _where_masses_may_be(component: Component) -> str:
    """Words for the input file of Nastran, if it isn't given with the results."""
    endings = {PurePath(name).suffix.lower() for name in component.source.split(", ")}
    if endings.intersection(DECKS) or not endings.intersection(NASTRAN):
        return ""
    return ": give the input file too, which may say that they are normalised to it"


def _omega_n_squared(frequency_hz: Floats) -> Floats:
    """ω² with the sign of the frequency."""
    return (2 * np.pi) ** 2 * frequency_hz * np.abs(frequency_hz)


def flexible_body(
    component: Component,
    units: UnitSystem,
    name: str,
    attachments: Sequence[Found],
    role: Role = "other",
) -> tuple[FlexibleBody, tuple[str, ...]]:
    """Return a component as a body in SI, mass-normalised, and what there is to know of that.

    Mass-normalised shapes are those of the file over the root of their modal mass.

    Args:
        component: of normal modes with their modal masses.
        units: that it is in.
        name: of the body.
        attachments: where others hold on to it.
        role: in the vehicle.

    Raises:
        VehicleError: it cannot be coupled; the text says why.
    """
    if reason := uncoupled_because(component):
        raise VehicleError(f"{component.source}: cannot be coupled to others: {reason}")
    modes = component.modes
    omega_n_squared, n_near_zero = with_zeros(_omega_n_squared(modes.frequency_hz))
    n_normal = component.n_modes - modes.n_residuals
    component, n_still = _without_still_nodes(component, omega_n_squared == 0, attachments)
    kind = modes.shapes.dtype.type
    normalised = modes.shapes / np.sqrt(modes.modal_mass * units.mass).astype(kind)
    normalised[:, 3:] /= kind(units.length)
    places = component.nodes * units.length
    is_turned = _with_rigid_rotations(normalised, places, component.has_place, omega_n_squared == 0)
    mesh, drawn = display_mesh(component, units.length)
    kept, thinned = _carriers(component, drawn)
    body = FlexibleBody(
        name=name,
        role=role,
        label=name,
        omega_n_squared=omega_n_squared,
        n_residuals=modes.n_residuals,
        damping_ratio=_damping(modes.damping_ratio[:n_normal][omega_n_squared[:n_normal] > 0]),
        attachments=tuple(Attachment(a.name, a.position, a.shapes(normalised)) for a in attachments),
        nodes=places[kept],
        shapes=normalised[kept],
        mesh=mesh,
    )
    remarks = [
        *_remarks(n_near_zero, modes.frequency_hz, thinned, n_still),
        *_attachment_remarks(attachments, places, normalised, is_turned),
    ]
    return body, tuple(remarks)


def _without_still_nodes(
    component: Component, is_rigid: Array, attachments: Sequence[Found]
) -> tuple[Component, int]:
    """A free component without the places of nodes that its rigid modes do not move, and their number.

    Solvers hold what nothing is tied to, such as grids that only say which way a beam is turned.

    Raises:
        VehicleError: an attachment is at one.
    """
    size = np.abs(component.modes.shapes[:, :3, is_rigid]).max(axis=(1, 2))
    moves = size > STILL * size.max()
    for attachment in attachments:
        if not moves[attachment.rows].all():
            raise VehicleError(
                f"attachment {quoted(attachment.name)}: a node of it stays where it is in all rigid "
                "modes, so it is not tied to the structure"
            )
    n_still = int(np.sum(component.has_place & ~moves))
    if not n_still:
        return component, 0
    return replace(component, nodes=np.where(moves[:, None], component.nodes, np.nan)), n_still


def _with_rigid_rotations(shapes: Floats, places: Floats, placed: Array, is_rigid: Array) -> Array:
    """Gives nodes that have no rotations those of the rigid modes, in place; which nodes they were."""
    fit = fit_rigid(
        np.zeros((0, 3)),
        np.zeros((0, 6, is_rigid.sum())),
        places[placed],
        shapes[:, :, is_rigid][placed],
    )
    without = placed & ~shapes[:, 3:].any(axis=(1, 2))
    turning = np.where(without[:, None, None], fit.motions[3:], shapes[:, 3:, is_rigid])
    shapes[:, 3:, is_rigid] = turning
    return without


def _carriers(component: Component, drawn: Array) -> tuple[Array, int]:
    """Rows of the nodes that carry the drawing, and how many others would have.

    They are those that are drawn; of a component without elements all that have a place.
    """
    rows = drawn if len(drawn) else np.flatnonzero(component.has_place)
    step = -(-len(rows) * component.n_modes // MOST_NODES_TIMES_MODES)
    return rows[::step], len(rows) - len(rows[::step])


def _damping(ratios: Floats) -> float | tuple[float, ...]:
    """Those of the file for the elastic normal modes, if it says all of them."""
    if len(ratios) and np.isfinite(ratios).all():
        return tuple(ratios.tolist())
    return USUAL_DAMPING_RATIO


def _remarks(n_near_zero: int, frequency_hz: Floats, thinned: int, n_still: int) -> Iterator[str]:
    if n_near_zero:
        largest = np.abs(frequency_hz[:n_near_zero]).max()
        yield (f"{n_near_zero} modes are near zero, up to {largest:.1g} Hz; taken for the rigid ones")
    if n_still:
        yield (
            f"{n_still:,} nodes stay where they are in all rigid modes, as grids that nothing is tied "
            "to; they are left out"
        )
    if thinned:
        yield f"{thinned:,} nodes are left out of what moves the drawing, which its neighbours carry"


def _attachment_remarks(
    attachments: Sequence[Found], places: Floats, shapes: Floats, is_turned: Array
) -> Iterator[str]:
    """Sentences on attachments whose nodes do not say all of their motion.

    Args:
        attachments: of the body.
        places: (n_nodes, 3), m.
        shapes: (n_nodes, 6, n_modes), in SI.
        is_turned: which nodes have no rotations of their own.
    """
    if solid := [a.name for a in attachments if len(a.rows) == 1 and is_turned[a.rows[0]]]:
        yield (
            f"the nodes of {listed(solid)} have no rotations in the file: taken to turn as the body "
            "does in its rigid modes, and not as it deforms; a set of nodes (NAME=mean:NODE,NODE,…) "
            "has them"
        )
    for attachment in attachments:
        apart = attachment.looseness(places, shapes) if attachment.is_rigid else 0.0
        if apart > LOOSE:
            yield (
                f"the nodes of {quoted(attachment.name)} are to be one rigid piece, and part from it "
                f"by {100 * apart:.0f} % of their motion: the modes were computed without it; the "
                "attachment moves as the piece nearest to them"
            )
