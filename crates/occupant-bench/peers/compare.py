"""Times MuJoCo, Pinocchio and occupant on the same skeleton, after checking that all move it alike.

    python -m venv peers && peers/bin/pip install mujoco pin numpy
    cargo build --release --package occupant-bench --examples
    peers/bin/python crates/occupant-bench/peers/compare.py target/release/examples [--write FILE.md ...]

aba.cpp, Pinocchio's aba without Python, is built if a C++ compiler and Eigen are there (apt-get install clang
libeigen3-dev; it takes minutes once). Times of the engines are processor time of the thread; ours and those of aba.cpp are
of batches shorter than a time slice. --write puts the table between the lines `<!-- peers:begin -->` and
`<!-- peers:end -->` of each file. What can be compared with what stands in README.md beside this file.
"""

import argparse
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import mujoco
import numpy as np
import pinocchio as pin

from engines import Peer, check_acceleration, check_belts, check_mujoco, pinocchio_model

HERE = Path(__file__).parent
SCENARIO, INSTANT = HERE.parent / "car.toml", 0.09
# Processes of ours and batches of the engines taken in turn.
ROUNDS = 5
CALLS = 20
EVENTS = 3
STEP = 1e-4
ONE_BODY = "Pinocchio aba of one free body"
# Pinocchio's joints are more than Boost's lists hold by default.
BOOST = ["-DBOOST_MPL_CFG_NO_PREPROCESSED_HEADERS", "-DBOOST_MPL_LIMIT_LIST_SIZE=30", "-DBOOST_MPL_LIMIT_VECTOR_SIZE=30"]
MARKERS = ("<!-- peers:begin -->", "<!-- peers:end -->")


def one_free_body():
    """A model of a single body: what a call through Python costs with next to nothing to compute."""
    model = pin.Model()
    joint = model.addJoint(0, pin.JointModelFreeFlyer(), pin.SE3.Identity(), "body")
    model.appendBodyToJoint(joint, pin.Inertia.Random(), pin.SE3.Identity())
    return model, model.createData(), pin.neutral(model), np.zeros(6), np.zeros(6)


def sample_ns(call):
    start = time.thread_time_ns()
    for _ in range(CALLS):
        call()
    return (time.thread_time_ns() - start) / CALLS


def median_ns(call):
    return float(np.median([sample_ns(call) for _ in range(5)]))


def ours_ns(examples):
    """One process of our timing example: name → ns."""
    lines = subprocess.check_output([examples / "speed"], text=True).splitlines()
    return {name: float(value) for name, value in (line.split() for line in lines)}


class Stepper:
    """Steps of MuJoCo from one state, so that every batch does the same work."""

    def __init__(self, peer, parts):
        self.model, self.data = peer.mujoco(parts, "then")
        self.key = self.model.key("then").id

    def ns(self, steps=5):
        mujoco.mj_resetDataKeyframe(self.model, self.data, self.key)
        start = time.thread_time_ns()
        mujoco.mj_step(self.model, self.data, nstep=steps)
        return (time.thread_time_ns() - start) / steps


def event_ms(peer, model, data):
    """Times of the pieces of one event, ms: the occupant from its seat on, in the vehicle's frame.

    The vehicle only slows down, so its frame is space with another gravity, which changes every millisecond.
    """
    vehicle = peer.motion["vehicle"]
    if vehicle["greatest_turn"] > 0:
        sys.exit("the vehicle turns: MuJoCo's event in its frame would be another")
    gravity = np.array([0.0, 0.0, -peer.motion["gravity"]])
    mujoco.mj_resetDataKeyframe(model, data, model.key("start").id)
    pieces = []
    for acceleration in vehicle["acceleration"]:
        model.opt.gravity[:] = gravity - acceleration
        start = time.thread_time_ns()
        mujoco.mj_step(model, data, nstep=round(1e-3 / STEP))
        pieces.append((time.thread_time_ns() - start) / 1e6)
    return np.array(pieces)


def compiled_aba(compiler):
    """The program that times aba.cpp built with `compiler`, kept in the virtual environment; None with the reason said."""
    program = Path(sys.prefix) / f"aba-{pin.__version__}-{compiler}"
    if program.exists():
        return program
    if shutil.which(compiler) is None:
        print(f"{compiler} is not installed: aba compiled with it is left out")
        return None
    prefix = Path(pin.__file__).parents[4] / "include"
    eigen = [p for p in (prefix / "eigen3", Path("/usr/include/eigen3")) if p.is_dir()]
    if not eigen:
        print("Eigen's headers are not installed (libeigen3-dev): aba in C++ is left out")
        return None
    flags = ["-O3", "-DNDEBUG", "-std=c++17", "-w", *BOOST, f"-isystem{prefix}", f"-isystem{eigen[0]}"]
    built = subprocess.run([compiler, *flags, HERE / "aba.cpp", "-o", program], capture_output=True, text=True)
    if built.returncode != 0:
        print(f"aba.cpp cannot be built with {compiler}, left out: {built.stderr.strip()[:400]}")
        return None
    return program


def plain(motion):
    """The body, its state and our accelerations, in the order in which aba.cpp reads them."""
    _, _, q, v, acceleration = pinocchio_model(pin, motion)
    words = [len(motion["bodies"]), motion["gravity"]]
    for b in motion["bodies"]:
        parent = -1 if b["parent"] is None else b["parent"]
        words += [parent, int(b["hinge"]), *b["place"], b["mass"], b["cg"], *b["inertia"]]
    return " ".join(repr(w) if isinstance(w, int) else repr(float(w)) for w in [*words, *q, *v, *acceleration])


def aba_ns(program, numbers, name):
    error, ns = map(float, subprocess.check_output([program, numbers], text=True).split())
    if not error < 1e-9:
        sys.exit(f"{name} does not accelerate the body as we do: {error:.1e}; no time is printed")
    return ns


def measure(peer, arguments, folder):
    """Least time of everything, ns (events ms), all taken in turn: theirs and ours by name."""
    model, data, q, v, _ = pinocchio_model(pin, peer.motion)
    tau, single = np.zeros(model.nv), one_free_body()
    forward = {parts: peer.mujoco(parts, "then") for parts in ("free", "held", "contact")}
    calls = {f"mj_forward, {parts}": lambda m=m: mujoco.mj_forward(*m) for parts, m in forward.items()}
    calls["aba, wheel"] = lambda: pin.aba(model, data, q, v, tau)
    calls[ONE_BODY] = lambda: pin.aba(*single)
    steppers = {f"mj_step, {parts}": Stepper(peer, parts) for parts in ("free", "held", "contact")}
    compilers = {name: compiled_aba(name) for name in arguments.compiler}
    numbers = folder / "body.txt"
    numbers.write_text(plain(peer.motion))
    crash = peer.mujoco("contact", "start")
    theirs, ours, event = {}, {}, np.inf

    def keep(best, name, value):
        best[name] = min(best.get(name, np.inf), value)

    for turn in range(ROUNDS):
        for name, call in calls.items():
            keep(theirs, name, min(median_ns(call) for _ in range(60)))
        for name, stepper in steppers.items():
            keep(theirs, name, min(stepper.ns() for _ in range(100)))
        for name, program in compilers.items():
            if program:
                keep(theirs, f"aba, {name}", aba_ns(program, numbers, name))
        if turn < EVENTS:
            event = np.minimum(event, event_ms(peer, *crash))
        for name, value in ours_ns(arguments.examples).items():
            keep(ours, name, value)
    theirs["event"] = float(event.sum())
    theirs["aba, wheel"] -= theirs.pop(ONE_BODY)
    contacts = forward["contact"][1].ncon
    print(f"contacts: MuJoCo {contacts}, ours {ours['touches']:.0f} of {ours['pairs']:.0f} pairs")
    return theirs, ours


def table(theirs, ours):
    """The lines of the table."""
    mj, pi = f"MuJoCo {mujoco.__version__}", f"Pinocchio {pin.__version__}"
    full = 0.25 * ours["full_commit"] + 0.75 * ours["full"]  # an rk4 step commits once in four evaluations
    rows = [
        ("evaluation, full: joints, belts, contacts", full, f"{mj} `mj_forward` with contact", "mj_forward, contact"),
        ("evaluation, joints and belts", ours["held"], f"{mj} `mj_forward`, dampers, springs, tendons", "mj_forward, held"),
        ("evaluation, skeleton alone", ours["bare"], f"{mj} `mj_forward`", "mj_forward, free"),
        ("the same", ours["bare"], f"{pi} `aba`, C++ built with clang", "aba, clang++"),
        ("the same", ours["bare"], f"{pi} `aba`, C++ built with gcc", "aba, g++"),
        ("the same", ours["bare"], f"{pi} `aba`, wheel, cost of the call taken off", "aba, wheel"),
        ("rk4 step, full", ours["step"], f"{mj} RK4 step with contact", "mj_step, contact"),
        ("rk4 step, joints and belts", ours["held_step"], f"{mj} RK4 step, dampers, springs, tendons", "mj_step, held"),
        ("rk4 step, skeleton alone", ours["bare_step"], f"{mj} RK4 step", "mj_step, free"),
        ("event, 0.25 s at 0.1 ms", ours["event_ms"], f"{mj} RK4 with contact, the same crash", "event"),
    ]
    lines = ["| | ours | the same skeleton elsewhere | theirs | ratio |", "|---|---|---|---|---|"]
    for what, own, peer_name, key in rows:
        if key in theirs:
            unit, digits = ("ms", 1) if key == "event" else ("ns", 0)
            their = theirs[key]
            lines.append(
                f"| {what} | {own:,.{digits}f} {unit} | {peer_name} | {their:,.{digits}f} {unit} | {their / own:.1f} |"
            )
    return lines


def write(path, lines):
    """Puts the table between the markers of a file."""
    text = path.read_text()
    begin, end = MARKERS
    if text.count(begin) != 1 or text.count(end) != 1:
        sys.exit(f"{path} has no place for the table: it needs one line {begin} and one line {end}")
    before, rest = text.split(begin)
    path.write_text(before + begin + "\n" + "\n".join(lines) + "\n" + end + rest.split(end)[1])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("examples", type=Path)
    parser.add_argument("--compiler", nargs="*", default=["clang++"], help="for aba in C++ (default: clang++)")
    parser.add_argument("--write", type=Path, nargs="*", default=[])
    arguments = parser.parse_args()
    peer = Peer(arguments.examples, SCENARIO, INSTANT)
    check_mujoco(peer)
    check_belts(peer)
    model, data, q, v, expected = pinocchio_model(pin, peer.motion)
    check_acceleration("Pinocchio", pin.aba(model, data, q, v, np.zeros(model.nv)), expected)
    with tempfile.TemporaryDirectory() as folder:
        theirs, ours = measure(peer, arguments, Path(folder))
    lines = table(theirs, ours)
    print("\n".join(lines))
    print("ours: " + ", ".join(f"{name} {value:.1f}" for name, value in ours.items()))
    for path in arguments.write:
        write(path, lines)


if __name__ == "__main__":
    main()
