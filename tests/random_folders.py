"""Vehicle folders with random content, written without the writer of modeviz."""

import json
from pathlib import Path

import numpy as np
from independent_solver import MOTIONS, UNITS, skew, turn

AXES = (
    "x rearward, y right, z up",
    "x forward, y left, z up",
    "x forward, y right, z down",
    "x right, y forward, z up",
)
CHOICES = {
    "length": ("m", "mm", "in"),
    "mass": ("kg", "t", "lb"),
    "inertia": ("kg m²", "t mm²"),
    "stiffness": ("N/m", "N/mm"),
    "rotational_stiffness": ("N m/rad", "N mm/rad"),
    "damping": ("N s/m", "N s/mm"),
    "rotational_damping": ("N m s/rad", "N mm s/rad"),
    "force": ("N", "kN"),
    "acceleration": ("m/s²", "g"),
    "unbalance": ("kg m", "g m"),
    "speed": ("m/s", "km/h"),
}


class RandomFolder:
    """One flexible and four rigid bodies with every kind of connection and load."""

    def __init__(self, path: Path, seed: int):
        self.path, self.rng = path, np.random.default_rng(seed)
        self.axes = AXES[seed % len(AXES)]
        self.turn = turn(self.axes)
        self.units = {q: self.rng.choice(units).item() for q, units in CHOICES.items()}
        self.bodies = {
            name: self.rng.uniform(-1, 1, 3) + np.array([0, 0, 1.5])
            for name in ("cab", "engine", "axle", "table")
        }
        self.frame = self.rng.uniform(-1, 1, (8, 3)) * [1.5, 0.6, 0.3] + [0, 0, 1]
        path.mkdir(parents=True, exist_ok=True)
        (path / "vehicle.toml").write_text(self._text(seed), encoding="utf-8")

    def value(self, number, quantity):
        return float(number / UNITS[self.units[quantity]])

    def values(self, numbers, quantity):
        return [self.value(number, quantity) for number in numbers]

    def place(self, position):
        return self.values(self.turn.T @ position, "length")

    def any(self, low, high, size=None):
        """Evenly spread by order of magnitude."""
        return np.exp(self.rng.uniform(np.log(low), np.log(high), size))

    def some(self, low, high, quantity):
        """Three values of which some are zero."""
        return self.values(self.any(low, high, 3) * (self.rng.random(3) < 0.7), quantity)

    def frame_axes(self):
        return np.linalg.qr(self.rng.normal(size=(3, 3)))[0].tolist()

    def end(self, body):
        """A place where something can hold on to a body."""
        if body == "frame":
            return self.rng.choice(self.frame) + self.rng.uniform(-0.03, 0.03, 3)
        if body == "ground":
            return self.rng.uniform(-1, 1, 3) * [1, 1, 0]
        return self.bodies[body] + self.rng.uniform(-0.4, 0.4, 3)

    def ends(self, a, b, gap):
        first = self.end(a) if a == "frame" else self.end(b) if b == "frame" else self.end(a)
        other = first + self.rng.uniform(-0.03, 0.03, 3) if "frame" in (a, b) else self.end(b)
        return [self.place(first), self.place(other)] if gap else self.place(first)

    def _text(self, seed):
        lines = [
            f'name = "random {seed}"',
            f'axes = "{self.axes}"',
            f"speed = {self.value(23.0, 'speed')}",
            f"highest_frequency = {self.rng.choice([30.0, 50.0])}",
            f"frequency_step = {self.rng.choice([0.1, 0.08])}",
        ]
        for key, table in self._tables():
            lines += [f"[{key}]" if key == "units" else f"[[{key}]]"]
            lines += [f"{name} = {toml(value)}" for name, value in table.items()]
        return "\n".join(lines) + "\n"

    def _tables(self):
        yield "units", self.units
        yield "flexible_body", self._flexible()
        for name in self.bodies:
            yield "rigid_body", self._rigid(name)
        yield "added_mass", {
            "name": "driver", "body": "cab", "at": self.place(self.end("cab")),
            "mass": self.value(80.0, "mass"),
        }  # fmt: skip
        yield from self._mounts()
        yield from self._connections()
        yield from self._tyres()
        for body in ("cab", "frame"):
            yield (
                "response_point",
                {"name": f"on {body}", "body": body, "at": self.place(self.end(body))},
            )
        yield from self._loads()
        yield "mode_damping", {"mode": 9, "damping_ratio": 0.9}

    def _rigid(self, name):
        square = self.rng.normal(size=(3, 3))
        body = square @ square.T + 0.2 * np.eye(3)
        # Of a cloud of mass with these moments, so that no inertia is impossible.
        inertia = self.turn.T @ (np.trace(body) * np.eye(3) - body) @ self.turn
        products = -inertia[[0, 0, 1], [1, 2, 2]]
        return {
            "name": name,
            "role": "unsprung" if name == "axle" else "other",
            "mass": self.value(self.any(50, 400), "mass"),
            "center_of_gravity": self.place(self.bodies[name]),
            "inertia": self.values(9 * np.r_[np.diag(inertia), products], "inertia"),
        }

    def _flexible(self):
        """Rigid modes of a mass and an inertia, elastic ones of any shape."""
        n_elastic, n_residuals, mass, center = 9, 2, 300.0, self.frame.mean(axis=0)
        inertia = np.diag(self.rng.uniform(40, 90, 3))
        L = np.linalg.inv(np.linalg.cholesky(inertia)).T
        shapes = np.empty((8, 6, 6 + n_elastic + n_residuals))
        for shape, position in zip(shapes, self.frame, strict=True):
            shape[:, :6] = 0.0
            shape[:3, :3] = np.eye(3) / np.sqrt(mass)
            shape[:3, 3:6] = -skew(position - center) @ L
            shape[3:, 3:6] = L
            shape[:, 6:] = self.rng.normal(size=(6, n_elastic + n_residuals)) / np.sqrt(mass)
        squares = np.sort(2 * np.pi * self.any(4, 60, n_elastic + n_residuals)) ** 2
        own = {"length": "mm", "mass": "t"}
        in_mass = np.sqrt(UNITS[own["mass"]])
        blocks = [shapes[:, :3] * in_mass, shapes[:, 3:] * in_mass * UNITS[own["length"]]]
        in_file = np.concatenate(
            [np.einsum("ji,ajm->aim", self.turn, block) for block in blocks], axis=1
        )
        positions = self.frame @ self.turn / UNITS[own["length"]]
        np.savez(
            self.path / "frame.npz",
            omega_n_squared=np.r_[np.full(6, 1e-6), squares],
            n_residuals=np.array(n_residuals),
            attachment_names=np.array([f"point {i}" for i in range(8)]),
            attachment_positions=positions,
            attachment_shapes=in_file,
            nodes=positions,
            shapes=in_file,
        )
        return {
            "name": "frame", "role": "frame", "modes": "frame.npz",
            "damping_ratio": [0.01, 0.02, 0.03], "loss_factor": 0.02, "keep_modes": 13,
        } | {"units": own}  # fmt: skip

    def _mounts(self):
        pairs = ("cab", "frame"), ("engine", "frame"), ("engine", "ground"), ("table", "cab")
        for number, (a, b) in enumerate(pairs):
            rates = dict(
                zip(
                    ("vertical", "lateral", "fore_aft"),
                    self.values(self.any(5e4, 9e5, 3), "stiffness"),
                    strict=True,
                )
            )
            yield "mount_group", {
                "name": f"M{number}", "rates": rates, "loss_factor": float(self.rng.uniform(0.05, 0.3)),
                "rotational_stiffness": self.some(10, 500, "rotational_stiffness"),
                "damping": self.some(10, 500, "damping"),
                "rotational_damping": self.some(1, 20, "rotational_damping"),
            }  # fmt: skip
            for side in range(3):
                yield (
                    "mount_group.mount",
                    self._joint(f"M{number}.{side}", a, b)
                    | {"rotational_stiffness": self.some(10, 500, "rotational_stiffness")},
                )

    def _joint(self, name, a, b, gap=True):
        return {
            "name": name, "bodies": [a, b], "at": self.ends(a, b, gap), "axes": self.frame_axes(),
            "elastic_center": float(self.rng.uniform(0, 1)),
        }  # fmt: skip

    def _connections(self):
        for number, (a, b) in enumerate((("axle", "frame"), ("axle", "frame"), ("frame", "ground"))):
            yield (
                "spring",
                self._joint(f"spring {number}", a, b)
                | {
                    "stiffness": self.some(1e4, 1e6, "stiffness"),
                    "rotational_stiffness": self.some(10, 900, "rotational_stiffness"),
                    "damping": self.some(10, 2e3, "damping"),
                    "rotational_damping": self.some(1, 90, "rotational_damping"),
                    "loss_factor": 0.07,
                },
            )
        yield "spring", self._joint("ball joint", "axle", "engine") | {"rigid": ["x", "z"]}
        yield "spring", self._joint("slide", "frame", "ground") | {
            "rigid": ["y"], "stiffness": [self.value(4e5, "stiffness"), 0, 0],
        }  # fmt: skip
        yield "bolt", self._joint("bolt", "cab", "engine") | {"rigid": self._rigidly()}
        yield "bolt", self._joint("anchor", "table", "ground") | {"rigid": True}
        yield (
            "damper",
            self._joint("shock absorber", "axle", "frame")
            | {"damping": self.values(self.any(100, 3e3, 3), "damping")},
        )
        rod = {"name": "tie rod", "bodies": ["axle", "cab"], "at": self.ends("axle", "cab", gap=True)}
        yield "rod", rod | {
            "stiffness": self.value(3e5, "stiffness"), "damping": self.value(200, "damping"),
            "loss_factor": 0.03,
        }  # fmt: skip
        yield "rod", rod | {"name": "stay", "at": self.ends("cab", "ground", gap=True), "rigid": True,
                            "bodies": ["cab", "ground"]}  # fmt: skip

    def _rigidly(self):
        """Some of the motions of a joint, in an order of no meaning."""
        return self.rng.permutation(MOTIONS)[: self.rng.integers(1, 4)].tolist()

    def _tyres(self):
        tracks = ({}, {"track": "right"}, {"track": "both"})
        for number, y in enumerate((-0.8, 0.8, 0.0)):
            patch = np.array([0.9 * number, y, 0.0])
            yield "tyre", {
                "name": f"tyre {number}", "bodies": ["axle", "ground"], "at": self.place(patch),
                "axes": self.frame_axes(), "stiffness": self.values(self.any(5e4, 3e5, 3), "stiffness"),
                "damping": self.values([50, 60, 70], "damping"), "loss_factor": 0.04,
                "wheel_center": self.place(patch + np.array([0.0, 0.0, 0.35])),
                "trail": self.value(0.03, "length"),
            } | tracks[self.rng.integers(3)]  # fmt: skip

    def _loads(self):
        f = np.geomspace(0.04, 90, 60)
        left, right = (1e-5 * f**-2.0 * np.exp(0.3 * self.rng.normal(size=60)) for _ in range(2))
        cross = self.rng.uniform(0, 0.95, 60) * np.sqrt(left * right) * np.exp(1j * f / 9)
        self._csv(
            "road.csv",
            "frequency_hz,left,right,cross_real,cross_imag",
            f,
            left,
            right,
            cross.real,
            cross.imag,
        )
        self._csv("psd.csv", "frequency_hz,psd", f, self.any(1e-4, 1e-2, 60))
        yield "road", {"name": "road", "file": "road.csv", "speed": self.value(20.0, "speed")}
        kinds = (
            ("unbalance", "unbalance", 0.02),
            ("radial force", "force", 60),
            ("lateral force", "force", 40),
        )
        for kind, quantity, amplitude in kinds:
            yield (
                "wheel_load",
                {
                    "name": kind,
                    "kind": kind,
                    "tyre": "tyre 0",
                    "amplitude": self.value(amplitude, quantity),
                },
            )
        direction = self.rng.normal(size=3).tolist()
        place = self.place(self.end("cab"))
        yield "force", {"name": "shaker", "body": "cab", "at": place, "direction": direction,
                        "amplitude": self.value(30.0, "force")}  # fmt: skip
        yield "force", {"name": "wind", "body": "frame", "at": self.place(self.end("frame")),
                        "direction": "lateral", "psd": "psd.csv"}  # fmt: skip
        moved = ["spring 2", "M2.0", "tyre 1", "anchor", "slide", "stay"]
        yield "base_motion", {"name": "post", "connections": moved, "direction": direction,
                              "displacement": self.value(2e-3, "length")}  # fmt: skip
        yield "base_motion", {"name": "table", "connections": [*moved, "M2.1", "M2.2"],
                              "direction": "vertical",
                              "acceleration": self.value(1.5, "acceleration")}  # fmt: skip
        yield "base_motion", {"name": "quake", "connections": moved, "direction": direction,
                              "acceleration_psd": "psd.csv"}  # fmt: skip
        yield "base_motion", {"name": "tremor", "connections": moved, "direction": "fore-aft",
                              "displacement_psd": "psd.csv"}  # fmt: skip

    def _csv(self, name, header, *columns):
        lines = [header, *(",".join(map(repr, row)) for row in np.column_stack(columns).tolist())]
        (self.path / name).write_text("\n".join(lines) + "\n", encoding="utf-8")


def toml(value):
    """A value of a key as TOML has it."""
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {toml(inner)}" for key, inner in value.items()) + " }"
    return json.dumps(value, ensure_ascii=False)


def random_folder(path: Path, seed: int) -> Path:
    """A folder of its own for each seed."""
    RandomFolder(path, seed)
    return path
