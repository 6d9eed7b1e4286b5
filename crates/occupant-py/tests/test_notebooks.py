"""Every notebook of the examples runs, cell by cell, without Jupyter."""

import json
from pathlib import Path

import pytest

EXAMPLES = Path(__file__).resolve().parents[1] / "examples"
NOTEBOOKS = sorted(EXAMPLES.glob("*.ipynb"))


@pytest.mark.parametrize("notebook", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_runs_from_its_first_cell_to_its_last(notebook, monkeypatch):
    monkeypatch.chdir(EXAMPLES)
    names = {}
    for cell in json.loads(notebook.read_text())["cells"]:
        if cell["cell_type"] == "code":
            assert not cell["outputs"], "a notebook is kept without its outputs"
            exec(compile("".join(cell["source"]), f"{notebook.name}:{cell['id']}", "exec"), names)


def test_there_is_a_notebook():
    assert NOTEBOOKS
