"""Every notebook of the examples runs, cell by cell, without Jupyter; so does the measure of the book."""

import json
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]
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


def test_the_own_measure_of_the_book_runs(monkeypatch, capsys, tmp_path):
    page = (ROOT / "docs/guides/own-measure.md").read_text()
    first, *_ = re.findall(r"^```python\n(.*?)^```", page, re.M | re.S)
    (tmp_path / "my-case.toml").write_text((ROOT / "scenarios/templates/driver.toml").read_text())
    monkeypatch.chdir(tmp_path)
    exec(compile(first, "own-measure.md", "exec"), {})
    printed = capsys.readouterr().out.strip()
    assert printed in page, f"the page does not say: {printed}"
