"""What a modeller wrote survives every generation, and what the generator wrote is what a first generation writes.

Random walks of edits in the CAD system, in the assignment of actuators and in the package, with random consents.
``CMB_EDITS=500`` takes so many walks.
"""

from __future__ import annotations

import json
import os
import random
import shutil
from dataclasses import dataclass, replace
from pathlib import Path

import pytest
from assembly_text import joint, part, write_assembly
from cad2modelica import Edited, GeneratedPackage, GenerateOptions, generate
from contact_foundation.errors import InputError

FEW = 8
MANY = int(os.environ.get("CMB_EDITS", "150"))
STEPS = 10
NAMES = ("hip", "knee", "Knee", "ankle", "foot 2", "toe", "ärm", "end", "model", "hipServo", "world")
KINDS = ("revolute", "prismatic")
MECHATRONICS = "Mechatronics.mo"
ORDER = "package.order"
REPORT = "generation.html"  # tells what a generation has changed


@dataclass(frozen=True)
class Link:
    """A part and the joint that holds it, both numbered so that renaming is no matter of who they are."""

    name: str
    parent: int  # -1: ground
    joint: str
    kind: str
    mass: float
    drive: float | None  # stiffness of its servo


class Walk:
    """One assembly and its package through many edits."""

    def __init__(self, folder: Path, seed: int) -> None:
        self.choose = random.Random(seed)
        self.folder = folder
        self.output = folder / "out"
        self.root = self.output / "Leg"
        self.links = [Link("a", -1, "j", "revolute", 1.0, 50.0), Link("b", 0, "k", "revolute", 2.0, None)]
        self.own: dict[str, bytes] = {}
        self.is_edited = False

    # ----- edits -----

    def name(self, taken: set[str]) -> str:
        free = [name for name in NAMES if name not in taken]
        return self.choose.choice(free) if free else f"n{len(taken)}{self.choose.randrange(1000)}"

    def change_mechanism(self) -> None:
        choose, number = self.choose, self.choose.randrange(len(self.links))
        link = self.links[number]
        edit = choose.choice(["mass", "mass", "part", "joint", "kind", "add", "remove"])
        if edit == "mass":
            link = replace(link, mass=round(choose.uniform(0.5, 3), 2))
        elif edit == "part":
            link = replace(link, name=self.name({each.name for each in self.links}))
        elif edit == "joint":
            link = replace(link, joint=self.name({each.joint for each in self.links}))
        elif edit == "kind":
            link = replace(link, kind=choose.choice(KINDS), drive=None)
        elif edit == "add" and len(self.links) < 6:
            names, joints = {each.name for each in self.links}, {each.joint for each in self.links}
            self.links.append(Link(self.name(names), number, self.name(joints), choose.choice(KINDS), 1.0, None))
        elif edit == "remove" and len(self.links) > 1 and not any(each.parent == number for each in self.links):
            del self.links[number]
            self.links = [replace(each, parent=each.parent - (each.parent > number)) for each in self.links]
            return
        self.links[number] = link

    def change_drive(self) -> None:
        number = self.choose.randrange(len(self.links))
        drive = None if self.choose.random() < 0.4 else float(self.choose.randrange(10, 90))
        self.links[number] = replace(self.links[number], drive=drive)

    def write_own(self) -> None:
        """A file of the modeller's: new, changed, or beside generated ones."""
        choose = self.choose
        file = choose.choice(["Drive.mo", "Test/package.mo", "Resources/data.txt", "Resources/Geometry/mine.wrl"])
        used = choose.choice(self.links).joint
        name = Path(file).stem
        text = f"model {name} // {choose.randrange(1000)}\n  extends Mechanics; // {used}\r\nend {name};\n\xe4"
        self.own[file] = text.encode(choose.choice(["utf-8", "latin-1"]))
        (self.root / file).parent.mkdir(parents=True, exist_ok=True)
        (self.root / file).write_bytes(self.own[file])

    def edit_mechatronics(self) -> None:
        file = self.root / MECHATRONICS
        file.write_bytes(file.read_bytes() + f"// mine {self.choose.randrange(1000)}\r\n".encode())
        self.is_edited = True

    # ----- inputs -----

    def sources(self, folder: Path) -> Path:
        """Assembly and assignment."""
        parts = [part(each.name, mass=each.mass, position=(0, 0, -0.1 * k)) for k, each in enumerate(self.links)]
        joints = [
            joint(each.joint, each.kind, "ground" if each.parent < 0 else self.links[each.parent].name, each.name,
                  origin=(0, 0, -0.1 * k), axis=(0, 1, 0))
            for k, each in enumerate(self.links)
        ]  # fmt: skip
        folder.mkdir(exist_ok=True)
        driven = [each for each in self.links if each.drive is not None]
        drives = "".join(
            f"[[actuator]]\njoint = {json.dumps(each.joint)}\n"
            f'component = "Servo"\nparameters = {{ c = {each.drive} }}\n'
            for each in driven
        )
        (folder / "actuators.toml").write_text(drives, encoding="utf-8")
        return write_assembly(folder / "leg.xml", parts, joints, name="Leg")

    # ----- what must hold -----

    def files(self) -> dict[str, bytes]:
        paths = sorted(path for path in self.output.rglob("*") if path.is_file())
        return {str(path.relative_to(self.output)): path.read_bytes() for path in paths}

    def step(self) -> list[str]:
        """Edits, generates, and says what is wrong."""
        edits = [self.change_mechanism, self.change_drive]
        if self.root.is_dir():
            edits += [self.change_mechanism, self.write_own, self.edit_mechatronics]
        for edit in self.choose.sample(edits, self.choose.choice([1, 1, 2])):
            edit()
        options = GenerateOptions(
            accept_structure=self.choose.random() < 0.5,
            edited=self.choose.choice([Edited.ASK, Edited.KEEP, Edited.REPLACE]),
        )
        assembly, before = self.sources(self.folder), self.files()
        try:
            package = generate(assembly, self.output, options)
        except InputError as error:
            return [f"{error}\nchanged the package"] if self.files() != before else []
        chosen = f"{options.accept_structure}, {options.edited}"
        return [f"{text} ({chosen})" for text in self.wrong(package, before, assembly, options)]

    def wrong(
        self, package: GeneratedPackage, before: dict[str, bytes], assembly: Path, options: GenerateOptions
    ) -> list[str]:
        after = self.files()
        wrong = [f"{name} is not as it was" for name, data in self.own.items() if after.get(f"Leg/{name}") != data]
        generated, earlier = after[f"Leg/{MECHATRONICS}"], before.get(f"Leg/{MECHATRONICS}")
        if self.is_edited and generated != earlier:
            kept = [name for name, data in after.items() if data == earlier and ".edited" in name]
            if options.edited is not Edited.REPLACE or not kept:
                wrong.append(f"the edited {MECHATRONICS} is lost")
            else:
                self.own |= {name.removeprefix("Leg/"): after[name] for name in kept}
            self.is_edited = False
        shutil.rmtree(self.folder / "first", ignore_errors=True)
        first = generate(self.sources(self.folder / "fresh"), self.folder / "first", GenerateOptions())
        for path in sorted(first.root.rglob("*")):
            name = str(path.relative_to(first.root))
            is_own = name == MECHATRONICS and self.is_edited
            if not path.is_file() or is_own or name in (ORDER, "Resources/generation.json"):
                continue
            if after.get(f"Leg/{name}") != path.read_bytes():
                wrong.append(f"{name} is not what a first generation writes")
        if {*(first.root / ORDER).read_text().split()} - {*(package.root / ORDER).read_text().split()}:
            wrong.append(f"{ORDER} lacks a class")
        again = generate(assembly, self.output, GenerateOptions())
        now = self.files()
        changed = {name for name in {*now, *after} - {REPORT} if now.get(name) != after.get(name)}
        if changed:
            wrong.append(f"a second generation changes {sorted(changed)}")
        return [*wrong, *(note for note in again.notes if "structure" in note)]


def failures(folder: Path, seeds: range) -> list[str]:
    found = []
    for seed in seeds:
        place = folder / str(seed)
        place.mkdir()
        walk = Walk(place, seed)
        for number in range(STEPS):
            wrong = walk.step()
            found += [f"seed {seed}, step {number}: {text}" for text in wrong]
            if wrong:
                break
        shutil.rmtree(place)
    return found


def test_a_few_walks(tmp_path: Path) -> None:
    found = failures(tmp_path, range(FEW))
    assert not found, "\n".join(found)


@pytest.mark.full
def test_many_walks(tmp_path: Path) -> None:
    found = failures(tmp_path, range(100, 100 + MANY))
    assert not found, "\n".join(found)
