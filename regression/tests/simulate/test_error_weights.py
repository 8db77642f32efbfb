"""Short steps may err by less than the tolerance, in proportion to their length."""

from __future__ import annotations

import numpy as np
import pytest
from fmu_regression.simulate.error_weights import error_weights, highest_order, share_of_tolerance


def test_short_steps_may_err_by_a_share_of_0_08_and_long_ones_by_the_tolerance() -> None:
    assert [share_of_tolerance(step, 1e-4) for step in (0.0, 1e-6, 0.016, 0.08, 0.2, 1.0)] == pytest.approx(
        [0.08, 0.08, 0.08, 0.4, 1.0, 1.0]
    )


@pytest.mark.parametrize(("tolerance", "share"), [(1e-2, 0.08), (1e-4, 0.08), (2e-5, 0.4), (1e-5, 0.8), (1e-8, 1.0)])
def test_no_step_is_held_to_less_than_8e_6_unless_asked_for(tolerance: float, share: float) -> None:
    assert share_of_tolerance(1e-5, tolerance) == pytest.approx(share)


def test_weights_are_reciprocals_of_what_a_step_may_err() -> None:
    weights = error_weights(np.array([-2.0, 0.0]), np.array([1e-7, 1e-9]), 1e-4, 1e-5)
    assert 1.0 / weights == pytest.approx([0.08 * (2e-4 + 1e-7), 0.8e-10])


def test_order_five_is_for_fine_tolerances() -> None:
    assert [highest_order(tolerance) for tolerance in (1e-2, 1.1e-6, 1e-6, 1e-9)] == [4, 4, 5, 5]
