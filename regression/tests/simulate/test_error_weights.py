"""Short steps may err by less than the tolerance, in proportion to their length."""

from __future__ import annotations

import numpy as np
import pytest
from fmu_regression.simulate.error_weights import error_weights, share_of_tolerance


def test_short_steps_may_err_by_a_tenth_and_long_ones_by_the_tolerance() -> None:
    assert [share_of_tolerance(step, 1e-4) for step in (0.0, 1e-6, 5e-3, 0.02, 0.05, 1.0)] == pytest.approx(
        [0.1, 0.1, 0.1, 0.4, 1.0, 1.0]
    )


@pytest.mark.parametrize(("tolerance", "share"), [(1e-2, 0.1), (1e-4, 0.1), (2e-5, 0.5), (1e-5, 1.0), (1e-8, 1.0)])
def test_no_step_is_held_to_less_than_1e_5_unless_asked_for(tolerance: float, share: float) -> None:
    assert share_of_tolerance(1e-5, tolerance) == pytest.approx(share)


def test_weights_are_reciprocals_of_what_a_step_may_err() -> None:
    weights = error_weights(np.array([-2.0, 0.0]), np.array([1e-7, 1e-9]), 1e-4, 1e-5)
    assert 1.0 / weights == pytest.approx([0.1 * (2e-4 + 1e-7), 1e-10])
