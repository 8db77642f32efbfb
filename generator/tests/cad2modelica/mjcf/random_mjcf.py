"""Models of MuJoCo drawn at random: places, masses and joints in all ways that the format has for them."""

from __future__ import annotations

import random

SIZES = {"sphere": 1, "capsule": 2, "cylinder": 2, "box": 3, "ellipsoid": 3}
DEFAULTS = {
    "geom": ('type="box"', 'density="500"', 'mass="2"', 'size="0.2 0.1 0.15"'),
    "joint": ('armature="0.3"', 'stiffness="2"', 'damping="0.4"', 'axis="1 0 0"', 'pos="0.1 0.2 0.3"'),
}
MESH = 'vertex="0 0 0  0.4 0 0  0 0.5 0  0 0 0.3"'
FACES = 'face="0 2 1  0 1 3  0 3 2  1 2 3"'


def draw_model(seed: int) -> str:
    """A model without contacts."""
    return _Draw(random.Random(f"mjcf {seed}")).model()


class _Draw:
    def __init__(self, draw: random.Random) -> None:
        self._draw = draw
        self._count = 0
        self._classes: list[str] = []
        self._turn = 1.0 if draw.random() < 0.5 else 57.3  # a radian in the model's unit

    def model(self) -> str:
        chance = self._draw.random
        compiler = ['angle="radian"'] if self._turn == 1.0 else []
        if chance() < 0.5:
            compiler.append(f'eulerseq="{"".join(self._draw.choice("xyzXYZ") for _ in range(3))}"')
        for words in ('inertiafromgeom="true"', 'settotalmass="7"', 'balanceinertia="true"', 'boundinertia="0.05"'):
            compiler += [words] if chance() < 0.2 else []
        defaults = self._defaults() if chance() < 0.7 else ""
        bodies = "".join(self._body(self._draw.randrange(3), top=True) for _ in range(self._draw.randint(1, 2)))
        meshes = self._mesh("m1", FACES) + self._mesh("m2", FACES) + self._mesh("m3", "")
        return (
            f"<mujoco><compiler {' '.join(compiler)}/>{defaults}<asset>{meshes}</asset>"
            f"<worldbody>{bodies}</worldbody></mujoco>"
        )

    # ----- values -----

    def _some(self, count: int, size: float = 1.0) -> str:
        return " ".join(f"{self._draw.uniform(-size, size):.4f}" for _ in range(count))

    def _lengths(self, count: int) -> str:
        return " ".join(f"{self._draw.uniform(0.05, 0.3):.4f}" for _ in range(count))

    def _turned(self) -> str:
        ways = (
            f'quat="{self._some(4)}"',
            f'axisangle="{self._some(3)} {self._draw.uniform(-3, 3) * self._turn:.4f}"',
            f'euler="{self._some(3, 3 * self._turn)}"',
            f'xyaxes="{self._some(6)}"',
            f'zaxis="{self._some(3)}"',
            "",
        )
        return self._draw.choice(ways)

    def _class(self, key: str) -> str:
        return f'{key}="{self._draw.choice(self._classes)}"' if self._classes and self._draw.random() < 0.25 else ""

    # ----- default classes and meshes -----

    def _defaults(self) -> str:
        inner = ""
        for name in ("outer", "other"):
            self._classes += [name, f"{name}Inner"]
            own, below = self._properties(), f'<default class="{name}Inner">{self._properties()}</default>'
            inner += f'<default class="{name}">{self._draw.choice((own + below, below + own))}</default>'
        own = self._properties()
        return f"<default>{self._draw.choice((own + inner, inner + own))}</default>"

    def _properties(self) -> str:
        return "".join(
            f"<{tag} {self._draw.choice(values)}/>" for tag, values in DEFAULTS.items() if self._draw.random() < 0.6
        )

    def _mesh(self, name: str, faces: str) -> str:
        words = []
        if self._draw.random() < 0.5:
            scale = (self._draw.choice((1, -1)) * self._draw.uniform(0.3, 2) for _ in range(3))
            words.append(f'scale="{" ".join(f"{value:.3f}" for value in scale)}"')
        if self._draw.random() < 0.3:
            words.append(f'refpos="{self._some(3, 0.2)}" refquat="{self._some(4)}"')
        words.append(self._draw.choice(("", 'inertia="exact"', 'inertia="convex"')))
        corners = MESH if faces else MESH[:-1] + ' 0.3 0.4 0.5"'
        return f'<mesh name="{name}" {corners} {faces} {" ".join(words)}/>'

    # ----- bodies -----

    def _body(self, depth: int, *, top: bool = False) -> str:
        self._count += 1
        number, chance = self._count, self._draw.random()
        joints = ""
        if top and chance < 0.3:
            joints = f'<freejoint name="f{number}"/>'
        elif chance < 0.75:
            joints = self._joint(self._draw.choice(("hinge", "hinge", "slide", "ball", "")))
        elif chance < 0.85:
            joints = self._joint("slide") + self._joint("hinge")
        elif chance < 0.9:
            joints = f'<frame pos="{self._some(3)}" {self._turned()}>{self._joint("hinge")}</frame>'
        place = f'name="b{number}" pos="{self._some(3)}" {self._turned()} {self._class("childclass")}'
        return f"<body {place}>{joints}{self._contents(depth)}</body>"

    def _contents(self, depth: int) -> str:
        text = "".join(self._geom() for _ in range(self._draw.randint(1, 2)))
        if self._draw.random() < 0.3:
            moments = self._draw.choice(
                (f'diaginertia="0.7 0.8 0.9" {self._turned()}', f'fullinertia="1.1 0.9 1.3 {self._some(3, 0.2)}"')
            )
            text += f'<inertial mass="{self._draw.uniform(0.5, 3):.3f}" pos="{self._some(3)}" {moments}/>'
        for _ in range(self._draw.randrange(3) if depth else 0):
            chance = self._draw.random()
            if chance < 0.6:
                text += self._body(depth - 1)
            elif chance < 0.85:
                place = f'pos="{self._some(3)}" {self._turned()} {self._class("childclass")}'
                text += f"<frame {place}>{self._body(depth - 1)}{self._geom()}</frame>"
            else:
                copies = f'count="{self._draw.randint(1, 3)}" offset="{self._some(3)}" euler="{self._some(3)}" sep="_"'
                text += f"<replicate {copies}>{self._body(0)}{self._geom()}</replicate>"
        return text

    def _joint(self, kind: str) -> str:
        self._count += 1
        words = [f'name="j{self._count}"', self._class("class"), f'type="{kind}"' if kind else ""]
        words.append(f'axis="{self._some(3)}" pos="{self._some(3)}"')
        if kind != "ball":
            unit = 1.0 if kind == "slide" else self._turn
            ways = (
                f'ref="{self._draw.uniform(-1, 1) * unit:.3f}"',
                f'springref="{self._draw.uniform(-1, 1) * unit:.3f}" stiffness="3"',
                f'springdamper="{self._draw.uniform(0.1, 1):.3f} {self._draw.uniform(0.1, 1):.3f}"',
                'armature="0.2" damping="0.5" frictionloss="0.7"',
                f'range="{-2 * unit:.3f} {1.5 * unit:.3f}"',
                f'range="{-2 * unit:.3f} {1.5 * unit:.3f}" limited="false"',
            )
            words += self._draw.sample(ways[:4], self._draw.randrange(4))
            words += [self._draw.choice(ways[4:])] if self._draw.random() < 0.3 else []
        return f"<joint {' '.join(words)}/>"

    def _geom(self) -> str:
        kind = self._draw.choice((*SIZES, "mesh", ""))
        words = [self._class("class"), f'type="{kind}"' if kind else ""]
        if kind == "mesh":
            words.append(f'mesh="{self._draw.choice(("m1", "m2", "m3"))}" pos="{self._some(3)}" {self._turned()}')
        elif kind not in ("", "sphere") and self._draw.random() < 0.4:
            words.append(f'fromto="{self._some(6)}" size="{self._lengths(1)}"')
        else:
            words.append(f'size="{self._lengths(SIZES.get(kind, 3))}" pos="{self._some(3)}" {self._turned()}')
        masses = (f'mass="{self._draw.uniform(0.1, 3):.3f}"', f'density="{self._draw.uniform(10, 3000):.2f}"', "", "")
        words.append(self._draw.choice(masses))
        if kind in SIZES and self._draw.random() < 0.1:
            words.append('shellinertia="true"')
        return f'<geom {" ".join(words)} contype="0" conaffinity="0"/>'
