"""How networks move: linear differential-algebraic equations of any index, and nonlinear ones without derivatives.

Linear ones are solved through the generalized Schur form of their pencil, finite eigenvalues first (Golub and Van Loan,
Matrix Computations, 7.7), the others by Newton's iteration.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from network_parts import ONE, Terms, is_given
from numpy.typing import NDArray
from scipy.linalg import expm, ordqz

FASTEST = 300.0  # 1/s; what is called infinite is faster than a hundred times that
CONDITION = 1e4

Vector = NDArray[np.float64]


class NoMotionError(Exception):
    """The equations determine nothing, contradict each other, or are too stiff to be told from such."""


@dataclass(frozen=True)
class Motion:
    """All motions that the equations allow: variables are ``modes @ y``, with ``der(y) = rates @ y``."""

    names: dict[str, int]
    modes: Vector
    rates: Vector

    @property
    def freedom(self) -> int:
        return len(self.rates)

    def row(self, terms: Terms) -> Vector:
        """A sum of variables and derivatives, by y."""
        total = np.zeros(self.freedom)
        for factor, name in terms:
            if name.startswith("der "):
                total += factor * self.modes[self.names[name[4:]]] @ self.rates
            else:
                total += factor * self.modes[self.names[name]]
        return total

    def at(self, start: Vector, time: float, names: Sequence[str]) -> Vector:
        where = [self.names[name] for name in names]
        found: Vector = self.modes[where] @ expm(self.rates * time) @ start
        return found


@dataclass(frozen=True)
class Rest:
    """``linear @ variables + cubic @ variables**3 = 0``, where some are functions of time."""

    names: dict[str, int]
    linear: Vector
    cubic: Vector

    def at(self, time: float, names: Sequence[str]) -> Vector:
        """Raises NoMotionError where Newton's iteration does not end."""
        values = np.zeros(len(self.names))
        unknown = [number for name, number in self.names.items() if not is_given(name)]
        for name, number in self.names.items():
            if is_given(name):
                values[number] = 1.0 if name == ONE else np.cos(float(name.split()[1]) * time)
        for _ in range(200):
            left = self.linear @ values + self.cubic @ values**3
            slopes = (self.linear + 3 * self.cubic * values**2)[:, unknown]
            change = np.linalg.solve(slopes, -left)
            values[unknown] += change
            if np.abs(change).max() < 1e-12 * (1 + np.abs(values).max()):
                return values[[self.names[name] for name in names]]
        raise NoMotionError


def rest(equations: Iterable[Terms]) -> Rest:
    """Of equations without derivatives. Raises NoMotionError."""
    rows = list(equations)
    names: dict[str, int] = {}
    for terms in rows:
        for _, name in terms:
            names.setdefault(name.removeprefix("cube "), len(names))
    if len(rows) != sum(not is_given(name) for name in names):
        raise NoMotionError
    linear, cubic = np.zeros((len(rows), len(names))), np.zeros((len(rows), len(names)))
    for number, terms in enumerate(rows):
        for factor, name in terms:
            (cubic if name.startswith("cube ") else linear)[number, names[name.removeprefix("cube ")]] += factor
    unknown = [number for name, number in names.items() if not is_given(name)]
    if not unknown or np.linalg.cond((linear + cubic)[:, unknown]) > 1e9:
        raise NoMotionError
    return Rest(names, linear, cubic)


def motion(equations: Iterable[Terms], waves: Iterable[str]) -> Motion:
    """Of linear equations. Raises NoMotionError.

    Args:
        equations: each is zero.
        waves: variables ``cos w`` that occur in them.
    """
    rows = [*equations, ((1.0, f"der {ONE}"),)]
    for wave in sorted(waves):
        speed = float(wave.split()[1])
        rows += [((1.0, f"der {wave}"), (speed, f"sin {speed:g}")), ((1.0, f"der sin {speed:g}"), (-speed, wave))]
    names: dict[str, int] = {}
    for terms in rows:
        for _, name in terms:
            names.setdefault(name.removeprefix("der "), len(names))
    if len(rows) != len(names):
        raise NoMotionError
    slopes, values = np.zeros((len(rows), len(rows))), np.zeros((len(rows), len(rows)))
    for number, terms in enumerate(rows):
        for factor, name in terms:
            (slopes if name.startswith("der ") else values)[number, names[name.removeprefix("der ")]] += factor
    if np.linalg.cond(slopes * 1.371 + values) > 1e9:
        raise NoMotionError
    # slopes*z' + values*z = 0: eigenvalues are alpha/beta of (-values, slopes).
    upper, lower, alpha, beta, _, modes = ordqz(
        -values, slopes, sort=lambda a, b: np.abs(a) < 100 * FASTEST * np.abs(b), output="complex"
    )
    is_finite = np.abs(alpha) < 100 * FASTEST * np.abs(beta)
    freedom = int(is_finite.sum())
    if not is_finite[:freedom].all() or np.any(np.abs(alpha[is_finite]) > FASTEST * np.abs(beta[is_finite])):
        raise NoMotionError
    basis = modes[:, :freedom]
    rates = np.linalg.solve(lower[:freedom, :freedom], upper[:freedom, :freedom])
    # The space of motions is real: so has it a real basis.
    real, _, _ = np.linalg.svd(np.hstack([basis.real, basis.imag]), full_matrices=False)
    real = real[:, :freedom]
    change = basis.conj().T @ real
    found = Motion(names, real, np.linalg.solve(change, rates @ change).real)
    if np.abs(slopes @ found.modes @ found.rates + values @ found.modes).max(initial=0.0) > 1e-8:
        raise NoMotionError
    return found
