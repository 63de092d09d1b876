"""Gauss-Newton with a line search, alone: steps on a problem whose answers are known."""

from __future__ import annotations

import numpy as np
import pytest

from shapespline.solvers import GaussNewton, Limits, Proposal, Stop, minimize


class Root:
    """r(x) = atan(x): from beyond 1.39 the whole step overshoots and must be halved."""

    def cost(self, x):
        return 0.5 * float(np.arctan(x[0])) ** 2

    def cost_and_gradient(self, x):
        return self.cost(x), np.array([np.arctan(x[0]) / (1.0 + x[0] ** 2)])

    def joint_step(self, x, parameter_damping):
        full = -np.arctan(x[0]) * (1.0 + x[0] ** 2)
        return Proposal(x + full, self.cost(x), abs(float(np.arctan(x[0]))))


@pytest.mark.parametrize("start", [1.0, 1.5, 10.0, 1e3])
def test_overshooting_steps_are_halved_until_the_cost_falls(start):
    result = minimize(GaussNewton(), Root(), [start], limits=Limits(relative_decrease=0.0))
    assert result.stop is Stop.GRADIENT
    assert abs(result.x[0]) < 1e-6 * np.arctan(start) * 2
    costs = [record.cost for record in result.history]
    assert costs == sorted(costs, reverse=True)
    first = result.history[1].step
    full = np.arctan(start) * (1.0 + start**2)
    assert first in [0.5**k for k in range(31)]
    longer = Root().cost(np.array([start - 2 * first * full])) if first < 1.0 else np.inf
    assert longer > Root().cost(np.array([start])) * (1.0 - 2e-4 * 2 * first)


def test_a_problem_without_a_solution_stalls():
    class Singular(Root):
        def joint_step(self, x, parameter_damping):
            return None

    result = minimize(GaussNewton(), Singular(), [2.0])
    assert result.stop in (Stop.GRADIENT, Stop.NO_DECREASE)
    assert result.x[0] == 2.0
