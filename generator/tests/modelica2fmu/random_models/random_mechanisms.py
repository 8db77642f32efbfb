"""Random trees of bodies and joints of ``Modelica.Mechanics.MultiBody``, with forces and sensors, and their motion."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from mechanism_joints import Chooser, Joint, X, Y, random_joint, turn, turned, vector
from mechanism_motion import Condition, Load, Look, Mass, Mechanism, Place, Pose, Vector, mass_at
from scipy.spatial.transform import Rotation

DISTANCE_APART = 0.3  # of the ends of line forces at the start


@dataclass(frozen=True)
class RandomMechanism:
    """A package P with a model M, its variables, and their values in a motion."""

    text: str
    names: Sequence[str]
    values: Callable[[Look], Vector]
    motion: Callable[[Sequence[float]], Sequence[Look]]


@dataclass(frozen=True)
class Frame:
    """A connector and where it is."""

    name: str
    place: Place


class _Writer:
    def __init__(self, seed: int) -> None:
        self.choose = Chooser(seed)
        self.lines: list[str] = []
        self.connections: list[str] = []
        self.frames: list[Frame] = [Frame("world.frame_b", Place(None, np.zeros(3), np.eye(3)))]
        self.bodies: list[str] = []
        self.starts: list[Callable[[Sequence[Pose], float], Pose]] = []
        self.watched: dict[str, Callable[[Look], float]] = {}
        self.has_points = False
        self.mechanism = Mechanism(lambda _: np.zeros(3))

    # ----- parts -----

    def declare(self, kind: str, name: str, text: str) -> None:
        self.lines.append(f"    {kind} {name}({text});" if text else f"    {kind} {name};")

    def connect(self, first: str, second: str) -> None:
        pair = (first, second) if self.choose.random() < 0.7 else (second, first)
        self.connections.append(f"    connect({pair[0]}, {pair[1]});")

    def rigid(self, frame: Frame) -> Frame:
        """Often a frame beside another one."""
        choice, r, name = self.choose.random(), self.choose.arm(), f"f{len(self.lines)}"
        if choice < 0.4:
            return frame
        if choice < 0.7:
            self.declare("MB.Parts.FixedTranslation", name, f"r={vector(r)}, animation=false")
            place, moved = frame.place, (r, np.eye(3))
        else:
            n, angle = self.choose.direction(), self.choose.within(-120, 120)
            self.declare(
                "MB.Parts.FixedRotation", name, f"r={vector(r)}, n={vector(n)}, angle={angle}, animation=false"
            )
            place, moved = frame.place, (r, turn(n, np.radians(angle)))
        if self.choose.random() < 0.7:
            self.connect(frame.name, f"{name}.frame_a")
            return Frame(f"{name}.frame_b", place.moved(*moved))
        self.connect(frame.name, f"{name}.frame_b")
        return Frame(f"{name}.frame_a", place.moved(-moved[1].T @ moved[0], moved[1].T))

    def body(self) -> None:
        """A body, and what holds it."""
        number_of, name = len(self.bodies), f"b{len(self.bodies)}"
        is_loose = self.choose.random() < 0.12
        kind, text, mass, end = self.kind_of_body()
        own = Place(number_of, np.zeros(3), np.eye(3))
        self.mechanism.masses.append(mass)
        self.bodies.append(name)
        if is_loose:
            start, orientation = turned(self.choose, "0")
            r, v = self.choose.arm(1.0), self.choose.arm()
            start = f"r_0(fixed=true, start={vector(r)}), v_0(fixed=true, start={vector(v)}), {start}"
            self.declare(f"MB.Parts.{kind}", name, f"{text}, {start}, animation=false")
            # Angular velocities at the start are in the axes of the world here.
            self.starts.append(lambda _, t: (r + v * t, orientation(t)))
        else:
            self.declare(f"MB.Parts.{kind}", name, f"{text}, animation=false")
            self.hold(number_of, Frame(f"{name}.frame_a", own), end)
        self.frames.append(Frame(f"{name}.frame_a", own))
        if end is not None:
            self.frames.append(Frame(f"{name}.frame_b", own.moved(end, np.eye(3))))
        for index, axis in enumerate("123"):
            self.watched[f"{name}.frame_a.r_0[{axis}]"] = lambda look, k=index: look(own).r[k]
            self.watched[f"{name}.frame_a.R.T[{axis},1]"] = lambda look, k=index: look(own).axes[0, k]
            self.watched[f"{name}.frame_a.R.T[2,{axis}]"] = lambda look, k=index: look(own).axes[k, 1]

    def kind_of_body(self) -> tuple[str, str, Mass, Vector | None]:
        choice, end = self.choose.random(), self.choose.arm()
        if np.linalg.norm(end) < 0.1:
            end = np.array([0.3, 0.0, 0.1])
        if choice < 0.7:
            m, center = self.choose.within(0.4, 3), self.choose.arm(0.3)
            root = np.array([[self.choose.within(-0.2, 0.2) for _ in range(3)] for _ in range(3)])
            inertia = np.round(m * (root @ root.T + 0.01 * np.eye(3)), 3)
            # An inertia of masses somewhere: no moment exceeds the sum of the others.
            inertia = np.round(np.trace(inertia) * np.eye(3) - inertia, 3)
            text = f"m={m}, r_CM={vector(center)}, I_11={inertia[0, 0]:.3f}, I_22={inertia[1, 1]:.3f}, "
            text += f"I_33={inertia[2, 2]:.3f}, I_21={inertia[1, 0]:.3f}, I_31={inertia[2, 0]:.3f}, "
            text += f"I_32={inertia[2, 1]:.3f}"
            mass = mass_at(m, center, inertia)
            return ("Body", text, mass, None) if choice < 0.35 else ("BodyShape", f"r={vector(end)}, {text}", mass, end)
        length, density = float(np.linalg.norm(end)), self.choose.within(500, 3000)
        unit, width = end / length, self.choose.within(0.05, 0.15)
        if choice < 0.85:
            height = self.choose.within(0.03, 0.1)
            m = density * length * width * height
            principal = m / 12 * np.array([width**2 + height**2, length**2 + height**2, length**2 + width**2])
            text = f"r={vector(end)}, width={width}, height={height}, density={density}"
        else:
            m = density * np.pi * width**2 / 4 * length
            side = m * (3 * width**2 / 4 + length**2) / 12
            principal = np.array([m * width**2 / 8, side, side])
            text = f"r={vector(end)}, diameter={width}, density={density}"
        z = np.cross(unit, Y if np.linalg.norm(np.cross(unit, Y)) > 1e-6 else X)
        z = z / np.linalg.norm(z)
        axes = np.column_stack([unit, np.cross(z, unit), z])
        kind = "BodyBox" if choice < 0.85 else "BodyCylinder"
        return kind, text, mass_at(m, end / 2, axes @ np.diag(principal) @ axes.T), end

    def hold(self, number_of: int, own: Frame, end: Vector | None) -> None:
        """Joins a body to a frame that is there already; the joint may lie either way round."""
        parent = self.rigid(self.choose.choice(self.frames))
        if end is not None and self.choose.random() < 0.3:
            child = self.rigid(Frame(own.name.replace("frame_a", "frame_b"), own.place.moved(end, np.eye(3))))
        else:
            child = self.rigid(own)
        joint, name, is_reversed = random_joint(self.choose), f"j{number_of}", self.choose.random() < 0.3
        first, second = (child, parent) if is_reversed else (parent, child)
        text = joint.text
        if joint.axis is not None and self.choose.random() < 0.5:
            text += ", useAxisFlange=true"
            self.drive(name, joint, first.place, second.place)
        self.declare(f"MB.Joints.{joint.kind}", name, f"{text}, animation=false")
        self.connect(first.name, f"{name}.frame_a")
        self.connect(f"{name}.frame_b", second.name)
        for kind, a, b in joint.conditions:
            self.mechanism.conditions.append(Condition(kind, first.place, second.place, a, b))

        def start(poses: Sequence[Pose], time: float) -> Pose:
            at, axes = (np.zeros(3), np.eye(3)) if parent.place.body is None else poses[parent.place.body]
            at, axes = at + axes @ parent.place.origin, axes @ parent.place.axes
            r, rotation = joint.step(time)
            if is_reversed:
                r, rotation = -rotation.T @ r, rotation.T
            at, axes = at + axes @ r, axes @ rotation
            axes = axes @ child.place.axes.T
            return at - axes @ child.place.origin, axes

        self.starts.append(start)

    # ----- forces -----

    def drive(self, name: str, joint: Joint, first: Place, second: Place) -> None:
        """Spring, damper or given force at the flanges of a joint."""
        choose = self.choose
        assert joint.axis is not None
        axis = joint.axis / np.linalg.norm(joint.axis)
        is_turning = joint.kind == "Revolute"
        library, rest = ("MR", "phi_rel0") if is_turning else ("MT", "s_rel0")
        kind, c, d, free = (
            choose.random(),
            self.choose.within(1, 30),
            self.choose.within(0.1, 1.5),
            self.choose.within(-0.2, 0.2),
        )
        amplitude, frequency = self.choose.within(0.5, 3), self.choose.within(0.3, 1.5)
        drive = f"d{name}"
        if kind < 0.4:
            self.declare(f"{library}.Components.SpringDamper", drive, f"c={c}, d={d}, {rest}={free}")
        elif kind < 0.7:
            self.declare(f"{library}.Components.Damper", drive, f"d={d}")
            c = 0.0
        else:
            source = "Torque" if is_turning else "Force"
            self.declare(f"{library}.Sources.{source}", drive, "useSupport=true")
            self.declare("Modelica.Blocks.Sources.Sine", f"s{name}", f"amplitude={amplitude}, f={frequency}")
            self.connections.append(f"    connect(s{name}.y, {drive}.{'tau' if is_turning else 'f'});")
            self.connect(f"{drive}.flange", f"{name}.axis")
            self.connect(f"{drive}.support", f"{name}.support")
        if kind < 0.7:
            self.connect(f"{drive}.flange_a", f"{name}.support")
            self.connect(f"{drive}.flange_b", f"{name}.axis")
        number_of = len(self.mechanism.turning)
        if is_turning:
            self.mechanism.turning.append((first, second, axis, joint.start))

        def force(time: float, look: Look, angles: Vector) -> Sequence[Load]:
            a, b = look(first), look(second)
            along = a.axes @ axis
            if kind >= 0.7:
                size = amplitude * np.sin(2 * np.pi * frequency * time)
            elif is_turning:
                size = -c * (angles[number_of] - free) - d * along @ (b.w - a.w)
            else:
                rate = along @ (b.v - a.v - np.cross(a.w, b.r - a.r))
                size = -c * (along @ (b.r - a.r) - free) - d * rate
            if is_turning:
                return [
                    Load(second.body, b.r, 0 * along, size * along),
                    Load(first.body, b.r, 0 * along, -size * along),
                ]
            return [Load(second.body, b.r, size * along, 0 * along), Load(first.body, b.r, -size * along, 0 * along)]

        self.mechanism.forces.append(force)

    def line_force(self, poses: Sequence[Pose]) -> None:
        first, second = self.choose.sample(self.frames, 2)
        look = self.at_start(poses)
        a, b = look(first.place), look(second.place)
        if first.place.body == second.place.body or np.linalg.norm(b.r - a.r) < DISTANCE_APART:
            return
        name, c, d, rest = (
            f"l{len(self.lines)}",
            self.choose.within(5, 60),
            self.choose.within(0.2, 3),
            self.choose.within(0.1, 0.6),
        )
        kind = self.choose.choice(["Spring", "Damper", "SpringDamperParallel"])
        text = {"Spring": f"c={c}, s_unstretched={rest}", "Damper": f"d={d}"}.get(
            kind, f"c={c}, d={d}, s_unstretched={rest}"
        )
        self.declare(f"MB.Forces.{kind}", name, f"{text}, animation=false")
        self.connect(first.name, f"{name}.frame_a")
        self.connect(second.name, f"{name}.frame_b")
        c, d = (0.0 if kind == "Damper" else c), (0.0 if kind == "Spring" else d)

        def force(_: float, look: Look, __: Vector) -> Sequence[Load]:
            a, b = look(first.place), look(second.place)
            away = b.r - a.r
            length = float(np.linalg.norm(away))
            pull = (c * (length - rest) + d * away @ (b.v - a.v) / length) * away / length
            none = np.zeros(3)
            return [Load(first.place.body, a.r, pull, none), Load(second.place.body, b.r, -pull, none)]

        self.mechanism.forces.append(force)

    def given_force(self) -> None:
        """A constant or swinging force or torque, between frames or from the world."""
        choose = self.choose
        kind = choose.choice(["WorldForce", "WorldTorque", "Force", "Torque"])
        is_between, is_force = kind in ("Force", "Torque"), kind.endswith("Force")
        first, second = choose.sample(self.frames, 2)
        if second.place.body is None:
            first, second = second, first
        resolved = choose.choice(["world", "frame_b", *(["frame_a"] if is_between else [])])
        name, size, swing = f"g{len(self.lines)}", self.choose.arm(1.0 if is_force else 0.05), choose.random() < 0.5
        types = "ResolveInFrameAB" if is_between else "ResolveInFrameB"
        self.declare(f"MB.Forces.{kind}", name, f"resolveInFrame=MB.Types.{types}.{resolved}, animation=false")
        for k in range(3):
            block = f"Sine {name}s{k + 1}(amplitude={size[k]}, f=0.7, phase=0.4)"
            constant = f"Constant {name}s{k + 1}(k={size[k]})"
            self.lines.append(f"    Modelica.Blocks.Sources.{block if swing else constant};")
            self.connections.append(
                f"    connect({name}s{k + 1}.y, {name}.{'force' if is_force else 'torque'}[{k + 1}]);"
            )
        self.connect(second.name, f"{name}.frame_b")
        if is_between:
            self.connect(first.name, f"{name}.frame_a")

        def force(time: float, look: Look, _: Vector) -> Sequence[Load]:
            a, b = look(first.place), look(second.place)
            axes = {"world": np.eye(3), "frame_a": a.axes, "frame_b": b.axes}[resolved]
            value = axes @ size * (np.sin(2 * np.pi * 0.7 * time + 0.4) if swing else 1.0)
            parts = (value, 0 * value) if is_force else (0 * value, value)
            loads = [Load(second.place.body, b.r, *parts)]
            return [*loads, Load(first.place.body, b.r, -parts[0], -parts[1])] if is_between else loads

        self.mechanism.forces.append(force)

    def point_mass(self) -> None:
        frame = self.choose.choice(self.frames)
        m, name = self.choose.within(0.2, 1), f"m{len(self.lines)}"
        if frame.place.body is None:
            return
        self.declare("MB.Parts.PointMass", name, f"m={m}, animation=false")
        self.connect(frame.name, f"{name}.frame_a")
        k = frame.place.body
        self.mechanism.masses[k] = self.mechanism.masses[k].plus(mass_at(m, frame.place.origin, np.zeros((3, 3))))
        self.has_points = True

    def sensor(self) -> None:
        first, second = self.choose.sample(self.frames, 2)
        kind = self.choose.choice(["RelativePosition", "RelativeVelocity", "RelativeAngularVelocity"])
        name = f"e{len(self.lines)}"
        resolved = self.choose.choice(["world", "frame_a", "frame_b"])
        types = f"MB.Types.ResolveInFrameAB.{resolved}"
        self.declare(f"MB.Sensors.{kind}", name, f"resolveInFrame={types}")
        self.connect(first.name, f"{name}.frame_a")
        self.connect(second.name, f"{name}.frame_b")
        output = {"RelativePosition": "r_rel", "RelativeVelocity": "v_rel", "RelativeAngularVelocity": "w_rel"}[kind]

        def value(look: Look) -> Vector:
            a, b = look(first.place), look(second.place)
            axes = {"world": np.eye(3), "frame_a": a.axes, "frame_b": b.axes}[resolved]
            # The rate of the relative position in frame_a, as it is seen there.
            seen = {"r_rel": b.r - a.r, "v_rel": b.v - a.v - np.cross(a.w, b.r - a.r), "w_rel": b.w - a.w}[output]
            return np.asarray(axes.T @ seen)

        for k in range(3):
            self.watched[f"{name}.{output}[{k + 1}]"] = lambda look, k=k: float(value(look)[k])

    # ----- all -----

    def poses(self, time: float) -> list[Pose]:
        poses: list[Pose] = []
        for start in self.starts:
            poses.append(start(poses, time))
        return poses

    def at_start(self, poses: Sequence[Pose]) -> Look:
        pose = np.concatenate([np.append(r, Rotation.from_matrix(axes).as_quat()) for r, axes in poses])
        return self.mechanism.look(pose, np.zeros(6 * len(poses)))

    def world(self) -> str:
        choice, n, g = self.choose.random(), self.choose.direction(), self.choose.within(1, 12)
        if choice < 0.15:
            return "gravityType=MB.Types.GravityTypes.NoGravity"
        if choice < 0.3 and not self.has_points:
            mu = self.choose.within(0.3, 1)
            origin_apart = 1e-3
            self.mechanism.gravity = lambda r: -mu * r / max(float(np.linalg.norm(r)), origin_apart) ** 3
            return f"gravityType=MB.Types.GravityTypes.PointGravity, mu={mu}"
        self.mechanism.gravity = lambda _: g * n / np.linalg.norm(n)
        return f"g={g}, n={vector(n)}"

    def write(self) -> RandomMechanism:
        choose = self.choose
        for _ in range(choose.choice([1, 2, 2, 3, 3, 4, 5])):
            self.body()
        poses = self.poses(0.0)
        for _ in range(choose.choice([0, 1, 1, 2])):
            self.line_force(poses)
        for part, chance in ((self.given_force, 0.4), (self.point_mass, 0.3), (self.sensor, 0.5), (self.sensor, 0.3)):
            if choose.random() < chance:
                part()
        world = self.world()
        choose.shuffle(self.lines)
        choose.shuffle(self.connections)
        text = "\n".join(
            [
                "package P",
                "  import MB = Modelica.Mechanics.MultiBody;",
                "  import MR = Modelica.Mechanics.Rotational;",
                "  import MT = Modelica.Mechanics.Translational;",
                "  model M",
                f"    inner MB.World world({world}, enableAnimation=false);",
                *self.lines,
                "  equation",
                *self.connections,
                "  end M;",
                "end P;",
                "",
            ]
        )
        names = list(self.watched)
        functions = list(self.watched.values())
        return RandomMechanism(
            text,
            names,
            lambda look: np.array([each(look) for each in functions]),
            lambda times: self.mechanism.motion(self.poses, times),
        )


def random_mechanism(seed: int) -> RandomMechanism:
    """The mechanism of a seed."""
    return _Writer(seed).write()
