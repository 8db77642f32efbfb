"""By which damping a law of contact delivers a coefficient of restitution, so that all programs have the same one."""

from __future__ import annotations

import math
from collections.abc import Callable


def damping_ratio(restitution: float) -> float:
    """Of a linear spring and damper that pushes only.

    Schwager, Pöschel: Coefficient of restitution and linear-dashpot model revisited. Granular Matter 9 (2007) 465.

    Args:
        restitution: 0.14 to 1; what is less needs more than the critical damping.
    """
    return _root(lambda ratio: _of_spring_and_damper(ratio) - restitution, 0.0, 1 - 1e-9)


def hunt_crossley_damping(restitution: float, speed: float) -> float:
    """The d, s/m, of k x (1 + d v) that makes an impact at ``speed``, m/s, leave with ``restitution`` times it.

    From the momentum over the depth, v dv/(1 + d v) = -k x dx/m, integrated over both halves of the impact.
    """
    if restitution >= 1:
        return 0.0

    def excess(p: float) -> float:
        return p * (1 + restitution) - math.log((1 + p) / (1 - restitution * p))

    return _root(excess, 1e-3 * (1 - restitution), (1 - 1e-12) / restitution) / speed


def _of_spring_and_damper(ratio: float) -> float:
    if ratio == 0:
        return 1.0
    damped = math.sqrt(1 - ratio**2)
    duration = math.pi - math.atan2(2 * ratio * damped, damped**2 - ratio**2)
    return math.exp(-ratio / damped * duration)


def _root(function: Callable[[float], float], low: float, high: float) -> float:
    sign = function(low) > 0
    for _ in range(200):
        middle = (low + high) / 2
        if (function(middle) > 0) == sign:
            low = middle
        else:
            high = middle
    return (low + high) / 2
