"""Runs a second: our sweep against MuJoCo's batched rollout of the same occupant in the same crash, two threads each.

    python -m venv peers && peers/bin/pip install mujoco numpy
    cargo build --release --package occupant-bench --examples && cargo build --release --package occupant-cli
    peers/bin/python crates/occupant-bench/peers/rollout.py target/release [--threads 2]

Events of 0.25 s, RK4 at 0.1 ms, no time histories. What can be compared with what stands in README.md beside this file;
here in addition: MuJoCo varies the speed of the start and keeps the model, our sweep varies a stiffness, so that every
run also reads, checks and seats its own scenario, takes all measures and writes its row to the disk. MuJoCo's states are
returned to memory. Times are processor time of the whole process, divided by the threads, so that other work on the
machine counts little; ours includes the start of the program.
"""

import argparse
import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import mujoco
import numpy as np
from mujoco import rollout

from engines import Peer, check_belts, check_mujoco

HERE = Path(__file__).parent
SCENARIO, INSTANT = HERE.parent / "car.toml", 0.09
ROUNDS = 3
BATCH = 8
# Samples of study.toml.
RUNS = 64


def ours_s(program, threads):
    """Processor time of one sweep of study.toml, s."""
    with tempfile.TemporaryDirectory() as folder:
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        command = [program, "sweep", HERE / "study.toml", "--output", Path(folder) / "out", "--threads", str(threads)]
        subprocess.run([*command, "--quiet"], check=True, stdout=subprocess.DEVNULL)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


class Batch:
    """`BATCH` events of MuJoCo side by side, in the vehicle's frame (compare.py says why)."""

    def __init__(self, peer, threads):
        self.model, data = peer.mujoco("contact", "start")
        self.vehicle = peer.motion["vehicle"]["acceleration"]
        self.gravity = np.array([0.0, 0.0, -peer.motion["gravity"]])
        kind = mujoco.mjtState.mjSTATE_FULLPHYSICS
        start = np.zeros(mujoco.mj_stateSize(self.model, kind))
        mujoco.mj_getState(self.model, data, start, kind)
        self.start = np.tile(start, (BATCH, 1))
        first_speed = 1 + self.model.nq
        self.start[:, first_speed] += 0.01 * np.arange(BATCH)
        self.data = [mujoco.MjData(self.model) for _ in range(threads)]
        self.pool = rollout.Rollout(nthread=threads)

    def seconds(self):
        """Processor time, s."""
        state, clock = self.start, time.process_time()
        for acceleration in self.vehicle:
            self.model.opt.gravity[:] = self.gravity - acceleration
            states, _ = self.pool.rollout(self.model, self.data, state, nstep=10)
            state = np.ascontiguousarray(states[:, -1])
        seconds = time.process_time() - clock
        if not np.isfinite(state).all():
            sys.exit("MuJoCo's events broke down: no time is printed")
        return seconds


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("release", type=Path, help="folder of the built programs, e.g. target/release")
    parser.add_argument("--threads", type=int, default=2)
    arguments = parser.parse_args()
    threads = arguments.threads
    program = (arguments.release / "occupant").resolve()
    peer = Peer(arguments.release / "examples", SCENARIO, INSTANT)
    check_mujoco(peer)
    check_belts(peer)
    batch = Batch(peer, threads)
    ours, theirs = np.inf, np.inf
    for _ in range(ROUNDS):
        ours = min(ours, ours_s(program, threads) / RUNS)
        theirs = min(theirs, batch.seconds() / BATCH)
    print(f"processors here: {os.cpu_count()}, threads: {threads}")
    for name, seconds in ((f"MuJoCo {mujoco.__version__} rollout", theirs), ("occupant sweep", ours)):
        print(f"{name:22} {1e3 * seconds:8.2f} ms of processor time a run, {threads / seconds:7.1f} runs/s on {threads} threads")
    print(f"ratio {theirs / ours:.1f}")


if __name__ == "__main__":
    main()
