"""A run as a recording of Rerun, read back with Rerun's own reader."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("rerun.chunk", reason="the package rerun-sdk is not here")
pytest.importorskip("mcap_protobuf", reason="the package mcap-protobuf-support is not here")

ROOT = Path(__file__).resolve().parents[3]
SCRIPT = Path(__file__).resolve().parents[1] / "python" / "occupant" / "to_rerun.py"
COMMAND = os.environ.get("OCCUPANT") or shutil.which("occupant", path=f"{ROOT}/target/release:{os.environ['PATH']}")


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    if not COMMAND:
        pytest.skip("the command occupant is not here: build it, or say where it is in OCCUPANT")
    file = tmp_path_factory.mktemp("run") / "run.mcap"
    scenario = ROOT / "scenarios" / "cart-lap-torso.toml"
    subprocess.run([COMMAND, "run", scenario, "-q", "--set", "time.end=40 ms", "-o", file], check=True)
    return file


def columns(recording):
    """Each column of each entity over the file, row by row."""
    from rerun.chunk import RrdReader

    found = {}
    for chunk in RrdReader(str(recording)).stream():
        batch = chunk.to_record_batch()
        own = [(n, c) for n, c in zip(batch.schema.names, batch.columns) if ":" in n]
        for name, column in own:
            found.setdefault((chunk.entity_path, name), []).extend(column.to_pylist())
    return found


def test_the_recording_holds_the_scene(run):
    from mcap_protobuf.reader import read_protobuf_messages

    subprocess.run([sys.executable, SCRIPT, run], check=True)
    read = columns(run.with_suffix(".rrd"))
    frames = [m.proto_msg for m in read_protobuf_messages(str(run), topics=["/tf"])]
    places = read["/space/vehicle/occupant_head", "Transform3D:translation"]
    assert len(places) == len(frames) > 10
    for place, frame in zip(places, frames):
        head = next(t.translation for t in frame.transforms if t.child_frame_id == "occupant/head")
        assert place[0] == pytest.approx([head.x, head.y, head.z], abs=1e-6)
    body = next(read_protobuf_messages(str(run), topics=["/scene/body"])).proto_msg.entities
    of_head = next(e for e in body if e.id == "head")
    halves = read["/space/vehicle/occupant_head/body/head/spheres", "Ellipsoids3D:half_sizes"][0]
    assert halves[0] == pytest.approx([0.5 * getattr(of_head.spheres[0].size, axis) for axis in "xyz"], abs=1e-6)
    assert len(halves) == len(of_head.spheres)
    # every belt at every frame, every surface
    belts = read["/space/vehicle/belts/torso/lines", "LineStrips3D:strips"]
    assert len(belts) == len(frames) and len(belts[0][0]) > 4
    assert any(path.startswith("/space/vehicle/compartment/windshield") for path, _ in read)


def test_what_is_there_is_not_replaced_and_other_files_are_refused(run, tmp_path):
    taken = tmp_path / "taken.rrd"
    taken.write_text("mine")
    answer = subprocess.run([sys.executable, SCRIPT, run, "-o", taken], capture_output=True, text=True)
    assert answer.returncode == 1 and "--force" in answer.stderr
    assert taken.read_text() == "mine"
    scenario = ROOT / "scenarios" / "cart-lap.toml"
    answer = subprocess.run([sys.executable, SCRIPT, scenario, "-o", tmp_path / "x.rrd"], capture_output=True, text=True)
    assert answer.returncode == 1 and answer.stderr.startswith("error: "), answer.stderr
