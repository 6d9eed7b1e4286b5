"""Limiter, pretensioner and vent for the least deflection of the chest, by Optuna: `pip install optuna`, then

    python optuna_belt.py [trials]

Each round asks for eight candidates and runs them together. A candidate whose head goes too far pays for every millimetre.
"""

import sys
from pathlib import Path

import optuna

import occupant

DRIVER = Path(__file__).resolve().parents[3] / "scenarios" / "templates" / "driver.toml"
RANGES = {
    "car.seats.driver.limiter": (2000.0, 6000.0),  # N
    "car.seats.driver.pretensioner": (0.0, 0.12),  # m
    "car.bags.vent": (0.5, 2.0),
}
MOST_FORWARD_M = 0.45
ROUND = 8


def costs(table):
    """Deflection of the chest, mm, and a millimetre more for each that the head goes too far; none of a run that failed."""
    beyond = (table["head_excursion.forward"] - MOST_FORWARD_M).clip(0)
    cost = 1e3 * (table["chest_deflection"] + beyond)
    return [float(own) if own == own else None for own in cost]


def optimise(trials):
    scenario = occupant.Scenario(DRIVER)
    study = optuna.create_study(sampler=optuna.samplers.TPESampler(seed=1))
    while len(study.trials) < trials:
        asked = [study.ask() for _ in range(min(ROUND, trials - len(study.trials)))]
        rows = [[own.suggest_float(path, *ends) for path, ends in RANGES.items()] for own in asked]
        for own, cost in zip(asked, costs(scenario.batch(list(RANGES), rows))):
            state = optuna.trial.TrialState.FAIL if cost is None else optuna.trial.TrialState.COMPLETE
            study.tell(own, cost, state=state)
    return study


if __name__ == "__main__":
    optuna.logging.set_verbosity(optuna.logging.WARNING)
    best = optimise(int(sys.argv[1]) if len(sys.argv) > 1 else 64)
    print(f"{best.best_value:.1f} mm with", {path: float(f"{x:.4g}") for path, x in best.best_params.items()})
