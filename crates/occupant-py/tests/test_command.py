"""What the module gives is to the bit what the command gives, where that is built."""

import csv
import json
import os
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

import occupant

ROOT = Path(__file__).resolve().parents[3]
CART = ROOT / "scenarios" / "cart-lap-torso.toml"
STUDY = """
base = "base.toml"
set = { "time.end" = "30 ms" }
seed = 3
design = { kind = "latin_hypercube", samples = 5 }
[[parameters]]
name = "speed"
path = "path.speed"
range = { from = "10 mph", to = "30 mph" }
[[parameters]]
path = "belts.lap.slack"
distribution = { kind = "normal", mean = 0.5, sd = 0.1 }
"""


@pytest.fixture(scope="module")
def command():
    found = os.environ.get("OCCUPANT") or shutil.which("occupant", path=f"{ROOT}/target/release:{os.environ['PATH']}")
    if not found or not os.access(found, os.X_OK):
        pytest.skip("the command occupant is not here: build it, or say where it is in OCCUPANT")

    def run(*words, cwd=None, code=0):
        done = subprocess.run([found, *map(str, words)], capture_output=True, cwd=cwd, text=True, encoding="utf-8")
        assert done.returncode == code, done.stderr
        return done.stdout

    return run


def result(command, tmp_path, *words):
    file = tmp_path / "command.mcap"
    command("run", *words, "--quiet", "--force", "--output", file)
    return file


def same(own, answer):
    """Equal as JSON, but for how long it took."""

    def timeless(value):
        if isinstance(value, dict):
            return {key: timeless(one) for key, one in value.items() if key != "wall_time_s" and "cost" not in key}
        return [timeless(one) for one in value] if isinstance(value, list) else value

    assert timeless(json.loads(json.dumps(own))) == timeless(answer)


@pytest.mark.parametrize("name", ["cart-lap-torso", "airbag-driver", "two-vehicles", "side-slope"])
def test_a_result_file_is_that_of_the_command(command, tmp_path, name):
    scenario = ROOT / "scenarios" / f"{name}.toml"
    run = occupant.Scenario(scenario).run(until="40 ms")
    file = result(command, tmp_path, scenario, "--until", "40 ms")
    assert run.to_bytes() == file.read_bytes()
    run.save(tmp_path / "own.mcap")
    assert (tmp_path / "own.mcap").read_bytes() == file.read_bytes()


def test_changes_are_kept_as_the_command_keeps_them(command, tmp_path):
    scenario = occupant.Scenario(CART)
    scenario["path.speed"] = "25 mph"
    scenario["joints.*.damping"] = 2.0
    del scenario["belts.torso"]
    words = ["--set", "path.speed=25 mph", "--set", "joints.*.damping=2.0", "--set", "belts.torso=null"]
    file = result(command, tmp_path, CART, *words, "--set", "belts.lap.slack=0.5", "--until", "0.03")
    run = scenario.run(until=0.03, overrides={"belts.lap.slack": 0.5})
    assert run.to_bytes() == file.read_bytes()
    assert run.to_bytes() == scenario.run(overrides=["belts.lap.slack=0.5", "time.end=0.03"]).to_bytes()
    told = "with path.speed = 25 mph and joints.*.damping = 2.0 and belts.torso = null and 1 more"
    assert run.summary["title"].endswith(told)


def test_a_summary_is_that_of_the_command(command):
    for name in ("cart-lap-torso", "rear-seat"):
        scenario = ROOT / "scenarios" / f"{name}.toml"
        answer = json.loads(command("run", scenario, "--until", "60 ms", "--json", "--no-mcap", "--quiet"))
        own = occupant.Scenario(scenario).run(until="60 ms").summary
        same(own, {key: answer[key] for key in own})


@pytest.mark.parametrize("words", [{}, {"filter": "j211", "coefficients": "sae-j211"}, {"dummy": "thor-50m"}, {"interval": 5e-4}])
def test_measures_are_judged_as_by_the_command(command, tmp_path, words):
    file = result(command, tmp_path, CART, "--until", "60 ms")
    flags = [flag for name, value in words.items() for flag in (f"--{name}", value)]
    answer = json.loads(command("measures", file, *flags, "--json"))
    same(occupant.read(file).judge(**words) | {"file": ""}, answer | {"file": ""})
    own = occupant.Scenario(CART).run(until="60 ms").judge(**words)
    same(own["measures"], answer["measures"])


def test_a_table_is_that_of_a_sweep(command, tmp_path):
    (tmp_path / "base.toml").write_text(CART.read_text())
    (tmp_path / "study.toml").write_text(STUDY)
    command("sweep", tmp_path / "study.toml", "--output", tmp_path / "out", "--csv", "--quiet")
    rows = list(csv.reader((tmp_path / "out/results.csv").open(newline="", encoding="utf-8")))
    study = occupant.Study(tmp_path / "study.toml")
    for table in (study.run(), occupant.Study.from_text(STUDY, folder=tmp_path).run()):
        assert list(table) == rows[0]
        for name, *cells in zip(*rows):
            if name in ("wall_time_s", "kernel"):
                continue
            own = table[name]
            theirs = [float(cell or "nan") for cell in cells] if isinstance(own, np.ndarray) else [c or None for c in cells]
            np.testing.assert_array_equal(own, theirs, name)
    columns = {name: unit for name, unit, _ in csv.reader((tmp_path / "out/columns.csv").open(encoding="utf-8"))}
    assert {one["name"]: one["unit"] for one in study.columns}.items() <= columns.items()
    matrix = [[f"{float(speed)!r} m/s"] for speed in table["input.speed"]]
    assert list(occupant.Scenario(CART).batch(["path.speed"], matrix)) == [
        "input.path.speed" if name == "input.speed" else name for name in rows[0] if name != "input.belts.lap.slack"
    ]


def test_a_sweep_and_its_report_are_those_of_the_command(command, tmp_path):
    (tmp_path / "base.toml").write_text(CART.read_text())
    (tmp_path / "study.toml").write_text(STUDY)
    command("sweep", "study.toml", "--output", "theirs", "--csv", "--keep", "1", "--quiet", cwd=tmp_path)
    answer = json.loads(command("study", "report", "theirs", "--to", "head.peak", "--limit", "head.peak=50 g", "--json", cwd=tmp_path))
    seen = []
    study = occupant.Study(tmp_path / "study.toml")
    own = tmp_path / "own"
    assert "5 samples" in study.sweep(own, csv=True, keep="1", progress=lambda *now: seen.append(now))
    assert seen[-1] == (5, 5)
    assert (own / "runs/000001.mcap").read_bytes() == (tmp_path / "theirs/runs/000001.mcap").read_bytes()
    tables = [(tmp_path / name / "columns.csv").read_bytes() for name in ("own", "theirs")]
    assert tables[0] == tables[1]
    same(occupant.study_report(own, to=["head.peak"], limits=["head.peak=50 g"]), answer)
    assert (own / "report.html").stat().st_size > 10_000
    # an earlier page of the same study is replaced, another file is not
    occupant.study_report(own, to=["head.peak"])
    (tmp_path / "other.html").write_text("mine")
    with pytest.raises(occupant.OccupantError, match="exists"):
        occupant.study_report(own, path=tmp_path / "other.html", to=["head.peak"])
    for wrong in ({"keep": "some"}, {"keep": "9"}):
        with pytest.raises(occupant.OccupantError, match="keep"):
            study.sweep(tmp_path / "more", **wrong)
    with pytest.raises(occupant.OccupantError, match="does not contain a sweep"):
        occupant.study_report(tmp_path)


def test_ratings_are_those_of_the_command(command, tmp_path):
    first = result(command, tmp_path, CART, "--until", "60 ms").rename(tmp_path / "first.mcap")
    second = result(command, tmp_path, CART, "--until", "60 ms", "--set", "path.speed=22 mph")
    words = ["--channel", "head.acceleration.*", "--shift", "1 ms", "--filter", "cfc180", "--from", "10 ms"]
    answer = json.loads(command("compare", first, second, *words, "--json"))
    options = {"channels": ["head.acceleration.*"], "shift": 1e-3, "filter": "cfc180", "start": 0.01}
    own = occupant.compare(first, second, **options)
    assert own.pop("worthless") == []
    same(own, answer)
    runs = [occupant.read(first), occupant.Scenario(CART).run(until="60 ms", overrides=["path.speed=22 mph"])]
    same(occupant.compare(*runs, **options)["pairs"], answer["pairs"])


def test_points_are_those_of_the_command(command, tmp_path):
    driver = ROOT / "scenarios" / "airbag-driver.toml"
    file = result(command, tmp_path, driver, "--until", "60 ms")
    rating = "euro-ncap-2026-full-width"
    words = ["--rating", rating, "--place", "driver", "--json"]
    answer = json.loads(command("measures", file, *words, "-o", tmp_path / "theirs.csv"))
    own = occupant.rate(rating, file, places=["driver"], path=tmp_path / "own.csv")
    same(own, answer)
    assert (tmp_path / "own.csv").read_bytes() == (tmp_path / "theirs.csv").read_bytes()
    same(occupant.rate(rating, values=tmp_path / "own.csv"), json.loads(
        command("measures", "--rating", rating, "--values", tmp_path / "own.csv", "--json")))
    with pytest.raises(occupant.OccupantError, match="expected one of euro-ncap-2026-frontal"):
        occupant.rate("euro", file)
    with pytest.raises(occupant.OccupantError, match="no run and no values"):
        occupant.rate(rating)
    with pytest.raises(occupant.OccupantError, match="no occupant of"):
        occupant.rate(rating, file, places=["pilot"])


def test_a_report_is_that_of_the_command(command, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    result(command, tmp_path, CART, "--until", "40 ms")
    other = occupant.Scenario(CART).run(until="40 ms", overrides={"path.speed": "22 mph"})
    other.save("cart-lap-torso.mcap")
    words = ["--channel", "belt.lap.force", "--output", "theirs.html"]
    command("report", "command.mcap", "cart-lap-torso.mcap", *words, cwd=tmp_path)
    occupant.report("command.mcap", other, path="own.html", channels=["belt.lap.force"])
    assert Path("own.html").read_bytes() == Path("theirs.html").read_bytes()
    with pytest.raises(occupant.OccupantError, match="exists"):
        occupant.report("command.mcap", path="own.html")


def test_pictures_are_those_of_the_command(command, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    result(command, tmp_path, CART, "--until", "40 ms").rename("cart-lap-torso.mcap")
    run = occupant.Scenario(CART).run(until="40 ms")
    ghost = occupant.Scenario(CART).run(until="40 ms", overrides={"path.speed": "22 mph"})
    ghost.save("ghost.mcap")

    def same_as(own, *words):
        command("view", *words, "--output", f"theirs-{own}", cwd=tmp_path)
        assert Path(own).read_bytes() == Path(f"theirs-{own}").read_bytes()

    occupant.view(run, "strip.svg", times="0, 20, 40 ms", views=["top", "side"])
    same_as("strip.svg", "cart-lap-torso.mcap", "--times", "0, 20, 40 ms", "--views", "top,side")
    occupant.view("cart-lap-torso.mcap", "two.svg", times=[0.0, 0.02])
    same_as("two.svg", "cart-lap-torso.mcap", "--times", "0, 0.02")
    occupant.view(occupant.Scenario(CART), "start.png", dimensions=True)
    same_as("start.png", CART, "--dimensions")
    occupant.view(run, "solid.png", times=[0.03], solid=True, camera="chase", size=(320, 180), ghosts=["ghost.mcap"])
    words = ["--3d", "--camera", "chase", "--size", "320x180", "--ghost", "ghost.mcap", "--times", "0.03"]
    same_as("solid.png", "cart-lap-torso.mcap", *words)
    seen = []
    occupant.film(run, "film.gif", slow_motion=10, freeze=0.02, progress=lambda *now: seen.append(now))
    same_as("film.gif", "cart-lap-torso.mcap", "--slow-motion", "10", "--freeze", "20 ms")
    assert seen[-1][0] == seen[-1][1] == 61
    occupant.film(run, "frames", slow_motion=10)
    assert len(list(Path("frames").glob("*.png"))) == 11


def test_derivatives_are_those_of_the_command(command):
    words = ["--to", "hic15", "--of", "joints.neck.damping,path.delta_v"]
    answer = json.loads(command("sensitivity", CART, "--set", "time.end=60 ms", *words, "--json", "--quiet"))
    scenario = occupant.Scenario(CART)
    scenario["time.end"] = "60 ms"
    own = scenario.sensitivity(to=["hic15"], of=["joints.neck.damping", "path.delta_v"])
    assert own.keys() == answer.keys()
    same(own["parameters"], answer["parameters"])
    same(own["measures"], answer["measures"])


FIT = """
base = "base.toml"
set = { "time.end" = "30 ms" }
[[parameters]]
path = "belts.lap.slack"
range = { from = 0.2, to = 0.9 }
[fit]
budget = 12
channels = [{ channel = "belt.lap.force" }]
"""
OPTIMUM = """
base = "base.toml"
set = { "time.end" = "40 ms" }
[[parameters]]
path = "belts.lap.slack"
range = { from = 0.2, to = 0.9 }
[optimise]
minimise = "belts.lap.peak"
budget = 12
"""


def test_a_fit_is_that_of_the_command(command, tmp_path):
    (tmp_path / "base.toml").write_text(CART.read_text())
    (tmp_path / "study.toml").write_text(FIT)
    run = occupant.Scenario(CART).run(until="30 ms", overrides={"belts.lap.slack": 0.5})
    test = ["time[s],belt.lap.force[N]"] + [f"{t},{f}" for t, f in zip(run.time, run["belt.lap.force"])]
    (tmp_path / "test.csv").write_text("\n".join(test))
    words = ["fit", "study.toml", "--test", "test.csv", "--output", "theirs", "--json", "--quiet"]
    answer = json.loads(command(*words, cwd=tmp_path))
    study = occupant.Study(tmp_path / "study.toml")
    seen = []
    own = study.fit(tests=[tmp_path / "test.csv"], folder=tmp_path / "own", progress=lambda *now: seen.append(now))
    same(own["parameters"], answer["parameters"])
    same(own["score"], answer["score"])
    assert (tmp_path / "own/fitted.toml").read_bytes() == (tmp_path / "theirs/fitted.toml").read_bytes()
    assert seen and own["parameters"][0]["name"] == "belts.lap.slack"


def test_an_optimum_is_that_of_the_command(command, tmp_path):
    (tmp_path / "base.toml").write_text(CART.read_text())
    (tmp_path / "study.toml").write_text(OPTIMUM)
    answer = json.loads(command("optimise", "study.toml", "--output", "theirs", "--json", "--quiet", cwd=tmp_path))
    own = occupant.Study(tmp_path / "study.toml").optimise()
    same(own["parameters"], answer["parameters"])
    same(own["goal"], answer["goal"])
