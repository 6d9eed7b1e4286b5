"""What the deflection of the chest hangs on, of four numbers: Sobol indices by SALib: `pip install SALib`, then

    python salib_belt.py [points]

`occupant study` has the same analysis with intervals; this one is for those who have their own.
"""

import sys
from pathlib import Path

from SALib.analyze import sobol
from SALib.sample import sobol as sampling

import occupant

DRIVER = Path(__file__).resolve().parents[3] / "scenarios" / "templates" / "driver.toml"
PROBLEM = {
    "num_vars": 4,
    "names": ["car.seats.driver.limiter", "car.seats.driver.pretensioner", "car.bags.vent", "path.delta_v"],
    "bounds": [[2000, 6000], [0, 0.12], [0.5, 2], [12, 15]],
}


def indices(points, measure="chest_deflection"):
    matrix = sampling.sample(PROBLEM, points, calc_second_order=False, seed=1)
    table = occupant.Scenario(DRIVER).batch(PROBLEM["names"], matrix)
    return table, sobol.analyze(PROBLEM, table[measure], calc_second_order=False, seed=1)


if __name__ == "__main__":
    table, found = indices(int(sys.argv[1]) if len(sys.argv) > 1 else 32)
    for name, first, total in zip(PROBLEM["names"], found["S1"], found["ST"]):
        print(f"{name:32} first {first:5.2f}   total {total:5.2f}")
