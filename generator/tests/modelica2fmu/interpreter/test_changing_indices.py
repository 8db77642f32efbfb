"""Elements of arrays whose index changes while the model runs."""

from __future__ import annotations

import numpy as np
import pytest

INDICES = """model Indices
  Real v[3] = {1, 2, time};
  Real m[2, 2] = {{1, 2}, {3, time}};
  Integer k = integer(4*time + 0.1) - 1, one = min(2, max(1, k));
  Real x = v[k];
  Real guarded = if k >= 1 and k <= 3 then v[k] else 7;
  Real row[2] = m[one, :], corner = m[one, one];
end Indices;
"""


def test_elements_out_of_bounds_are_no_numbers(simulate):
    """Modelica 3.6, section 10.5.1: it is an error to use such an index, not to write it in a branch not taken."""
    result = simulate(INDICES, ["x", "guarded", "k", "row[2]", "corner"], stop=1.9, interval=0.05)
    t, k = result["time"], np.rint(result["k"])
    wanted = np.select([k == 1, k == 2, k == 3], [1, 2, t], np.nan)
    assert {0, 1, 2, 3, 4} <= set(k)
    np.testing.assert_allclose(result["x"], wanted)
    np.testing.assert_allclose(result["guarded"], np.where(np.isnan(wanted), 7, wanted))
    np.testing.assert_allclose(result["row[2]"], np.where(k <= 1, 2, t))
    np.testing.assert_allclose(result["corner"], np.where(k <= 1, 1, t))


def test_a_state_that_needs_an_element_out_of_bounds_stops_the_simulation(simulate, capfd):
    text = INDICES.replace(
        "end Indices", "Real z(start = 0, fixed = true);\nequation\n  der(z) = v[k + 2];\nend Indices"
    )
    with pytest.raises(Exception, match="fmi2DoStep"):
        simulate(text, ["z"], stop=1.9, fmi_type="CoSimulation", debug_logging=False)
    assert "derivative of z is not finite" in capfd.readouterr().out
