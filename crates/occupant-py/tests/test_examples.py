"""The examples run with what they need; without it they are skipped with its name."""

import runpy
from pathlib import Path

import numpy as np
import pytest

EXAMPLES = Path(__file__).resolve().parents[1] / "examples"


def example(name, package):
    pytest.importorskip(package)
    return runpy.run_path(str(EXAMPLES / f"{name}.py"))


def test_every_example_is_tested():
    tested = Path(__file__).read_text()
    assert all(f'"{one.stem}"' in tested for one in EXAMPLES.glob("*.py"))


def test_optuna():
    study = example("optuna_belt", "optuna")["optimise"](16)
    values = [own.value for own in study.trials]
    assert len(values) == 16 and study.best_value == min(values) and study.best_value < values[0]


def test_pymoo():
    found = example("pymoo_belt", "pymoo")["front"](2)
    chest, head = found.F[np.argsort(found.F[:, 0])].T
    assert len(chest) > 1 and (np.diff(head) < 0).all() and 0.01 < chest[0] < 0.1


def test_salib():
    table, found = example("salib_belt", "SALib")["indices"](4)
    assert len(table["index"]) == 4 * (4 + 2) and np.isfinite(found["ST"]).all()


def test_response_surface():
    names = example("response_surface", "sklearn")
    found = names["errors"](*names["table"](40))
    assert {*found} == {"quadratic", "Gaussian process"}
    assert all(error < 4e-3 and explained > 0.9 for _, error, explained in found.values())


def test_gymnasium():
    names = example("gymnasium_belt", "gymnasium")
    from gymnasium.utils.env_checker import check_env

    check_env(names["ControlledLimiter"](0.01))
    # without the belt's force he strikes the wheel
    soft, hard = (names["play"](force_n) for force_n in (1000.0, 8000.0))
    assert soft[1] > 1.5 * hard[1] and soft[0] < hard[0] < 0
