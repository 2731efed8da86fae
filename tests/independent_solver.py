"""Modes and responses of a vehicle folder by other means than modeviz, of which it uses nothing.

It reads the folder as docs/vehicle-folder.md says and solves dense equations in one set of coordinates.
Rigid joints leave modes the null space of what they hold, and responses have Lagrange's multipliers.
"""

import csv
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import chain
from pathlib import Path

import numpy as np
import scipy.linalg

G = 9.80665
UNITS = {
    "m": 1.0, "mm": 1e-3, "in": 0.0254, "kg": 1.0, "t": 1e3, "lb": 0.45359237,
    "kg m²": 1.0, "t mm²": 1e-3, "N/m": 1.0, "N/mm": 1e3, "N m/rad": 1.0, "N mm/rad": 1e-3,
    "N s/m": 1.0, "N s/mm": 1e3, "N m s/rad": 1.0, "N mm s/rad": 1e-3, "N": 1.0, "kN": 1e3,
    "m/s²": 1.0, "g": G, "kg m": 1.0, "g m": 1e-3, "m/s": 1.0, "km/h": 1 / 3.6,
}  # fmt: skip
WAYS = {
    "rearward": (0, 1), "forward": (0, -1), "right": (1, 1), "left": (1, -1),
    "up": (2, 1), "down": (2, -1),
}  # fmt: skip
MOTIONS = ("x", "y", "z", "rx", "ry", "rz")
NAMED = {"fore-aft": np.eye(3)[0], "lateral": np.eye(3)[1], "vertical": np.eye(3)[2]}
NONE = (0.0, 0.0, 0.0)


def skew(r):
    """The matrix of r × …"""
    x, y, z = r
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


@dataclass
class Link:
    """Six relative motions of two ends, with what resists each."""

    name: str
    rows: np.ndarray
    stiffness: np.ndarray
    loss: float
    damping: np.ndarray
    is_held: np.ndarray
    axes: np.ndarray
    is_grounded: bool
    wheel: dict | None = None

    def dynamic_stiffness(self, f):
        return self.stiffness * (1 + 1j * self.loss) + 2j * np.pi * f * self.damping

    def pull(self, f, direction):
        """The force when the ground end moves by one along a direction."""
        return self.rows[:3].T @ (self.dynamic_stiffness(f)[:3] * (self.axes @ direction))

    def given(self, direction):
        """How far what is held moves when the ground end moves by one along a direction."""
        return np.r_[self.axes @ direction, np.zeros(3)][self.is_held]


class Folder:
    """A vehicle folder, in SI and in axes x rearward, y right, z up."""

    def __init__(self, path):
        self.path = Path(path)
        self.data = tomllib.loads((self.path / "vehicle.toml").read_text(encoding="utf-8-sig"))
        self.units = self.data.get("units", {})
        self.turn = turn(self.data.get("axes", "x rearward, y right, z up"))
        self._number_bodies()
        self.links = [*self._mounts(), *self._others()]
        self._assemble()
        self._damp_modes()

    def tables(self, key):
        return self.data.get(key, [])

    def unit(self, quantity):
        return UNITS[self.units[quantity]]

    def place(self, values):
        return self.turn @ np.array(values) * self.unit("length")

    def rates(self, values, quantity):
        """Three values along the file's axes, along ours."""
        return (
            np.abs(self.turn) @ np.array(values) * self.unit(quantity) if any(values) else np.zeros(3)
        )

    def vector(self, direction):
        if isinstance(direction, str):
            return NAMED[direction]
        v = self.turn @ np.array(direction)
        return v / np.linalg.norm(v)

    def _number_bodies(self):
        self.bodies, n = {}, 0
        for body in chain(self.tables("flexible_body"), self.tables("rigid_body")):
            own = self._flexible(body) if "modes" in body else self._rigid(body)
            size = len(own["mass"])
            self.bodies[body["name"]] = own | {"slice": slice(n, n + size)}
            n += size
        self.n = n

    def _rigid(self, body):
        moments = np.array(body["inertia"]) * self.unit("inertia")
        inertia = np.diag(moments[:3])
        for (i, j), product in zip(((0, 1), (0, 2), (1, 2)), moments[3:], strict=False):
            inertia[i, j] = inertia[j, i] = -product
        mass = np.zeros((6, 6))
        mass[:3, :3] = np.eye(3) * body["mass"] * self.unit("mass")
        mass[3:, 3:] = self.turn @ inertia @ self.turn.T
        nothing = np.zeros((6, 6))
        points = [(self.place(body["center_of_gravity"]), np.eye(6))]
        return {"mass": mass, "K": nothing, "C": nothing, "K_g": nothing, "points": points}

    def _flexible(self, body):
        units = {**self.units, **body.get("units", {})}
        length, mass = (UNITS[units[q]] for q in ("length", "mass"))
        arrays = np.load(self.path / body["modes"])
        squares = arrays["omega_n_squared"]
        n_normal = len(squares) - int(arrays["n_residuals"])
        last = len(squares) if body.get("residual_vectors", True) else n_normal
        kept = np.r_[0 : body.get("keep_modes", n_normal), n_normal:last]
        points = []
        for position, shape in zip(
            arrays["attachment_positions"], arrays["attachment_shapes"][:, :, kept], strict=True
        ):
            moved = self.turn @ shape[:3] / np.sqrt(mass)
            turned = self.turn @ shape[3:] / np.sqrt(mass) / length
            points.append((self.turn @ position * length, np.vstack([moved, turned])))
        omega_squared = np.r_[np.zeros(6), squares[kept][6:]]
        ratios = np.r_[np.zeros(6), each(body["damping_ratio"], len(kept) - 6)]
        return {
            "mass": np.eye(len(kept)),
            "K": np.diag(omega_squared),
            "C": np.diag(2 * ratios * np.sqrt(omega_squared)),
            "K_g": np.diag(omega_squared) * body.get("loss_factor", 0.0),
            "points": points,
        }

    def motion(self, name, place):
        """Rows (6, n): how a place moves and turns that hangs rigidly on a body's nearest point."""
        rows = np.zeros((6, self.n))
        if name != "ground":
            body = self.bodies[name]
            at, shape = min(body["points"], key=lambda p: np.linalg.norm(p[0] - place))
            rows[:3, body["slice"]] = shape[:3] - skew(place - at) @ shape[3:]
            rows[3:, body["slice"]] = shape[3:]
        return rows

    def _ends(self, table):
        at = table["at"]
        return [self.place(end) for end in (at if len(at) == 2 else (at, at))]

    def _carried(self, name, end, place):
        """A body's motion at its end of a connection, taken to a place by a rigid arm."""
        rows = self.motion(name, end)
        rows[:3] -= skew(place - end) @ rows[3:]
        return rows

    def _link(self, table, along, loss, center=0.5, group=None):
        first, second = self._ends(table)
        place = first + table.get("elastic_center", center) * (second - first)
        a, b = table["bodies"]
        rows = self._carried(a, first, place) - self._carried(b, second, place)
        axes = self.turn @ np.array(table.get("axes", np.eye(3))) @ self.turn.T

        def of(key):
            own = table.get(key, NONE)
            return self.rates(own if any(own) else (group or {}).get(key, NONE), key)

        rigid = table.get("rigid", False)
        names = (MOTIONS if rigid else ()) if isinstance(rigid, bool) else rigid
        held = np.array([m in names for m in MOTIONS], float).reshape(2, 3) @ np.abs(self.turn).T
        return Link(
            table["name"],
            np.vstack([axes @ rows[:3], axes @ rows[3:]]),
            np.r_[along, of("rotational_stiffness")],
            loss,
            np.r_[of("damping"), of("rotational_damping")],
            held.ravel() > 0.5,
            axes,
            b == "ground",
        )

    def _mounts(self) -> Iterator[Link]:
        for group in self.tables("mount_group"):
            # Rates have names, which they keep in all axes.
            named = [group["rates"][d] for d in ("fore_aft", "lateral", "vertical")]
            for mount in group["mount"]:
                along = np.array(named) * self.unit("stiffness")
                yield self._link(mount, along, group["loss_factor"], group=group)

    def _others(self) -> Iterator[Link]:
        for kind in ("spring", "bolt", "damper", "tyre"):
            for table in self.tables(kind):
                along = self.rates(table.get("stiffness", NONE), "stiffness")
                center = 1.0 if kind == "tyre" else 0.5
                link = self._link(table, along, table.get("loss_factor", 0.0), center)
                link.wheel = table if kind == "tyre" else None
                yield link
        for table in self.tables("rod"):
            yield self._rod(table)

    def _rod(self, table):
        (first, second), (a, b) = self._ends(table), table["bodies"]
        axis = (second - first) / np.linalg.norm(second - first)
        rows = np.zeros((6, self.n))
        rows[0] = axis @ (self.motion(a, first) - self.motion(b, second))[:3]
        k, c = ([table.get(q, 0.0) * self.unit(q), *[0.0] * 5] for q in ("stiffness", "damping"))
        held = np.array([table.get("rigid", False), *[False] * 5])
        axes = np.vstack([axis, scipy.linalg.null_space(axis[None]).T])
        loss = table.get("loss_factor", 0.0)
        return Link(table["name"], rows, np.array(k), loss, np.array(c), held, axes, b == "ground")

    def _assemble(self):
        self.M, self.K, self.C, self.K_g = np.zeros((4, self.n, self.n))
        for body in self.bodies.values():
            own = body["slice"], body["slice"]
            self.M[own], self.K[own], self.C[own], self.K_g[own] = (
                body[key] for key in ("mass", "K", "C", "K_g")
            )
        for added in self.tables("added_mass"):
            rows = self.motion(added["body"], self.place(added["at"]))[:3]
            self.M += added["mass"] * self.unit("mass") * rows.T @ rows
        for link in self.links:
            k = link.rows.T @ np.diag(link.stiffness) @ link.rows
            self.K += k
            self.K_g += link.loss * k
            self.C += link.rows.T @ np.diag(link.damping) @ link.rows
        held = np.vstack([np.zeros((0, self.n)), *(link.rows[link.is_held] for link in self.links)])
        size = np.linalg.norm(held, axis=1, keepdims=True)
        held, of_unit = held / np.where(size > 0, size, 1), 1 / np.where(size > 0, size, 1)
        self.held = scipy.linalg.orth(held.T, rcond=1e-10).T
        self.led = np.linalg.pinv(held @ self.held.T) * of_unit.T
        self.free = scipy.linalg.null_space(self.held) if len(self.held) else np.eye(self.n)

    def _undamped(self):
        T = self.free
        squares, y = scipy.linalg.eigh(T.T @ self.K @ T, T.T @ self.M @ T)
        return np.sqrt(np.maximum(squares, 0)), T @ y

    def _ratios(self, omega, phi):
        viscous = np.einsum("ij,ij->j", phi, self.C @ phi)
        structural = np.einsum("ij,ij->j", phi, self.K_g @ phi)
        moves = omega > 1e-3
        return np.where(moves, (viscous * omega + structural) / np.where(moves, 2 * omega**2, 1), 0)

    def _damp_modes(self):
        """Each mode that a table numbers gets what lacks to its ratio, by a damper of its own."""
        omega, phi = self._undamped()
        ratios = self._ratios(omega, phi)
        for table in self.tables("mode_damping"):
            i = table["mode"] - 1
            momentum = self.M @ phi[:, i]
            lacking = table["damping_ratio"] - ratios[i]
            self.C += 2 * omega[i] * lacking * np.outer(momentum, momentum)

    def modes(self):
        """Natural frequencies, Hz, and damping ratios."""
        omega, phi = self._undamped()
        return omega / (2 * np.pi), self._ratios(omega, phi)

    def respond(self, f, force):
        """Coordinates (n, n_inputs) at one frequency.

        Under generalised forces, below which may stand motions of the ground ends of what is held.
        """
        omega, m = 2 * np.pi * f, len(self.held)
        Z = self.K + 1j * self.K_g + 1j * omega * self.C - omega**2 * self.M
        size = np.sqrt(np.abs(np.diag(Z)))
        B = self.held / size
        A = np.zeros((self.n + m, self.n + m), complex)
        A[: self.n, : self.n] = Z / np.outer(size, size)
        of_unit = 1 / np.linalg.norm(B, axis=1, keepdims=True)
        A[self.n :, : self.n] = B * of_unit
        A[: self.n, self.n :] = A[self.n :, : self.n].T
        given = force[self.n :]
        b = np.vstack([force[: self.n] / size[:, None], self.led[:, : len(given)] @ given * of_unit])
        x = np.linalg.solve(A, b)
        x += np.linalg.solve(A, b - A @ x)
        return x[: self.n] / size[:, None]

    def accelerations(self, f, force):
        """Accelerations of x, y, z of every response point, g, (n_points, 3, n_inputs)."""
        x = self.respond(f, force)
        points = self.tables("response_point")
        rows = [self.motion(p["body"], self.place(p["at"]))[:3] for p in points]
        return np.array([-((2 * np.pi * f) ** 2) * row @ x / G for row in rows])

    def psd(self, f, name):
        """Acceleration PSDs under a road or other random load, g²/Hz, (n_points, 3)."""
        roads = [table for table in self.tables("road") if table["name"] == name]
        force, S = self._on_road(f, roads[0]) if roads else self._random(f, name)
        H = self.accelerations(f, force)
        return np.einsum("pdi,ij,pdj->pd", H, S, H.conj()).real

    def harmonic(self, f, name):
        """Peak accelerations under a wheel load or other harmonic load, g, (n_points, 3)."""
        loads = [table for table in self.tables("wheel_load") if table["name"] == name]
        if loads:
            force, peak = self._wheel(f, loads[0]), 1.0
        else:
            force, amplitude, unit = self._load(f, name)
            peak = amplitude * unit
        return np.abs(self.accelerations(f, force[:, None])[..., 0]) * peak

    def _on_road(self, f, table):
        """Forces per unit of both tracks, (n, 2), and their spectrum."""
        speed = self.data["speed"] * self.unit("speed")
        tyres = [link for link in self.links if link.wheel]
        places = [self._ends(link.wheel)[1] for link in tyres]
        front = min(place[0] for place in places)
        force = np.zeros((self.n, 2), complex)
        for link, place in zip(tyres, places, strict=True):
            side = "both" if abs(place[1]) < 1e-3 else "left" if place[1] < 0 else "right"
            track = link.wheel.get("track", side)
            shares = {"left": (1, 0), "right": (0, 1), "both": (0.5, 0.5)}[track]
            delay = np.exp(-2j * np.pi * f * (place[0] - front) / speed)
            force += np.outer(link.pull(f, NAMED["vertical"]), shares) * delay
        own = table["speed"] * self.unit("speed")
        return force, self._tracks(self.columns(table["file"]), f * own / speed) * own / speed

    def _tracks(self, rows, f):
        at, known = np.log(f), np.log(rows["frequency_hz"])
        left, right = (np.exp(np.interp(at, known, np.log(rows[s]))) for s in ("left", "right"))
        cross = rows["cross_real"] + 1j * rows["cross_imag"]
        coherence = np.interp(at, known, cross / np.sqrt(rows["left"] * rows["right"]))
        S_lr = coherence * np.sqrt(left * right)
        return np.array([[left, S_lr], [S_lr.conj(), right]]) * self.unit("length") ** 2

    def _random(self, f, name):
        """Force per unit of another random load, (n, 1), and its spectrum."""
        force, file, unit = self._load(f, name)
        rows = self.columns(file)
        known = np.log(rows["frequency_hz"])
        psd = np.exp(np.interp(np.log(f), known, np.log(rows["psd"]))) * unit**2
        return force[:, None], np.array([[psd]], complex)

    def _load(self, f, name):
        """Force per unit of a force or base motion, its amplitude or file, and the unit of that."""
        for table in self.tables("force"):
            if table["name"] == name:
                rows = self.motion(table["body"], self.place(table["at"]))[:3]
                force = (self.vector(table["direction"]) @ rows).astype(complex)
                return force, table.get("psd") or table["amplitude"], self.unit("force")
        table = next(t for t in self.tables("base_motion") if t["name"] == name)
        moved = table.get("connections") or [link.name for link in self.links if link.is_grounded]
        direction = self.vector(table["direction"])
        force = sum(link.pull(f, direction) for link in self.links if link.name in moved)
        ends = [(link.name in moved) * link.given(direction) for link in self.links]
        force = np.concatenate([force, *ends])
        key = next(k for k in table if k.startswith(("displacement", "acceleration")))
        if key.startswith("displacement"):
            return force, table[key], self.unit("length")
        return -force / (2 * np.pi * f) ** 2, table[key], self.unit("acceleration")

    def _wheel(self, f, load):
        tyre = next(link.wheel for link in self.links if link.name == load["tyre"])
        wheel, center = tyre["bodies"][0], self.place(tyre["wheel_center"])
        at_center = self.motion(wheel, center)
        if load["kind"] == "unbalance":
            amplitude = load["amplitude"] * self.unit("unbalance") * (2 * np.pi * f) ** 2
            return amplitude * (at_center[2] + 1j * at_center[0])
        amplitude = load["amplitude"] * self.unit("force")
        if load["kind"] == "radial force":
            return amplitude * at_center[2].astype(complex)
        patch = np.array([center[0] + tyre.get("trail", 0.0) * self.unit("length"), center[1], 0.0])
        return amplitude * self.motion(wheel, patch)[1].astype(complex)

    def columns(self, name):
        with (self.path / name).open(encoding="utf-8-sig", newline="") as file:
            header, *lines = csv.reader(file)
        return dict(zip(header, np.array(lines, float).T, strict=True))


def turn(text):
    """The matrix from a file's axes to ours."""
    T = np.zeros((3, 3))
    for part in text.split(","):
        axis, word = part.split()
        line, sign = WAYS[word]
        T[line, "xyz".index(axis)] = sign
    return T


def each(ratios, n):
    """A damping ratio for each of n elastic modes; the last of a list holds for all above it."""
    given = ratios if isinstance(ratios, list) else [ratios]
    return np.array([given[min(i, len(given) - 1)] for i in range(n)])
