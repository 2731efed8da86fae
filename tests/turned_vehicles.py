"""A vehicle as another program has it: in other axes, component by component."""

from dataclasses import replace
from itertools import permutations, product
from pathlib import Path

import numpy as np

from modeviz.files import write_vehicle
from modeviz.vehicle.bodies import Body, FlexibleBody
from modeviz.vehicle.connections import MOTIONS, Connection, Rod, Tyre
from modeviz.vehicle.vehicle import Vehicle

OPPOSITE = [("rearward", "forward"), ("right", "left"), ("up", "down")]
WAYS = {
    word: (line, sign)
    for line, words in enumerate(OPPOSITE)
    for word, sign in zip(words, (1, -1), strict=True)
}

LEFT_HANDED, RIGHT_HANDED = [], []
for lines in permutations(OPPOSITE):
    for words in product(*lines):
        x, y, z = (sign * np.eye(3)[line] for line, sign in map(WAYS.__getitem__, words))
        right = np.dot(np.cross(x, y), z) > 0
        (RIGHT_HANDED if right else LEFT_HANDED).append(words)


def text(words: tuple[str, ...]) -> str:
    return ", ".join(f"{axis} {word}" for axis, word in zip("xyz", words, strict=True))


def turned_folder(folder: Path, vehicle: Vehicle, words: tuple[str, ...]) -> Path:
    """The folder of a vehicle whose x, y and z are along these words."""
    write_vehicle(turned(vehicle, words), folder)
    file = folder / "vehicle.toml"
    file.write_text(f'axes = "{text(words)}"\n' + file.read_text("utf-8"), "utf-8")
    return folder


def turned(vehicle: Vehicle, words: tuple[str, ...]) -> Vehicle:
    """The same vehicle, with the numbers that it has in these axes."""
    groups = tuple(
        replace(
            g,
            mounts=tuple(_connection(m, words) for m in g.mounts),
            travel={d: _range(d, limits, words) for d, limits in g.travel.items()},
            curves={d: _curve(d, curve, words) for d, curve in g.curves.items()},
        )
        for g in vehicle.mount_groups
    )
    return replace(
        vehicle,
        bodies=tuple(_body(b, words) for b in vehicle.bodies),
        connections=tuple(_connection(c, words) for c in vehicle.connections),
        mount_groups=groups,
        added_masses=tuple(
            replace(m, position=_vector(m.position, words)) for m in vehicle.added_masses
        ),
        forces=tuple(
            replace(f, position=_vector(f.position, words), direction=_vector(f.direction, words))
            for f in vehicle.forces
        ),
        base_motions=tuple(
            replace(m, direction=_vector(m.direction, words)) for m in vehicle.base_motions
        ),
        response_points=tuple(
            replace(p, position=_vector(p.position, words)) for p in vehicle.response_points
        ),
        load_cases=tuple(_load_case(case, words) for case in vehicle.load_cases),
    )


def _sign(direction, words):
    """Whether what is called after a direction is along our axis, 1, or against it, -1."""
    line = {"vertical": 2, "lateral": 1, "fore-aft": 0}[direction]
    return next(sign for other, sign in map(WAYS.__getitem__, words) if other == line)


def _range(direction, limits, words):
    return tuple(sorted(_sign(direction, words) * limit for limit in limits))


def _curve(direction, curve, words):
    sign = _sign(direction, words)
    return replace(curve, deflection=sign * curve.deflection[::sign], force=sign * curve.force[::sign])


def _load_case(case, words):
    loads = tuple(
        replace(
            load,
            force=_vector(load.force, words),
            torque=_vector(load.torque, words),
            position=None if load.position is None else _vector(load.position, words),
        )
        for load in case.loads
    )
    return replace(case, load_g=_vector(case.load_g, words), loads=loads)


def _vector(v, words):
    return np.stack(
        [sign * np.asarray(v)[..., line] for line, sign in map(WAYS.__getitem__, words)], -1
    )


def _six(shapes, words):
    """Motions and rotations (..., 6, n_modes)."""
    columns = np.moveaxis(shapes, -2, -1)
    both = [_vector(columns[..., :3], words), _vector(columns[..., 3:], words)]
    return np.moveaxis(np.concatenate(both, -1), -1, -2)


def _body(body: Body, words) -> Body:
    mesh = tuple(replace(part, vertices=_vector(part.vertices, words)) for part in body.mesh)
    if isinstance(body, FlexibleBody):
        attachments = tuple(
            replace(a, position=_vector(a.position, words), shapes=_six(a.shapes, words))
            for a in body.attachments
        )
        nodes, shapes = _vector(body.nodes, words), _six(body.shapes, words)
        return replace(body, mesh=mesh, attachments=attachments, nodes=nodes, shapes=shapes)
    inertia = _vector(_vector(body.inertia, words).T, words)
    at = _vector(body.center_of_gravity, words)
    return replace(body, mesh=mesh, center_of_gravity=at, inertia=inertia)


def _connection(connection: Connection, words) -> Connection:
    """Its local axes have the names of the vehicle's axes they were called after."""
    if isinstance(connection, Rod):
        return replace(connection, points=_vector(connection.points, words))
    lines = [WAYS[word][0] for word in words]
    new = {MOTIONS[line + 3 * r]: MOTIONS[i + 3 * r] for i, line in enumerate(lines) for r in (0, 1)}
    changed = replace(
        connection,
        points=_vector(connection.points, words),
        axes=np.stack([_vector(connection.axes[line], words) for line in lines]),
        stiffness=connection.stiffness[lines],
        rotational_stiffness=connection.rotational_stiffness[lines],
        damping=connection.damping[lines],
        rigid=tuple(new[motion] for motion in connection.rigid),
    )
    if isinstance(changed, Tyre):
        return replace(changed, wheel_center=_vector(changed.wheel_center, words))
    return changed
