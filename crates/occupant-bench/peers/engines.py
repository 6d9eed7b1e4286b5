"""The occupant in MuJoCo and in Pinocchio, built from what `examples/peer` says, and the checks that it moves as ours does."""

import json
import subprocess
import sys
from pathlib import Path

import mujoco
import numpy as np

# Largest difference of accelerations, as a fraction of the largest acceleration.
SAME_ACCELERATION = 1e-9
# Largest difference of any segment's end over the motion, as a fraction of the body's size: the greatest distance of an end
# from the body's root at the start. MuJoCo's RK4 is of second order on orientations, so it runs finely here.
SAME_PLACE = 1e-6
FINE_STEP = 1e-5


class Peer:
    """What the example `peer` says of one instant of a scenario."""

    def __init__(self, examples, scenario, instant):
        self.command = [Path(examples) / "peer"]
        self.what = [str(scenario), str(instant)]
        self.motion = json.loads(self._ask("motion"))

    def _ask(self, kind, *more):
        return subprocess.check_output([*self.command, kind, *self.what, *more], text=True)

    def mujoco(self, parts, key):
        """MuJoCo's model of `parts` and its data at the keyframe `key`."""
        model = mujoco.MjModel.from_xml_string(self._ask("mjcf", parts))
        model.qpos_spring[:] = model.key("start").qpos
        return model, self.at(model, key)

    @staticmethod
    def at(model, key):
        """Data at a keyframe."""
        data = mujoco.MjData(model)
        mujoco.mj_resetDataKeyframe(model, data, model.key(key).id)
        return data


def ends(motion, model, data):
    """Both ends of every segment, in the order of our own."""
    found = []
    for n, body in enumerate(motion["bodies"], start=1):
        turn = data.xmat[n].reshape(3, 3)
        found += [data.xpos[n].copy(), data.xpos[n] + turn[:, 2] * body["far"]]
    return np.array(found)


def refuse(engine, what, error, limit):
    sys.exit(f"{engine} does not {what} the body as we do: {error:.1e}, limit {limit:.0e}; no time is printed")


def check_acceleration(name, found, expected):
    error = np.abs(found - expected).max() / np.abs(expected).max()
    print(f"{name}: accelerations differ from ours by {error:.1e} of the largest")
    if not error < SAME_ACCELERATION:
        refuse(name, "accelerate", error, SAME_ACCELERATION)


def check_mujoco(peer):
    """Accelerations of the free body, then its motion with the hinges' dampers, without contact."""
    motion = peer.motion
    model, data = peer.mujoco("free", "spun")
    mujoco.mj_forward(model, data)
    check_acceleration("MuJoCo", data.qacc, np.array(motion["acceleration"]))
    model, data = peer.mujoco("hinges", "spun")
    model.opt.timestep = FINE_STEP
    ours = np.array(motion["places"])
    between = round(motion["interval"] / FINE_STEP)
    size, worst = np.linalg.norm(ours[0] - ours[0][0], axis=1).max(), 0.0
    for i, place in enumerate(ours):
        if i > 0:
            mujoco.mj_step(model, data, nstep=between)
        mujoco.mj_kinematics(model, data)
        worst = max(worst, np.linalg.norm(ends(motion, model, data) - place, axis=1).max())
    span = (len(ours) - 1) * motion["interval"]
    print(f"MuJoCo: over {span:.2f} s the ends of all segments stay within {worst / size:.1e} of ours ({size:.2f} m = 1)")
    if not worst / size < SAME_PLACE:
        refuse("MuJoCo", "move", worst / size, SAME_PLACE)


def check_belts(peer):
    """At the start the tendons are as long as our belts, which have no slack there."""
    model, data = peer.mujoco("held", "start")
    mujoco.mj_forward(model, data)
    error = np.abs(data.ten_length - np.array(peer.motion["belts"])).max()
    print(f"MuJoCo: the tendons are as long as our belts to {error:.1e} m")
    if not error < 1e-6:
        refuse("MuJoCo", "belt", error, 1e-6)


def pinocchio_model(pin, motion):
    """Model, data, q, v of the same state, and our accelerations in its coordinates."""
    model, ids = pin.Model(), []
    model.gravity.linear = np.array([0.0, 0.0, -motion["gravity"]])
    for n, b in enumerate(motion["bodies"]):
        if b["parent"] is None:
            kind, parent = pin.JointModelFreeFlyer(), 0
        else:
            kind = pin.JointModelRY() if b["hinge"] else pin.JointModelSpherical()
            parent = ids[b["parent"]]
        ids.append(model.addJoint(parent, kind, pin.SE3(np.eye(3), np.array(b["place"])), str(n)))
        inertia = pin.Inertia(b["mass"], np.array([0.0, 0.0, b["cg"]]), np.diag(b["inertia"]))
        model.appendBodyToJoint(ids[n], inertia, pin.SE3.Identity())
    return model, model.createData(), *pinocchio_state(motion)


def pinocchio_state(motion):
    """q, v and accelerations: quaternions as x, y, z, w, the root's velocity in its own axes."""
    q, v, a = (np.array(motion[name]) for name in ("q", "v", "acceleration"))
    turn = np.zeros(9)
    mujoco.mju_quat2Mat(turn, q[3:7])
    turn = turn.reshape(3, 3)
    at = 3
    for b in motion["bodies"]:
        if b["hinge"]:
            at += 1
        else:
            q[at : at + 4] = np.roll(q[at : at + 4], -1)
            at += 4
    v[:3] = turn.T @ v[:3]
    # d/dt of Rᵀv
    a[:3] = turn.T @ a[:3] - np.cross(v[3:6], v[:3])
    return q, v, a
