"""Writes Simscape Multibody import files for tests, as the plug-ins lay them out."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from xml.sax.saxutils import quoteattr

NAMESPACE = "urn:mathworks:SimscapeMultibody:import"
IDENTITY = "1 0 0 0 1 0 0 0 1"


def instance(
    name: str, part: str, position: str = "0 0 0", rotation: str = IDENTITY, more: str = "", inner: str = ""
) -> str:
    return (
        f'<Instance name={quoteattr(name)} uid={quoteattr(name)} entityUid="{part}" {more}><Transform>'
        f"<Rotation>{rotation}</Rotation><Translation>{position}</Translation></Transform>{inner}</Instance>"
    )


def side(path: str, kind: str, position: str, axis: str = "0 0 1") -> str:
    uids = "".join(f"<Uid>{uid}</Uid>" for uid in path.split("/") if uid)
    direction = f"<Axis>{axis}</Axis>" if kind != "point" else ""
    return (
        f'<ConstraintGeometry geomType="{kind}"><InstancePath>{uids}</InstancePath><Position>{position}</Position>'
        f"{direction}</ConstraintGeometry>"
    )


def mate(kind: str, name: str, *sides: str) -> str:
    return f'<{kind} name="{name}">{"".join(sides)}</{kind}>'


def frame_joint(
    kind: str, name: str, base: tuple[str, str], follower: tuple[str, str], rotation: str = IDENTITY
) -> str:
    frames = []
    for tag, (path, position) in (("BaseFrame", base), ("FollowerFrame", follower)):
        uids = "".join(f"<Uid>{uid}</Uid>" for uid in path.split("/"))
        turned = rotation if tag == "FollowerFrame" else IDENTITY
        frames.append(
            f"<{tag}><InstancePath>{uids}</InstancePath><Transform><Rotation>{turned}</Rotation>"
            f"<Translation>{position}</Translation></Transform></{tag}>"
        )
    return f'<{kind} name="{name}">{"".join(frames)}</{kind}>'


def part(
    name: str, mass: str = "2", center: str = "0.5 0 0", inertia: str = "0.01 0.2 0.2 0 0 0", more: str = ""
) -> str:
    return (
        f'<Part name="{name}" uid="{name}"><MassProperties><Mass>{mass}</Mass><CenterOfMass>{center}</CenterOfMass>'
        f"<Inertia>{inertia}</Inertia></MassProperties>{more}</Part>"
    )


def write(
    folder: Path,
    instances: Iterable[str],
    parts: Iterable[str],
    *,
    mates: Iterable[str] = (),
    joints: Iterable[str] = (),
    assemblies: Iterable[str] = (),
    units: str = '<ModelUnits mass="kilogram" length="millimeter"/><DataUnits mass="kilogram" length="meter"/>',
) -> Path:
    file = folder / "assembly.xml"
    file.write_text(
        f'<SimscapeMultibodyImportXML version="2.0" xmlns="{NAMESPACE}"><Created by="" from="a test"/>{units}'
        f'<RootAssembly name="Root" uid="Root"><InstanceTree>{"".join(instances)}</InstanceTree>'
        f"<Constraints>{''.join(mates)}</Constraints><Joints>{''.join(joints)}</Joints></RootAssembly>"
        f"<Assemblies>{''.join(assemblies)}</Assemblies><Parts>{''.join(parts)}</Parts></SimscapeMultibodyImportXML>",
        encoding="utf-8",
    )
    return file
