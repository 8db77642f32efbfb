"""A few lines for the terminal about a result."""

from __future__ import annotations

from fmu_regression.results.result import SimulationResult
from fmu_regression.results.undefined import undefined_remarks
from fmu_regression.scene.energy import energy_balance
from fmu_regression.scene.impacts import find_impacts
from fmu_regression.scene.scene_file import Scene

_MAX_IMPACTS = 5


def summarise(result: SimulationResult, scene: Scene | None = None) -> str:
    """Time simulated, work of the integrator and, with a scene, impacts, forces and energy; no trailing newline."""
    duration = float(result.time[-1] - result.time[0])
    lines = [f"{result.model or 'result'}: {duration:g} s simulated, {result.time.size} rows"]
    if result.wall_time is not None:
        factor = duration / result.wall_time if result.wall_time > 0 else float("inf")
        lines.append(f"  wall time {result.wall_time:.3g} s, {factor:.3g} times real time")
    if result.counters is not None:
        counters = result.counters
        lines.append(
            f"  {counters.steps} steps, {counters.evaluations} evaluations, "
            f"{counters.error_test_failures + counters.convergence_failures} rejected, "
            f"{counters.state_events + counters.time_events} events"
        )
    if scene is not None:
        lines += _impact_lines(result, scene) + _energy_lines(result, scene)
    lines += [f"  {line}" for line in (*undefined_remarks(result), *result.log[:5])]
    return "\n".join(lines)


def _impact_lines(result: SimulationResult, scene: Scene) -> list[str]:
    if not scene.pairs:
        return []
    impacts = find_impacts(scene, result)
    if not impacts:
        return ["  no contact"]
    first = next((impact for impact in impacts if impact.meets), impacts[0])
    lines = [f"  {len(impacts)} contact{'s' if len(impacts) > 1 else ''}, the first impact at {first.start:.6g} s"]
    forces = [impact for impact in impacts if impact.peak_force is not None]
    if forces:
        peak = max(forces, key=lambda impact: impact.peak_force or 0.0)
        lines.append(f"  peak force {peak.peak_force:.5g} N ({scene.pair_label(peak.pair)}) at {peak.peak_time:.6g} s")
    measured = [impact for impact in impacts if impact.restitution is not None]
    for impact in measured[:_MAX_IMPACTS]:
        delivered = impact.restitution
        asked = f" (asked for {impact.pair.restitution:.3g})" if impact.pair.restitution is not None else ""
        lines.append(
            f"    {impact.start:.5f} s  {scene.pair_label(impact.pair)}: {impact.speed_before:.4g} m/s in, "
            f"{impact.speed_after:.4g} m/s out, restitution {delivered:.3f}{asked}"
        )
    if len(measured) > _MAX_IMPACTS:
        lines.append(f"    and {len(measured) - _MAX_IMPACTS} more")
    return lines


def _energy_lines(result: SimulationResult, scene: Scene) -> list[str]:
    if not any(body.mass > 0 and not body.fixed for body in scene.bodies):
        return []
    energy = energy_balance(scene, result)
    lines = [
        f"  energy {energy.total[0]:.6g} J at the start, {energy.total[-1]:.6g} J at the end; "
        f"change {energy.change:+.3g} J"
    ]
    if energy.notes:
        lines.append(f"    {energy.notes[0]}" + (f" (and {len(energy.notes) - 1} more)" if energy.notes[1:] else ""))
    return lines
