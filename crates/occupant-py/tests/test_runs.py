"""Runs and studies as results: files, pickles, tables, progress; and what is refused."""

import copy
import multiprocessing
import os
import pickle
import signal
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

import occupant

ROOT = Path(__file__).resolve().parents[3]
CART = ROOT / "scenarios" / "cart-lap-torso.toml"
DESIGN = {
    "seed": 3,
    "set": {"time.end": "40 ms"},
    "design": {"kind": "sobol", "samples": 4},
    "parameters": [{"name": "speed", "path": "path.speed", "range": {"from": "10 mph", "to": "30 mph"}}],
}


@pytest.fixture
def scenario():
    scenario = occupant.Scenario(CART)
    scenario["time.end"] = "20 ms"
    return scenario


@pytest.fixture(scope="module")
def run():
    return occupant.Scenario(CART).run(until="20 ms")


def test_all_paths_have_values_units_and_meanings(scenario):
    every = scenario.paths()
    assert len(every) > 200 and len({one["path"] for one in every}) == len(every)
    for one in every:
        assert scenario[one["path"]] == one["value"], one
        assert one["meaning"] or one["path"].startswith("provenance."), one
    [slack] = scenario.paths("belts.lap.slack")
    assert slack["unit"] == "in" and "Slack" in slack["meaning"]
    scenario["path.speed"] = "25 mph"
    [speed] = scenario.paths("path.sp*d")
    assert (speed["value"], speed["unit"]) == ("25 mph", "in/s")
    # of the keys that kinds share, that of the kind
    assert "deceleration pulse" in scenario.paths("path.kind")[0]["meaning"]
    # joints and materials of presets too
    assert len(scenario.paths("joints.*.damping")) >= 3 and scenario.paths("nothing.*") == []
    for odd in ("", "**", "a.b[", "ä.🙂", "*\0*", "." * 10000):
        assert isinstance(scenario.paths(odd), list)


def test_a_run_is_changed_for_once(scenario):
    before = scenario["belts.lap.slack"]
    run = scenario.run(until=0.01, overrides={"belts.lap.slack": 0.9})
    assert run.time[-1] == pytest.approx(0.01) and scenario["belts.lap.slack"] == before
    assert scenario.run().time[-1] == pytest.approx(0.02)
    for wrong in ({"a=b": 1}, {"": 1}, ["belts.lap.slack"], ["nothing.here=1"], "belts.lap.slack=1"):
        with pytest.raises(occupant.OccupantError):
            scenario.run(overrides=wrong)
    for wrong in (float("nan"), float("inf"), -1.0, 0.0, "soon", "", "5 kg", [1], {}, True, 1e300):
        with pytest.raises(occupant.OccupantError):
            scenario.run(until=wrong)
    with pytest.raises(TypeError):
        scenario.run(overrides=3)


def test_a_text_stays_a_text(scenario):
    for text in ("1.5", "true", "'a'", " blank ", "", "a\nb", 'quo"te', "ä = 🙂", "[1, 2]", "#", "\x7f", "\\"):
        scenario["notes"] = text
        assert scenario["notes"] == text, repr(text)
        assert pickle.loads(pickle.dumps(scenario))["notes"] == text
    assert scenario.run().status == "completed"


def test_a_result_file_is_the_run(run, tmp_path):
    run.save(tmp_path / "run.mcap")
    read = occupant.read(tmp_path / "run.mcap")
    assert read.to_bytes() == run.to_bytes() and read.measures == run.measures and read.status == "completed"
    names = [one["name"] for one in run.channels()]
    assert names == [one["name"] for one in read.channels()]
    for (name, ours), theirs in zip(run.series_of("*").items(), read.series_of("*").values()):
        np.testing.assert_array_equal(ours, theirs, name)
    assert any(caveat["name"] == "part_of_a_run" for caveat in read.caveats) and read.notes and run.notes == []
    with pytest.raises(occupant.OccupantError, match="exists"):
        run.save(tmp_path / "run.mcap")
    run.save(tmp_path / "run.mcap", force=True)
    with pytest.raises(occupant.OccupantError, match="mcap"):
        run.save(tmp_path / "run.csv")
    with pytest.raises(occupant.OccupantError):
        run.save(tmp_path / "no" / "folder" / "run.mcap")


def test_what_is_no_result_file_is_refused(run, tmp_path):
    whole = run.to_bytes()
    rng = np.random.default_rng(1)
    for bad in (b"", b"\x89MCAP0", whole[:100], CART.read_bytes(), bytes(rng.integers(0, 256, 5000, dtype=np.uint8))):
        with pytest.raises(occupant.OccupantError):
            occupant.Run.from_bytes(bad)
        (tmp_path / "bad.mcap").write_bytes(bad)
        with pytest.raises(occupant.OccupantError, match="bad.mcap"):
            occupant.read(tmp_path / "bad.mcap")
    for _ in range(60):
        cut = bytearray(whole)
        for at in rng.integers(0, len(cut), 20):
            cut[at] = rng.integers(0, 256)
        try:
            assert occupant.Run.from_bytes(bytes(cut)).time.size > 0
        except occupant.OccupantError:
            pass
    whole = occupant.Scenario(CART).run(until="150 ms").to_bytes()
    half = occupant.Run.from_bytes(whole[: len(whole) * 2 // 3])
    assert half.status == "interrupted" and half.notes
    with pytest.raises(FileNotFoundError):
        occupant.read(tmp_path / "none.mcap")
    with pytest.raises(IsADirectoryError):
        occupant.read(tmp_path)
    with pytest.raises(TypeError):
        occupant.read(3)


def test_a_study_is_a_dict_with_any_design(scenario, tmp_path):
    base = tmp_path / "base.toml"
    base.write_text(CART.read_text())
    tables = [
        occupant.Study({**DESIGN, "base": str(base)}).run(),
        occupant.Study({**DESIGN, "base": "base.toml"}, folder=tmp_path).run(),
        occupant.Study({**DESIGN, "base": Path("base.toml"), "seed": np.int64(3)}, folder=tmp_path).run(),
        occupant.Study({**DESIGN, "base": scenario}).run(),
        occupant.Study({**DESIGN, "base": {"title": "a", **whole(scenario)}}).run(),
    ]
    for table in tables:
        for name in ("index", "input.speed", "hic15", "belts.lap.peak"):
            np.testing.assert_array_equal(table[name], tables[0][name])
        assert table["status"] == ["completed"] * 4
    scenario["belts.lap.slack"] = 0.9
    changed = occupant.Study({**DESIGN, "base": scenario})
    assert (changed.run()["belts.lap.peak"] != tables[0]["belts.lap.peak"]).all()
    assert changed.scenario(2)["belts.lap.slack"] == 0.9 and changed.scenario(2)["time.end"] == "40 ms"
    speeds = np.linspace(5.0, 8.0, 3)
    listed = [{"name": "speed", "path": "path.speed", "list": speeds}]
    grid = occupant.Study({"base": scenario, "design": {"kind": "full_factorial"}, "parameters": listed})
    np.testing.assert_allclose([grid.sample(i)["speed"] for i in range(3)], speeds, rtol=1e-9)
    # what the study sets holds over what its base brings
    assert changed.scenario(0).run().measures["hic15"] == changed.run()["hic15"][0]
    set_too = occupant.Study({**DESIGN, "base": scenario, "set": {"belts.lap.slack": 0.2, "time.end": "10 ms"}})
    assert set_too.scenario(0)["belts.lap.slack"] == 0.2 and set_too.scenario(0).run().time[-1] == pytest.approx(0.01)
    assert {"name": "input.speed", "unit": "m/s", "role": "input"} in changed.columns


def test_a_study_in_memory_is_swept_into_a_folder(scenario, tmp_path):
    scenario["belts.lap.slack"] = 0.9
    study = occupant.Study({**DESIGN, "base": scenario})
    study.sweep(tmp_path / "out", keep="all")
    kept = occupant.read(tmp_path / "out/runs/000002.mcap")
    assert kept.measures["hic15"] == study.run()["hic15"][2]
    assert occupant.study_report(tmp_path / "out", to=["head.peak"])
    # a second time it is there already, another study is refused
    study.sweep(tmp_path / "out")
    with pytest.raises(occupant.OccupantError, match="another|other"):
        occupant.Study({**DESIGN, "seed": 4, "base": scenario}).sweep(tmp_path / "out")
    scenario.add_force("lift", ["head"], push)
    with pytest.raises(occupant.OccupantError, match="forces of Python"):
        occupant.Study({**DESIGN, "base": scenario})


def whole(scenario):
    import tomllib

    return tomllib.loads(CART.read_text())


def test_a_wrong_study_says_where(tmp_path):
    (tmp_path / "base.toml").write_text(CART.read_text())
    text = 'base = "base.toml"\ndesign = { kind = "sobol", samples = 4 }\n[[parameters]]\npath = "path.spede"\nlist = [1]\n'
    with pytest.raises(occupant.OccupantError, match="path.spede") as raised:
        occupant.Study.from_text(text, folder=tmp_path)
    [problem] = raised.value.problems
    assert problem["line"] == 4 and problem["source"].endswith("study.toml")
    with pytest.raises(occupant.OccupantError, match="cannot be read"):
        occupant.Study.from_text(text.replace("base.toml", "none.toml"), folder=tmp_path)
    with pytest.raises(FileNotFoundError):
        occupant.Study(tmp_path / "none.toml")
    for wrong in ({}, {"base": 3}, {"base": None}, {**DESIGN}, {**DESIGN, "base": str(CART), "seed": float("nan")}, {"base": str(CART), "desgin": 1}):
        with pytest.raises((occupant.OccupantError, TypeError)):
            occupant.Study(wrong)
    search = occupant.Study.from_text(
        'base = "base.toml"\n[[parameters]]\npath = "belts.lap.slack"\nrange = { from = 0.2, to = 0.9 }\n'
        '[optimise]\nminimise = "belts.lap.peak"\n',
        folder=tmp_path,
    )
    with pytest.raises(occupant.OccupantError, match="design"):
        search.run()
    with pytest.raises(occupant.OccupantError, match="design"):
        len(search)
    with pytest.raises(occupant.OccupantError, match="no file|test to fit"):
        search.fit()


def test_scenarios_studies_and_runs_are_pickled(scenario, run, tmp_path):
    scenario["path.speed"] = "25 mph"
    del scenario["belts.torso"]
    for again in (pickle.loads(pickle.dumps(scenario)), copy.deepcopy(scenario)):
        assert again.to_toml() == scenario.to_toml() and again["path.speed"] == "25 mph"
        assert again.run().to_bytes() == scenario.run().to_bytes()
    study = occupant.Study({**DESIGN, "base": scenario})
    again = pickle.loads(pickle.dumps(study))
    np.testing.assert_array_equal(again.run()["hic15"], study.run()["hic15"])
    assert again.scenario(1).to_toml() == study.scenario(1).to_toml()
    again = pickle.loads(pickle.dumps(run))
    assert again.to_bytes() == run.to_bytes() and again.measures == run.measures
    # what a pickle brings is checked as what a file brings
    state = pickle.dumps(run)
    with pytest.raises(occupant.OccupantError):
        pickle.loads(state.replace(b"\x89MCAP0", b"\x89MCAP1"))


def measured(scenario):
    return scenario.run().measures["hic15"]


def push(t, places, velocities):
    return [[0.0, 0.0, 10.0]]


def test_a_pool_of_processes_takes_scenarios(scenario):
    scenario.add_force("lift", ["head"], push)
    scenario.add_force("side", [("head", [0, 0, 0.1])], push)
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        [there] = pool.map(measured, [scenario])
    assert there == measured(scenario)
    with pytest.raises(occupant.OccupantError, match="forces of Python"):
        scenario.run().to_bytes()
    scenario.add_force("nameless", ["head"], lambda t, places, velocities: push(t, places, velocities))
    with pytest.raises((pickle.PicklingError, AttributeError)):
        pickle.dumps(scenario)


def test_progress_is_seen_and_stops_the_work(scenario):
    for work in (
        lambda progress: scenario.run(progress=progress),
        lambda progress: scenario.batch(["path.speed"], [[300.0], [310.0]], progress=progress),
        lambda progress: occupant.Study({**DESIGN, "base": scenario}).run(progress=progress),
    ):
        seen = []
        work(lambda *now: seen.append(now))
        assert seen[-1][0] == seen[-1][1] and all(done <= every for done, every in seen)
        with pytest.raises(ZeroDivisionError):
            work(lambda done, every: 1 / 0)
        work(False), work(None)
        with pytest.raises(occupant.OccupantError, match="progress"):
            work(3)


def test_progress_is_a_bar_of_tqdm(scenario, capsys):
    pytest.importorskip("tqdm")
    scenario.batch(["path.speed"], [[300.0], [310.0]], progress=True)
    assert "2/2" in capsys.readouterr().err


@pytest.mark.skipif(os.name == "nt", reason="signals")
def test_an_interrupt_stops_runs(scenario):
    scenario["time.end"] = "20 s"
    scenario["integrator"] = {"kind": "rk4", "step": 1e-5}
    for work in (lambda: scenario.run(), lambda: scenario.batch(["path.speed"], [[300.0]] * 8, threads=2)):
        threading.Timer(0.4, os.kill, (os.getpid(), signal.SIGINT)).start()
        began = time.monotonic()
        with pytest.raises(KeyboardInterrupt):
            work()
        assert time.monotonic() - began < 10


def test_pandas_and_xarray_have_units(run):
    pandas, wanted = pytest.importorskip("pandas"), ("belt.*.force", "head.acceleration.x")
    frame = run.to_pandas(*wanted)
    assert isinstance(frame, pandas.DataFrame) and frame.index.name == "time_s"
    assert frame.attrs["units"]["belt.lap.force"] == "N" and frame.attrs["meanings"]["belt.lap.force"]
    np.testing.assert_array_equal(frame["head.acceleration.x"], run["head.acceleration.x"])
    np.testing.assert_array_equal(frame.index, run.time)
    assert len(run.to_pandas().columns) == len(run.channels())
    assert len(pandas.DataFrame(occupant.Study({**DESIGN, "base": str(CART)}).run())) == 4


def test_xarray_has_units(run):
    pytest.importorskip("xarray")
    data = run.to_xarray("belt.*.force")
    assert data["belt.lap.force"].attrs["units"] == "N" and data["time"].attrs["units"] == "s"
    np.testing.assert_array_equal(data["belt.lap.force"], run["belt.lap.force"])


def test_what_is_not_installed_is_named(run, monkeypatch):
    for module in ("pandas", "xarray", "tqdm.auto"):
        monkeypatch.setitem(__import__("sys").modules, module, None)
    for work in (run.to_pandas, run.to_xarray, lambda: occupant.Scenario(CART).run(progress=True)):
        with pytest.raises(occupant.OccupantError, match="pip install"):
            work()


def test_measures_are_refused_in_words(run):
    for wrong in ({"filter": "cfc5"}, {"dummy": "me"}, {"coefficients": ""}, {"interval": 0.0}, {"interval": float("nan")}):
        with pytest.raises(occupant.OccupantError, match=next(iter(wrong))):
            run.judge(**wrong)
    judged = run.judge(dummy="thor-50m")
    assert judged["dummy"].startswith("THOR") and any(one["limits"] for one in judged["measures"])
    [limit, *_] = next(one["limits"] for one in judged["measures"] if one["limits"])
    assert {"rule", "most", "passed"} <= limit.keys()


def test_comparisons_and_pictures_are_refused_in_words(run, tmp_path):
    for wrong in ({"filter": "cfc5"}, {"start": float("nan")}, {"maps": ["x"]}, {"channels": ["nothing"]}, {"coefficients": "x"}):
        with pytest.raises(occupant.OccupantError):
            occupant.compare(run, run, **wrong)
    assert occupant.compare(run, run, channels=["head.acceleration.x"])["pairs"][0]["iso18571"]["overall"] == 1.0
    for path, options in (
        ("a.svg", {"times": [9.0]}),
        ("a.svg", {"times": "now"}),
        ("a.svg", {"times": [float("nan")]}),
        ("a.svg", {"times": list(range(200))}),
        ("a.svg", {"views": ["back"]}),
        ("a.svg", {"solid": True}),
        ("a.png", {"solid": True, "camera": "moon"}),
        ("a.png", {"solid": True, "size": (1, 1)}),
        ("a.png", {"ghosts": [run]}),
        ("a.pdf", {}),
        ("a.gif", {}),
        ("no/folder/a.svg", {}),
    ):
        with pytest.raises(occupant.OccupantError):
            occupant.view(run, tmp_path / path, **options)
    for path, options in (("a.svg", {}), ("a.gif", {"slow_motion": 0.0}), ("a.gif", {"freeze": 9.0}), ("a.gif", {"slow_motion": 1e4})):
        with pytest.raises(occupant.OccupantError):
            occupant.film(run, tmp_path / path, **options)
    with pytest.raises(occupant.OccupantError, match="run"):
        occupant.film(occupant.Scenario(CART), tmp_path / "a.gif")
    for runs in ([], [run] * 5):
        with pytest.raises(occupant.OccupantError, match="1 to 4"):
            occupant.report(*runs, path=tmp_path / "a.html")
    with pytest.raises(TypeError):
        occupant.report(3, path=tmp_path / "a.html")
    assert list(tmp_path.iterdir()) == []


def test_derivatives_are_refused_in_words(scenario):
    for to, of in (([], []), (["nothing"], ["path.delta_v"]), (["hic15"], ["nothing.here"]), (["hic15"], ["title"])):
        with pytest.raises(occupant.OccupantError):
            scenario.sensitivity(to=to, of=of)


def test_a_search_is_resumed_and_stopped(tmp_path):
    (tmp_path / "base.toml").write_text(CART.read_text())
    text = (
        'base = "base.toml"\nset = { "time.end" = "40 ms" }\n[[parameters]]\npath = "belts.lap.slack"\n'
        'range = { from = 0.2, to = 0.9 }\n[optimise]\nminimise = "belts.lap.peak"\nbudget = 12\n'
    )
    study = occupant.Study.from_text(text, folder=tmp_path)

    def stop(done, every):
        if done > 6:
            raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        study.optimise(folder=tmp_path / "out", progress=stop)
    resumed, whole = study.optimise(folder=tmp_path / "out"), study.optimise()
    assert resumed["goal"] == whole["goal"] and (tmp_path / "out/best.toml").is_file()
    (tmp_path / "other").mkdir()
    (tmp_path / "other/file.txt").write_text("mine")
    (tmp_path / "full").write_text("a file")
    with pytest.raises(occupant.OccupantError):
        study.optimise(folder=tmp_path / "full")


def test_messages_go_to_the_logger(run, tmp_path, caplog):
    with caplog.at_level("INFO", logger="occupant"):
        occupant.view(run, tmp_path / "a.svg", times=[0.0])
        occupant.compare(run, run, channels=["head.acceleration.x", "nothing*"])
    assert any("part" in one.message or "nothing*" in one.message for one in caplog.records)


def test_many_threads_share_a_run_and_a_scenario(scenario):
    run = scenario.run()
    with ThreadPoolExecutor(8) as pool:
        files = list(pool.map(lambda _: run.to_bytes(), range(8)))
        tables = list(pool.map(lambda _: scenario.batch(["path.speed"], [[300.0], [310.0]], threads=2), range(4)))
    assert all(file == files[0] for file in files)
    assert all(np.array_equal(table["hic15"], tables[0]["hic15"]) for table in tables)


def test_a_large_matrix_is_one_table(scenario):
    scenario["time.end"] = "1 ms"
    table = scenario.batch(["path.speed", "belts.lap.slack"], np.tile([[300.0, 0.5]], (2000, 1)))
    assert len(table["index"]) == 2000 and len(set(table["head.peak"])) == 1
    bad = scenario.batch(["path.speed"], [[float("nan")], ["fast"], [None], [300.0], [[1, 2]]])
    assert bad["status"] == ["refused"] * 3 + ["completed", "refused"] and all(bad["reason"][:3])
    assert np.isnan(bad["head.peak"][:3]).all() and np.isfinite(bad["head.peak"][3])
    for odd in ("nothing.here", "a[", "", "*", "path.speed=1", "🙂"):
        refused = scenario.batch([odd], [[1.0]])
        assert refused["status"] == ["refused"] and refused["reason"][0], odd
