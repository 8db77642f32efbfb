"""Writes assemblies of any size: chains of boxes with geometry of their own. As a script: measures a generation.

python synthetic_assembly.py 2000 10     2000 parts in chains of 10
"""

from __future__ import annotations

import argparse
import sys
import tempfile
import time
from pathlib import Path

from cad2modelica import generate

FACES = "0 1 3 2 -1 4 6 7 5 -1 0 4 5 1 -1 2 3 7 6 -1 0 2 6 4 -1 1 5 7 3 -1"


def write_chains(folder: Path, count: int, length: int) -> Path:
    """Writes an assembly of ``count`` boxes that hang in chains of ``length``; returns its XML file."""
    shapes, parts, joints = [], [], []
    for number in range(count):
        chain, place = divmod(number, length)
        origin = f"{500 * (chain % 40)} {500 * (chain // 40)} {2000 - 60 * place}"
        half = 10 + number % 7
        corners = [(x, y, z) for x in (-half, half) for y in (-half, half) for z in (-50, 0)]
        points = ", ".join(" ".join(map(str, corner)) for corner in corners)
        mesh = f"IndexedFaceSet {{ coord Coordinate {{ point [ {points} ] }} coordIndex [ {FACES} ] }}"
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
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        file = write_chains(Path(name), given.count, given.length)
        wall, cpu = time.perf_counter(), time.process_time()
        generate(file, Path(name) / "out")
        wall, cpu = time.perf_counter() - wall, time.process_time() - cpu
        times = f"{wall:.1f} s ({cpu:.1f} s of the processor)"
        sys.stdout.write(f"{given.count} parts in chains of {given.length}: {times}\n")


if __name__ == "__main__":
    main()
