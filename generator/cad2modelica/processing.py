"""What is decided about a mechanism before anything is written: loops, shapes, pairs, components."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from contact_foundation.progress import Progress

from cad2modelica.collision.collision_shapes import CollisionGeometry
from cad2modelica.collision.contact_pairs import contact_pairs, within_reach
from cad2modelica.collision.manager_choice import takes_compiled_manager
from cad2modelica.collision.part_geometries import part_geometries
from cad2modelica.collision.start_overlaps import StartCheck, start_overlaps, without_start_overlaps
from cad2modelica.emit.mechanism_building import mechanism_view
from cad2modelica.kinematics.assembling import assembled, require_closed
from cad2modelica.kinematics.coupled_loops import without_looped_couplings
from cad2modelica.kinematics.joint_couplings import with_couplings
from cad2modelica.kinematics.kinematic_graph import KinematicTree, kinematic_tree
from cad2modelica.kinematics.loops import LoopAnalysis, analyse_loops
from cad2modelica.kinematics.spherical_axes import with_spherical_axes
from cad2modelica.mechanism.assembly_choices import with_grounded, with_pairs, with_stops, with_up, without_contacts
from cad2modelica.mechanism.extent_check import require_tractable
from cad2modelica.mechanism.joint_distance import distance_notes
from cad2modelica.mechanism.model import Assembly, DecompositionLimits
from cad2modelica.modelica.view import MechanismView
from cad2modelica.options import GenerateOptions
from cad2modelica.report.generation_notes import speed_notes, unit_notes


@dataclass(frozen=True)
class Mechanism:
    """A mechanism with everything that was decided about it.

    Attributes:
        assembly: parts, joints and poses at the start.
        tree: the spanning tree and the joints that close loops.
        loops: which loops are planar, which coordinates are states.
        geometries: collision shapes by part.
        start: what overlaps at the start among the pairs that may touch.
        view: bodies, joints and contacts as Modelica components.
        notes: what the user should know, one line each.
    """

    assembly: Assembly
    tree: KinematicTree
    loops: LoopAnalysis
    geometries: dict[str, CollisionGeometry]
    start: StartCheck
    view: MechanismView
    notes: tuple[str, ...]


def prepare(assembly: Assembly, options: GenerateOptions) -> Assembly:
    """The assembly by the user's choices, closed at the start, with axes for spherical joints in loops.

    Raises:
        InputError: a choice names what is not there, a joint does not close, or nothing can be computed at this size.
    """
    assembly = without_contacts(with_up(with_grounded(assembly, options.ground), options.up), options.contacts)
    assembly = with_pairs(with_stops(assembly, options.stops), options.exclude, options.include)
    assembly = with_couplings(without_looped_couplings(assembly), options.couple)
    if options.assemble:
        assembly = assembled(assembly, kinematic_tree(assembly))
    require_closed(assembly)
    require_tractable(assembly)
    return with_spherical_axes(assembly)


def process(assembly: Assembly, options: GenerateOptions, progress: Progress) -> Mechanism:
    """Decides on loops, collision shapes, pairs that may touch, and the components of the mechanical model.

    Raises:
        InputError: loops cannot be computed, or a geometry cannot collide.
    """
    tree = kinematic_tree(assembly)
    loops = analyse_loops(assembly, tree)
    geometries = part_geometries(assembly.parts, _decomposition(assembly, options), progress)
    progress("start configuration", 0.0, assembly.name)
    pairs, start, pair_notes = _pairs(assembly, tree, geometries)
    compiled, manager_notes = takes_compiled_manager(
        assembly, len(pairs), options.manager, clearances=options.clearances
    )
    notes = (
        *assembly.notes,
        *unit_notes(assembly),
        *distance_notes(assembly),
        *speed_notes(assembly, tree),
        *loops.notes,
        *(note for item in geometries.values() for note in item.notes),
        *pair_notes,
        *manager_notes,
    )
    view = mechanism_view(assembly, tree, loops, geometries, pairs, clearances=options.clearances, compiled=compiled)
    return Mechanism(assembly, tree, loops, geometries, start, view, notes)


def _decomposition(assembly: Assembly, options: GenerateOptions) -> DecompositionLimits:
    given = DecompositionLimits(
        options.collision_error * assembly.length_unit if options.collision_error is not None else None,
        options.max_pieces,
        decomposer=options.decomposer,
    )
    return given.or_else(assembly.contacts.decomposition)


def _pairs(
    assembly: Assembly, tree: KinematicTree, geometries: Mapping[str, CollisionGeometry]
) -> tuple[list[tuple[str, str]], StartCheck, tuple[str, ...]]:
    """Pairs that may touch, what overlaps among them, and notes on those that were left out."""
    colliding = [part.name for part in assembly.parts if geometries[part.name].shapes]
    colliding += [plane.name for plane in assembly.planes]
    balls = {part.name: geometries[part.name].ball(part.pose) for part in assembly.parts}
    near, far_notes = within_reach(assembly, tree, contact_pairs(assembly, tree, colliding), balls)
    pairs, start, overlap_notes = without_start_overlaps(assembly, near, start_overlaps(assembly, geometries, near))
    return pairs, start, (*far_notes, *overlap_notes)
