"""The module as a user calls it, and against the command where that is built."""

import threading
from pathlib import Path

import numpy as np
import pytest

import occupant

ROOT = Path(__file__).resolve().parents[3]
CART = ROOT / "scenarios" / "cart-lap-torso.toml"


@pytest.fixture
def scenario():
    return occupant.Scenario(CART)


@pytest.fixture(scope="module")
def run():
    scenario = occupant.Scenario(CART)
    scenario["time.end"] = "60 ms"
    return scenario.run()


def test_the_version_is_that_of_the_package():
    version = next(line for line in (ROOT / "Cargo.toml").read_text().splitlines() if line.startswith("version"))
    assert occupant.__version__ == version.split('"')[1]


def test_a_run_has_arrays_in_si_units(run):
    assert run.status == "completed"
    head = run["head.acceleration.resultant"]
    assert head.dtype == np.float64 and head.shape == run.time.shape
    assert run.time[0] == 0.0 and abs(run.time[-1] - 0.06) < 1e-12
    peak_g = run.summary["accelerations"]["head"]["peak_g"]
    # steps see more than outputs every 1 ms: 69.17 g for 65.85 g
    assert 0.9 * peak_g < head.max() / 9.80665 <= peak_g
    assert run.measures["hic15"] > 0
    both = run.series_of("head.acceleration.*", "belt.lap.force")
    assert set(both) >= {"head.acceleration.x", "head.acceleration.resultant", "belt.lap.force"}
    assert np.array_equal(both["head.acceleration.resultant"], head)
    assert {c["unit"] for c in run.channels("belt.*.force")} == {"N"}


def test_a_channel_that_is_not_there_is_a_key_error(run):
    with pytest.raises(KeyError, match="head.acceleration.x"):
        run["head.acceleration.w"]


def test_a_dict_is_a_scenario():
    free_fall = {
        "title": "Free fall",
        "time": {"end": 0.1},
        "path": {"kind": "fixed"},
        "body": {"preset": "male50"},
        "joints": {"preset": "male50"},
        "initial_state": {"q": [0, 0, 2] + [0] * 28, "rates": np.zeros(31)},
    }
    free_fall["initial_state"]["rates"] = free_fall["initial_state"]["rates"].tolist()
    scenario = occupant.Scenario(free_fall)
    # an accelerometer reads nothing in free fall
    assert np.abs(scenario.run()["head.acceleration.resultant"]).max() < 1e-9
    again = occupant.Scenario.from_text(scenario.to_toml())
    assert again.run().time.shape == scenario.run().time.shape


def test_values_are_set_and_taken_away():
    scenario = occupant.Scenario(CART)
    scenario["time.end"] = 0.02
    whole = scenario.copy()
    del scenario["belts.torso"]
    scenario["title"] = "1.5"
    scenario["belts.lap.slack"] = np.float64(0.5)
    left = scenario.run()
    assert left.summary["title"] == "1.5"
    assert not left.channels("belt.torso.*") and whole.run().channels("belt.torso.*")


def test_what_is_wrong_is_told_with_its_place():
    scenario = occupant.Scenario(CART)
    scenario["path.speed"] = "20 lbf"
    with pytest.raises(occupant.OccupantError, match="path.speed") as raised:
        scenario.run()
    [problem] = [p for p in raised.value.problems if p["severity"] == "error"]
    assert problem["path"] == "path.speed" and "lbf" in problem["found"] and "speed" in problem["found"]
    with pytest.raises(occupant.OccupantError, match="line|toml|:1"):
        occupant.Scenario.from_text("title = ")
    with pytest.raises(FileNotFoundError):
        occupant.Scenario("none.toml")
    with pytest.raises(occupant.OccupantError, match="yaml"):
        occupant.Scenario.from_text("", format="yaml")


def test_a_study_is_a_table(tmp_path):
    (tmp_path / "base.toml").write_text(CART.read_text())
    study = tmp_path / "study.toml"
    study.write_text(
        'base = "base.toml"\nset = { "time.end" = "30 ms" }\ndesign.kind = "full_factorial"\n'
        '[[parameters]]\nname = "speed"\npath = "path.speed"\nlist = ["10 mph", "20 mph", "30 mph"]\n'
    )
    study = occupant.Study(study)
    tables = [study.run(threads=threads) for threads in (1, 2)]
    assert len(study) == 3 and list(tables[0]["index"]) == [0, 1, 2]
    for name in tables[0]:
        if name != "wall_time_s":
            np.testing.assert_array_equal(tables[0][name], tables[1][name], name)
    assert tables[0]["status"] == ["completed"] * 3 and tables[0]["reason"] == [None] * 3
    np.testing.assert_allclose(tables[0]["input.speed"], 0.44704 * np.array([10, 20, 30]), rtol=1e-15)
    alone = study.scenario(1).run()
    assert tables[0]["hic15"][1] == alone.measures["hic15"]
    with pytest.raises(IndexError):
        study.scenario(3)


def test_a_batch_is_a_table_of_runs():
    scenario = occupant.Scenario(CART)
    scenario["time.end"] = "30 ms"
    matrix = np.array([[0.5 * i, 300.0 + 10 * i] for i in range(5)])
    paths = ["belts.lap.slack", "path.speed"]
    tables = [scenario.batch(paths, matrix, threads=threads) for threads in (1, 2)]
    for name in tables[0]:
        if name != "wall_time_s":
            np.testing.assert_array_equal(tables[0][name], tables[1][name], name)
    assert tables[0]["status"] == ["completed"] * 5 and np.array_equal(tables[0]["input.path.speed"], matrix[:, 1])
    for row in range(5):
        alone = scenario.copy()
        for path, value in zip(paths, matrix[row]):
            alone[path] = value
        assert tables[0]["hic15"][row] == alone.run().measures["hic15"]
    texts = scenario.batch(["path.speed"], [["10 mph"], ["10 lbf"]])
    assert texts["input.path.speed"] == ["10 mph", "10 lbf"] and texts["status"] == ["completed", "refused"]
    assert texts["reason"][0] is None and "speed" in texts["reason"][1]
    assert np.isnan(texts["hic15"][1]) and texts["hic15"][0] > 0
    belted = scenario.batch(["belts.torso"], [[None], [scenario["belts.torso"]]])
    del scenario["belts.torso"]
    assert np.isnan(belted["belts.torso.peak"][0]) and belted["belts.torso.peak"][1] > 0
    assert belted["hic15"][0] == scenario.run().measures["hic15"]
    assert len(scenario.batch(["path.speed"], [])["index"]) == 0
    with pytest.raises(occupant.OccupantError, match="2 values for 1"):
        scenario.batch(["path.speed"], [[1.0, 2.0]])
    with pytest.raises(occupant.OccupantError, match="path.speed.* twice"):
        scenario.batch(["path.speed", "path.speed"], [[1.0, 2.0]])
    for no_matrix in (3.0, np.zeros(2)):
        with pytest.raises(TypeError):
            scenario.batch(["path.speed"], no_matrix)


def test_runs_leave_other_threads_alone():
    scenario = occupant.Scenario(CART)
    results = {}
    threads = [threading.Thread(target=lambda i=i: results.__setitem__(i, scenario.run())) for i in range(3)]
    [thread.start() for thread in threads]
    [thread.join() for thread in threads]
    heads = [results[i]["head.acceleration.resultant"] for i in range(3)]
    assert all(np.array_equal(heads[0], head) for head in heads)


def test_reads_values_by_path(scenario):
    scenario["path.speed"] = "25 mph"
    assert scenario["path.speed"] == "25 mph"
    assert len(scenario["joints.*.damping"]) > 3
    with pytest.raises(KeyError):
        scenario["paht.speed"]


def test_refuses_what_contains_itself_or_has_no_end(scenario):
    endless = {"title": "a"}
    endless["body"] = endless
    with pytest.raises(occupant.OccupantError, match="contains itself"):
        occupant.Scenario(endless)
    deep = []
    for _ in range(100_000):
        deep = [deep]
    with pytest.raises(occupant.OccupantError, match="nested"):
        occupant.Scenario({"title": deep})
    with pytest.raises(occupant.OccupantError, match="nested"):
        scenario["path.speed"] = deep


def test_a_live_run_is_told_frame_by_frame(scenario):
    scenario["time.end"] = "50 ms"
    live = scenario.live(velocity=[8.9, 0, 0])
    with pytest.raises(occupant.OccupantError, match="known only up to"):
        live.advance(0.01)
    saved = None
    while live.time < live.end - 1e-9:
        live.record()
        live.push(min(live.time + 1e-3, live.end), acceleration=[-150, 0, 0])
        live.advance()
        if saved is None and live.time > 0.02:
            saved = live.save()
            other = live.copy()
    live.record()
    assert live["vehicle.velocity.x"] == pytest.approx(8.9 - 150 * 0.05)
    assert live["belt.lap.force"] > 100
    assert live.summary()["reached_s"] == pytest.approx(0.05)
    with pytest.raises(KeyError):
        live["belt.lop.force"]
    at = live.time
    live.load(saved)
    assert live.time < at and live["head.position.x"] == other["head.position.x"]


def test_a_kick_moves_the_head(scenario):
    live = scenario.live()
    live.advance(0.001)
    before = live["head.velocity.y"]
    live.kick("head", [0, 10, 0])
    assert abs(live["head.velocity.y"] - before) > 0.05
    with pytest.raises(KeyError):
        live.kick("hed", [0, 10, 0])


def test_a_force_of_ones_own(scenario):
    scenario["time.end"] = "30 ms"
    plain = scenario.run()

    def magnet(t, places, velocities):
        way = np.subtract(places[1], places[0])
        pull = way * 500
        return [list(pull), list(-pull)]

    scenario.add_force("magnet", ["right_hand", ("vehicle", [0.35, -0.1, -0.1])], magnet)
    pulled = scenario.run()
    assert pulled["own_force.magnet.force"].max() > 50
    assert abs(pulled["sphere.right_hand.position.x"][-1] - plain["sphere.right_hand.position.x"][-1]) > 1e-3
    wrong = occupant.Scenario(CART)
    wrong["time.end"] = "10 ms"
    wrong.add_force("broken", ["head"], lambda t, places, velocities: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        wrong.run()
    lost = occupant.Scenario(CART)
    lost.add_force("lost", ["hed"], magnet)
    with pytest.raises(occupant.OccupantError, match="hed"):
        lost.run()
