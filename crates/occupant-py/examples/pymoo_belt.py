"""Limiter, pretensioner and vent: what the chest gains, the head loses. The front between both by pymoo: `pip install pymoo`, then

    python pymoo_belt.py [generations]

A generation is one batch.
"""

import sys
from pathlib import Path

import numpy as np
from pymoo.algorithms.moo.nsga2 import NSGA2
from pymoo.core.problem import Problem
from pymoo.optimize import minimize

import occupant

DRIVER = Path(__file__).resolve().parents[3] / "scenarios" / "templates" / "driver.toml"
PATHS = ["car.seats.driver.limiter", "car.seats.driver.pretensioner", "car.bags.vent"]
GOALS = ["chest_deflection", "head_excursion.forward"]  # m
POPULATION = 16


class Belt(Problem):
    def __init__(self):
        super().__init__(n_var=3, n_obj=2, xl=np.array([2000.0, 0.0, 0.5]), xu=np.array([6000.0, 0.12, 2.0]))
        self.scenario = occupant.Scenario(DRIVER)

    def _evaluate(self, x, out, *_, **__):
        table = self.scenario.batch(PATHS, x)
        # a run that failed is worse than any other
        out["F"] = np.nan_to_num(np.column_stack([table[goal] for goal in GOALS]), nan=1e3)


def front(generations):
    return minimize(Belt(), NSGA2(pop_size=POPULATION), ("n_gen", generations), seed=1)


if __name__ == "__main__":
    found = front(int(sys.argv[1]) if len(sys.argv) > 1 else 8)
    for (limiter, pretensioner, vent), (chest, head) in sorted(zip(found.X, found.F), key=lambda own: own[1][0]):
        print(f"chest {1e3 * chest:5.1f} mm, head {1e3 * head:5.0f} mm: {limiter:5.0f} N, {1e3 * pretensioner:4.0f} mm, vent {vent:.2f}")
