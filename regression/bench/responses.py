#!/usr/bin/env python3
"""Cost of contacts by equations (ContactManager) and by the engine (CompiledContactManager), by number of bodies.

    .venv/bin/python regression/bench/responses.py [BODIES ...]      1 4 16 64 if none is given

Spheres lie close together on a floor; all of them may touch each other; restitution without events, regularised
friction. Prints a line each: scalar equations, processor seconds to build the FMU (its compiler included), and
microseconds of one evaluation of the derivatives. The equations are left out above 16 bodies: their code grows with
the number of pairs.
"""

from __future__ import annotations

import ctypes
import os
import sys
import tempfile
import time
from pathlib import Path

import fmpy
from contact_data import checkout
from fmpy.fmi2 import FMU2Model
from modelica2fmu.build import BuildOptions, BuildReport, build_fmu

REPOSITORY = checkout()
MOST_BY_EQUATIONS = 16
EVALUATIONS = 300

MODEL = """model Spheres
  constant Integer n={bodies};
  inner Modelica.Mechanics.MultiBody.World world(g=9.81, n={{0,0,-1}});
  ContactMultiBody.Parts.Body ball[n](each m=0.5, each r_CM={{0,0,0}}, each I_11=5e-4, each I_22=5e-4, each I_33=5e-4,
    each geometry=ContactMultiBody.Shapes.sphere(0.05), each sphereDiameter=0.1,
    r_0(start={{{{0.0995*mod(i - 1, 4),0.0995*mod(div(i - 1, 4), 4),0.0498 + 0.0995*div(i - 1, 16)}} for i in 1:n}},
    each fixed=true), v_0(each fixed=true), each angles_fixed=true, each w_0_fixed=true);
  ContactMultiBody.Parts.Ground floor;
  ContactMultiBody.{manager} contacts(n=n + 1,
    geometry={{if i <= n then ContactMultiBody.Shapes.sphere(0.05) else floor.geometry for i in 1:n + 1}},
    material(each restitution=0.3, each muStatic=0.5),
    inertia(m={{if i <= n then 0.5 else 0 for i in 1:n + 1}}, each I=diagonal({{5e-4,5e-4,5e-4}})){options});
equation
  for i in 1:n loop
    connect(ball[i].frame_a, contacts.frame[i]);
  end for;
  connect(floor.frame_a, contacts.frame[n + 1]);
end Spheres;
"""
OPTIONS = {
    "ContactManager": ", pointCapacity=1, restitutionMethod=ContactMultiBody.Types.RestitutionMethod.Memoryless",
    "CompiledContactManager": "",
}


def processor_seconds() -> float:
    """Of this process and of the compilers it ran."""
    times = os.times()
    return times.user + times.system + times.children_user + times.children_system


def microseconds_of_evaluation(fmu: Path, folder: Path) -> float:
    """Processor time of one evaluation of all derivatives; ``folder`` takes the unpacked FMU."""
    description = fmpy.read_model_description(str(fmu))
    model = FMU2Model(
        guid=description.guid,
        unzipDirectory=fmpy.extract(str(fmu), str(folder)),
        modelIdentifier=description.modelExchange.modelIdentifier,
    )
    model.instantiate()
    model.setupExperiment(startTime=0.0)
    model.enterInitializationMode()
    model.exitInitializationMode()
    model.enterContinuousTimeMode()
    count = description.numberOfContinuousStates
    states = (ctypes.c_double * count)()
    derivatives = (ctypes.c_double * count)()
    model.getContinuousStates(states, count)
    best = float("inf")
    for _ in range(5):
        begin = time.process_time()
        for k in range(EVALUATIONS):
            model.setTime(1e-6 * k)
            model.setContinuousStates(states, count)
            model.getDerivatives(derivatives, count)
        best = min(best, time.process_time() - begin)
    model.terminate()
    model.freeInstance()
    return best / EVALUATIONS * 1e6


def measure(bodies: int, manager: str) -> tuple[BuildReport, float, float]:
    """The builder's report, processor seconds of the build, microseconds of an evaluation."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        source = folder / "Spheres.mo"
        source.write_text(MODEL.format(bodies=bodies, manager=manager, options=OPTIONS[manager]), encoding="utf-8")
        begin = processor_seconds()
        options = BuildOptions(msl=REPOSITORY / "Resources" / "MultiBodyCore")
        report = build_fmu("Spheres", [source, REPOSITORY / "ContactMultiBody"], folder / "spheres.fmu", options)
        built = processor_seconds() - begin
        return report, built, microseconds_of_evaluation(folder / "spheres.fmu", folder / "unpacked")


def main(arguments: list[str]) -> None:
    """Prints the table for the numbers of bodies named."""
    sys.stdout.write(f"{'bodies':>6} {'contacts by':>24} {'equations':>10} {'build s':>8} {'evaluation us':>14}\n")
    for bodies in [int(text) for text in arguments] or [1, 4, 16, 64]:
        for manager in OPTIONS:
            if manager == "ContactManager" and bodies > MOST_BY_EQUATIONS:
                continue
            report, built, evaluation = measure(bodies, manager)
            equations = next(line for line in report.text().splitlines() if line.startswith("scalar equations"))
            number = equations.split()[2].rstrip(",")
            sys.stdout.write(f"{bodies:6} {manager:>24} {number:>10} {built:8.1f} {evaluation:14.1f}\n")
            sys.stdout.flush()


if __name__ == "__main__":
    main(sys.argv[1:])
