"""Response surfaces of a study: a quadratic and a Gaussian process, with cross-validated errors: `pip install scikit-learn`, then

    python response_surface.py [samples]

A surface stands for runs where its error is small beside what is asked of it: the last lines compare it with runs that it has not seen.
"""

import sys
from pathlib import Path

import numpy as np
from sklearn.gaussian_process import GaussianProcessRegressor
from sklearn.gaussian_process.kernels import ConstantKernel, Matern, WhiteKernel
from sklearn.linear_model import RidgeCV
from sklearn.model_selection import KFold, cross_val_predict
from sklearn.pipeline import make_pipeline
from sklearn.preprocessing import PolynomialFeatures, StandardScaler

import occupant

DRIVER = Path(__file__).resolve().parents[3] / "scenarios" / "templates" / "driver.toml"
STUDY = {
    "base": str(DRIVER),
    "seed": 1,
    "parameters": [
        {"path": "car.seats.driver.limiter", "range": {"from": "2 kN", "to": "6 kN"}},
        {"path": "car.seats.driver.pretensioner", "range": {"from": "0 mm", "to": "120 mm"}},
        {"path": "car.bags.vent", "range": {"from": 0.5, "to": 2}},
    ],
}


def table(samples, seed=1):
    """Parameters and a measure of the completed runs of a Latin hypercube."""
    design = {"kind": "latin_hypercube", "samples": samples}
    runs = occupant.Study({**STUDY, "seed": seed, "design": design}).run()
    x = np.column_stack([column for name, column in runs.items() if name.startswith("input.")])
    y = runs["chest_deflection"]
    return x[np.isfinite(y)], y[np.isfinite(y)]


def surfaces(parameters):
    kernel = ConstantKernel() * Matern(np.ones(parameters), (1e-1, 1e3), nu=2.5) + WhiteKernel(1e-4, (1e-8, 1))
    return {
        "quadratic": make_pipeline(StandardScaler(), PolynomialFeatures(2), RidgeCV(np.logspace(-6, 2, 17))),
        "Gaussian process": make_pipeline(
            StandardScaler(), GaussianProcessRegressor(kernel, normalize_y=True, n_restarts_optimizer=3, random_state=1)
        ),
    }


def errors(x, y):
    """Each surface fitted to all runs, its root mean square error, and the share of the variance that it explains: of runs that were left
    out, a tenth at a time."""
    folds = KFold(10, shuffle=True, random_state=1)
    found = {}
    for name, surface in surfaces(x.shape[1]).items():
        off = cross_val_predict(surface, x, y, cv=folds) - y
        found[name] = surface.fit(x, y), np.sqrt(np.mean(off**2)), 1 - np.mean(off**2) / np.var(y)
    return found


if __name__ == "__main__":
    found = errors(*table(int(sys.argv[1]) if len(sys.argv) > 1 else 96))
    x, y = table(8, seed=2)
    for name, (surface, error, explained) in found.items():
        unseen = np.sqrt(np.mean((surface.predict(x) - y) ** 2))
        print(f"{name:17} {1e3 * error:5.2f} mm, {explained:6.1%} of the variance; runs not seen: {1e3 * unseen:5.2f} mm")
