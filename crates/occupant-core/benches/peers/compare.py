"""Times MuJoCo, Pinocchio and occupant on the same skeleton, after checking that all three move it alike.

    python -m venv peers && peers/bin/pip install mujoco pin numpy
    cargo build --release --package occupant-core --examples
    peers/bin/python crates/occupant-core/benches/peers/compare.py target/release/examples

What can be compared with what stands in README.md beside this file.
"""

import json
import subprocess
import sys
import time
from pathlib import Path

import mujoco
import numpy as np
import pinocchio as pin

# Largest difference of accelerations, as a fraction of the largest acceleration, before any time is printed.
AGREEMENT = 1e-9
# Processes of ours and batches of the engines taken in turn.
ROUNDS = 8
CALLS = 200
FACE_HALF_THICKNESS = 0.05
ONE_BODY = "Pinocchio aba of one free body"


def rotation(quaternion):
    """Matrix of a quaternion w, x, y, z; columns are the turned axes in space."""
    matrix = np.zeros(9)
    mujoco.mju_quat2Mat(matrix, np.asarray(quaternion) / np.linalg.norm(quaternion))
    return matrix.reshape(3, 3)


def text(values):
    return " ".join(repr(float(v)) for v in values)


class Motion:
    """State and accelerations of ours in the coordinates of a tree of relative joints."""

    def __init__(self, numbers):
        state, ours = numbers["state"], numbers["accelerations"]
        self.slot = {n: i for i, n in enumerate(numbers["free"])}
        self.hinge_slot = {n: i for i, n in enumerate(numbers["hinged"])}
        self.turn = {n: rotation(state["orientation"][i]) for n, i in self.slot.items()}
        self.omega = {n: np.array(state["omega"][i]) for n, i in self.slot.items()}
        self.alpha = {n: np.array(ours["alpha"][i]) for n, i in self.slot.items()}
        self.place, self.velocity = np.array(state["t1"]), np.array(state["velocity"])
        self.acceleration = np.array(ours["t1"])
        self.state, self.ours = state, ours

    def root(self):
        """Rotation, angular velocity and angular acceleration in the root's own axes."""
        turn = self.turn[0]
        return turn, turn.T @ self.omega[0], turn.T @ self.alpha[0]

    def ball(self, n, parent):
        """The same of a ball joint, relative to the parent, in the child's axes."""
        turn, w, w_parent = self.turn[n], self.omega[n], self.omega[parent]
        # d/dt of Rᵀ(ω − ω_p) is Rᵀ(α − α_p + ω × ω_p)
        rate = self.alpha[n] - self.alpha[parent] + np.cross(w, w_parent)
        return self.turn[parent].T @ turn, turn.T @ (w - w_parent), turn.T @ rate

    def hinge(self, n):
        i = self.hinge_slot[n]
        return self.state["hinge"][i], self.state["hinge_rate"][i], self.ours["hinge"][i]


def quaternion(matrix):
    """Quaternion w, x, y, z of a rotation."""
    out = np.zeros(4)
    mujoco.mju_mat2Quat(out, np.ascontiguousarray(matrix).flatten())
    return out


# --- MuJoCo ---------------------------------------------------------------------------------------------------------


def mjcf(numbers, contact, damping):
    """The model as MJCF; depth first, which is MuJoCo's order of coordinates too."""

    def body(n):
        b = numbers["bodies"][n]
        joint = f'<joint type="ball" damping="{damping}"/>'
        if b["parent"] is None:
            joint = "<freejoint/>"
        elif b["hinge"]:
            joint = f'<joint type="hinge" axis="0 1 0" damping="{damping}"/>'
        inertial = f'<inertial pos="0 0 {b["cg"]!r}" mass="{b["mass"]!r}" diaginertia="{text(b["inertia"])}"/>'
        spheres = "".join(
            f'<geom type="sphere" size="{s["radius"]!r}" pos="{text(s["place"])}" contype="1" conaffinity="0"/>'
            for s in numbers["spheres"]
            if contact and s["body"] == n
        )
        children = "".join(body(c) for c, other in enumerate(numbers["bodies"]) if other["parent"] == n)
        return f'<body name="{n}" pos="{text(b["place"])}">{joint}{inertial}{spheres}{children}</body>'

    def box(face):
        u, v, normal = (np.array(axis) for axis in face["axes"])
        behind = np.array(face["centre"]) - FACE_HALF_THICKNESS * normal
        return (
            f'<geom type="box" size="{text(face["half"])} {FACE_HALF_THICKNESS}" pos="{text(behind)}" '
            f'quat="{text(quaternion(np.column_stack([u, v, normal])))}" contype="0" conaffinity="1"/>'
        )

    boxes = "".join(box(f) for f in numbers["faces"]) if contact else ""
    return (
        '<mujoco><compiler angle="radian" inertiafromgeom="false"/>'
        f'<option gravity="0 0 {-numbers["gravity"]!r}" timestep="0.0001"/>'
        f"<worldbody>{boxes}{body(0)}</worldbody></mujoco>"
    )


def with_mujoco(numbers, contact=False, damping=0.0):
    """Model, data at the state, and the accelerations that ours would be in its coordinates."""
    model = mujoco.MjModel.from_xml_string(mjcf(numbers, contact, damping))
    data = mujoco.MjData(model)
    motion, expected = Motion(numbers), np.zeros(model.nv)
    for n, b in enumerate(numbers["bodies"]):
        joint = model.body(str(n)).jntadr[0]
        q, v = model.jnt_qposadr[joint], model.jnt_dofadr[joint]
        if b["parent"] is None:
            turn, rate, alpha = motion.root()
            data.qpos[q : q + 7] = [*motion.place, *quaternion(turn)]
            data.qvel[v : v + 6] = [*motion.velocity, *rate]
            expected[v : v + 6] = [*motion.acceleration, *alpha]
        elif b["hinge"]:
            data.qpos[q], data.qvel[v], expected[v] = motion.hinge(n)
        else:
            turn, rate, alpha = motion.ball(n, b["parent"])
            data.qpos[q : q + 4], data.qvel[v : v + 3], expected[v : v + 3] = quaternion(turn), rate, alpha
    return model, data, expected


# --- Pinocchio ------------------------------------------------------------------------------------------------------


def with_pinocchio(numbers):
    """Model, data, q, v and the accelerations that ours would be in its coordinates."""
    model, ids = pin.Model(), {}
    model.gravity.linear = np.array([0.0, 0.0, -numbers["gravity"]])
    order = [0, 1, 2, 4, 6, 5, 7, 3, 8, 10, 9, 11]  # every parent before its children
    for n in order:
        b = numbers["bodies"][n]
        if b["parent"] is None:
            kind, parent = pin.JointModelFreeFlyer(), 0
        else:
            kind = pin.JointModelRY() if b["hinge"] else pin.JointModelSpherical()
            parent = ids[b["parent"]]
        ids[n] = model.addJoint(parent, kind, pin.SE3(np.eye(3), np.array(b["place"])), str(n))
        inertia = pin.Inertia(b["mass"], np.array([0.0, 0.0, b["cg"]]), np.diag(b["inertia"]))
        model.appendBodyToJoint(ids[n], inertia, pin.SE3.Identity())
    motion = Motion(numbers)
    q, v, expected = pin.neutral(model), np.zeros(model.nv), np.zeros(model.nv)
    xyzw = lambda turn: np.roll(quaternion(turn), -1)
    for n in order:
        joint = model.joints[ids[n]]
        i, k = joint.idx_q, joint.idx_v
        if n == 0:
            turn, rate, alpha = motion.root()
            velocity = turn.T @ motion.velocity
            q[i : i + 7] = [*motion.place, *xyzw(turn)]
            v[k : k + 6] = [*velocity, *rate]
            # d/dt of Rᵀv
            expected[k : k + 6] = [*(turn.T @ motion.acceleration - np.cross(rate, velocity)), *alpha]
        elif numbers["bodies"][n]["hinge"]:
            q[i], v[k], expected[k] = motion.hinge(n)
        else:
            turn, rate, alpha = motion.ball(n, numbers["bodies"][n]["parent"])
            q[i : i + 4], v[k : k + 3], expected[k : k + 3] = xyzw(turn), rate, alpha
    return model, model.createData(), q, v, expected


# --- times ----------------------------------------------------------------------------------------------------------


def one_free_body():
    """A model of a single body: what a call through Python costs with next to nothing to compute."""
    model = pin.Model()
    joint = model.addJoint(0, pin.JointModelFreeFlyer(), pin.SE3.Identity(), "body")
    model.appendBodyToJoint(joint, pin.Inertia.Random(), pin.SE3.Identity())
    return model, model.createData(), pin.neutral(model), np.zeros(6), np.zeros(6)


def sample_ns(call, calls=CALLS):
    start = time.perf_counter_ns()
    for _ in range(calls):
        call()
    return (time.perf_counter_ns() - start) / calls


def median_ns(call):
    return float(np.median([sample_ns(call) for _ in range(5)]))


def ours_ns(folder):
    """One process of our timing example: name → ns."""
    lines = subprocess.check_output([Path(folder) / "speed"], text=True).splitlines()
    return {name: float(value) for name, value in (line.split() for line in lines)}


def check(name, found, expected):
    error = np.abs(found - expected).max() / np.abs(expected).max()
    print(f"{name}: accelerations differ from ours by {error:.1e} of the largest")
    if not error < AGREEMENT:
        sys.exit(f"{name} does not move the body as we do (limit {AGREEMENT:.0e}): no time is printed")


def main(folder):
    numbers = json.loads(subprocess.check_output([Path(folder) / "peer_model"]))
    bare, bare_data, expected = with_mujoco(numbers)
    mujoco.mj_forward(bare, bare_data)
    check("MuJoCo", bare_data.qacc, expected)
    model, data, q, v, pin_expected = with_pinocchio(numbers)
    tau = np.zeros(model.nv)
    check("Pinocchio", pin.aba(model, data, q, v, tau), pin_expected)

    damped, damped_data, _ = with_mujoco(numbers, damping=1.0)
    touching, touching_data, _ = with_mujoco(numbers, contact=True, damping=1.0)
    mujoco.mj_forward(touching, touching_data)
    single = one_free_body()
    calls = {
        "MuJoCo mj_forward, contact": lambda: mujoco.mj_forward(touching, touching_data),
        "MuJoCo mj_forward, no contact": lambda: mujoco.mj_forward(damped, damped_data),
        "MuJoCo mj_forward, bare": lambda: mujoco.mj_forward(bare, bare_data),
        "Pinocchio aba": lambda: pin.aba(model, data, q, v, tau),
        ONE_BODY: lambda: pin.aba(*single),
    }
    best, ours = dict.fromkeys(calls, np.inf), {}
    for _ in range(ROUNDS):
        for name, call in calls.items():
            best[name] = min([best[name]] + [median_ns(call) for _ in range(20)])
        for name, value in ours_ns(folder).items():
            ours[name] = min(ours.get(name, np.inf), value)
    print(f"contacts: MuJoCo {touching_data.ncon}, ours {ours['touches']:.0f} of {ours['pairs']:.0f} pairs")
    print(f"{ONE_BODY}: {best[ONE_BODY]:.0f} ns, taken off below: mostly the way through Python")
    best["Pinocchio aba"] -= best[ONE_BODY]
    full = 0.25 * ours["full_commit"] + 0.75 * ours["full"]  # an rk4 step commits once in four evaluations
    rows = [
        ("full", "MuJoCo mj_forward, contact", full),
        ("joints and belts", "MuJoCo mj_forward, no contact", ours["held"]),
        ("bare", "MuJoCo mj_forward, bare", ours["bare"]),
        ("bare", "Pinocchio aba", ours["bare"]),
    ]
    for label, name, own in rows:
        print(f"{name:32} {best[name]:9.0f} ns   ours, {label:17} {own:7.0f} ns   ratio {best[name] / own:5.1f}")
    print("ours: " + ", ".join(f"{name} {value:.1f}" for name, value in ours.items()))


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
