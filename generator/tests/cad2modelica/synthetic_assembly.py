"""Writes assemblies of any size: chains of boxes or turned parts, no two alike. As a script: measures a generation.

python synthetic_assembly.py 2000 10                      2000 boxes in chains of 10
python synthetic_assembly.py 200 10 --turned              200 turned parts of 336 triangles
python synthetic_assembly.py 200 10 --turned --grooved 10 every tenth of them with a groove, so that it is decomposed
"""

from __future__ import annotations

import argparse
import math
import resource
import sys
import tempfile
import time
from pathlib import Path

from cad2modelica import Decomposer, GenerateOptions, generate

SIDES = 24  # of turned parts
FACES = "0 1 3 2 -1 4 6 7 5 -1 0 4 5 1 -1 2 3 7 6 -1 0 2 6 4 -1 1 5 7 3 -1"


def box(number: int) -> tuple[str, str]:
    """Points and faces of a box that hangs from the origin, mm."""
    half = 10 + number % 7
    corners = [(x, y, z) for x in (-half, half) for y in (-half, half) for z in (-50, 0)]
    return ", ".join(" ".join(map(str, corner)) for corner in corners), FACES


def turned(number: int, grooved: bool) -> tuple[str, str]:
    """Points and faces of a barrel, or of one with a groove, that hangs from the origin, mm."""
    widest = 12 + 0.01 * number
    shares = (0.7, 0.85, 0.95, 0.55, 0.55, 0.9, 0.75) if grooved else (0.7, 0.85, 0.95, 1.0, 0.95, 0.85, 0.7)
    heights = (-50, -42, -34, -25, -16, -8, 0)
    points = [
        f"{widest * share * math.cos(angle):.6f} {widest * share * math.sin(angle):.6f} {height}"
        for share, height in zip(shares, heights, strict=True)
        for angle in (2 * math.pi * k / SIDES for k in range(SIDES))
    ]
    sides = [
        f"{ring * SIDES + k} {ring * SIDES + (k + 1) % SIDES} {(ring + 1) * SIDES + (k + 1) % SIDES} "
        f"{(ring + 1) * SIDES + k} -1"
        for ring in range(len(heights) - 1)
        for k in range(SIDES)
    ]
    top = len(points) - SIDES
    caps = [
        " ".join(str(k) for k in reversed(range(SIDES))) + " -1",
        " ".join(str(top + k) for k in range(SIDES)) + " -1",
    ]
    return ", ".join(points), " ".join(sides + caps)


def write_chains(folder: Path, count: int, length: int, turn: bool = False, grooved: int = 0) -> Path:
    """Writes an assembly of ``count`` parts that hang in chains of ``length``; returns its XML file.

    Args:
        folder: to write into.
        count: number of parts.
        length: number of parts in a chain.
        turn: whether parts are turned ones of different diameters instead of boxes.
        grooved: the first of so many turned parts has a groove; none if 0.
    """
    shapes, parts, joints = [], [], []
    for number in range(count):
        chain, place = divmod(number, length)
        origin = f"{500 * (chain % 40)} {500 * (chain // 40)} {2000 - 60 * place}"
        points, faces = turned(number, bool(grooved) and number % grooved == 0) if turn else box(number)
        mesh = f"IndexedFaceSet {{ coord Coordinate {{ point [ {points} ] }} coordIndex [ {faces} ] }}"
        shapes.append(f"DEF box{number} Transform {{ children [ Shape {{ geometry {mesh} }} ] }}")
        inertia = 'about="centerOfMass" axes="part" products="tensor" xx="60" yy="60" zz="16" xy="0" xz="0" yz="0"'
        parts.append(
            f'<part name="box {number}"><pose><position>{origin}</position></pose><massProperties><mass>0.25</mass>'
            f"<centerOfMass>0 0 -25</centerOfMass><inertia {inertia}/></massProperties>"
            f'<geometry file="boxes.wrl" node="box{number}" coordinates="node" length="mm"/></part>'
        )
        parent = f"box {number - 1}" if place else "ground"
        joints.append(
            f'<joint name="joint {number}" type="revolute" parent="{parent}" child="box {number}">'
            f"<origin>{origin}</origin><axis>{'0 1 0' if place % 2 else '1 0 0'}</axis></joint>"
        )
    (folder / "boxes.wrl").write_text("#VRML V2.0 utf8\n" + "\n".join(shapes) + "\n")
    file = folder / "chains.xml"
    file.write_text(
        '<assembly xmlns="urn:contactmultibody:assembly:1" name="Chains"><units length="mm" mass="kg" angle="deg"/>'
        f'<ground><plane name="floor"/></ground><parts>{"".join(parts)}</parts><joints>{"".join(joints)}</joints>'
        "</assembly>"
    )
    return file


def main() -> None:
    """Generates once and prints how long it took."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("count", type=int)
    parser.add_argument("length", type=int)
    parser.add_argument("--turned", action="store_true")
    parser.add_argument("--grooved", type=int, default=0, metavar="EVERY")
    parser.add_argument("--decomposer", type=Decomposer, default=None)
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        file = write_chains(Path(name), given.count, given.length, given.turned, given.grooved)
        wall, cpu = time.perf_counter(), processor_time()
        generate(file, Path(name) / "out", GenerateOptions(decomposer=given.decomposer))
        wall, cpu = time.perf_counter() - wall, processor_time() - cpu
        times = f"{wall:.1f} s ({cpu:.1f} s of the processor)"
        sys.stdout.write(f"{given.count} parts in chains of {given.length}: {times}\n")


def processor_time() -> float:
    """Of this process and those it has waited for, s."""
    own, others = resource.getrusage(resource.RUSAGE_SELF), resource.getrusage(resource.RUSAGE_CHILDREN)
    return own.ru_utime + own.ru_stime + others.ru_utime + others.ru_stime


if __name__ == "__main__":
    main()
