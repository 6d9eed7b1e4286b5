#!/usr/bin/env python3
"""Rates of one state of a vehicle by a dense formulation: Kane's equations over ten accelerations (body 3 + 3, slides 4).

Shares nothing with the crate but the laws of the tyre and the numbers of the car. Writes reference_rate.json beside itself:

    python3 crates/vehicle-motion/tests/reference_rate.py
"""

import json
import math
import pathlib

import numpy as np

G = 9.80665
CAR = dict(M=1500.0, J=[550.0, 2300.0, 2500.0], h=0.55, a=1.1, b=1.6, T=1.52, mw=40.0, Iw=[1.0, 1.2], k=[22e3, 22e3],
           cj=1200.0, cr=1800.0, bar=[12e3, 4e3], rc=[0.05, 0.10], bump=[0.08, 0.09], ks=2e5, steer_per_m=0.3, camber_per_m=0.5,
           anti=[0.05, -0.08], brake=[0.35, 0.35, 0.15, 0.15], drive=[0.5, 0.5, 0.0, 0.0], drag=0.4)
TYRE = dict(r0=0.32, rho=0.1, kt=2e5, ct=150.0, rim=0.055, mu=0.8, sliding=0.875, vk=4.0, ca=12.0, F0=4000.0, q=1.8, ck=18.0,
            cg=1.0, loss=0.05, sigma=0.35, slow=2500.0, roll=0.012, zm=0.1)


def skew(v):
    return np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


def rotation(q):
    w, v = q[0], np.array(q[1:])
    return (w * w - v @ v) * np.eye(3) + 2 * np.outer(v, v) + 2 * w * skew(v)


def rates(state, steer, brake, drive, slope):
    """slope: rise to the right. Returns the rates of the first 33 numbers, and the loads."""
    c, t = CAR, TYRE
    y = np.array(state)
    R, v, om = rotation(y[3:7]), y[7:10], y[10:13]
    s, sd, spin, zx, zy = y[13:17], y[17:21], y[21:25], y[25:29], y[29:33]
    up = np.array([0.0, -slope, -1.0]) / math.hypot(slope, 1.0)
    N, gb, vb = R.T @ up, R.T @ np.array([0, 0, G]), R.T @ v
    L = c["a"] + c["b"]
    loads = [c["M"] * G * c["b"] / L / 2, c["M"] * G * c["a"] / L / 2]
    A, rhs = np.zeros((10, 10)), np.zeros(10)

    def particle(mass, jacobian, bias, force):
        A[:] += mass * jacobian.T @ jacobian
        rhs[:] += jacobian.T @ (force - mass * bias)

    J = np.diag(c["J"]).astype(float)
    rest, first, at_rest = c["M"] - 4 * c["mw"], np.zeros(3), []
    for i in range(4):
        side, e = (-1 if i % 2 == 0 else 1), i // 2
        centre = np.array([c["a"] if e == 0 else -c["b"], side * c["T"] / 2, c["h"] - t["r0"] + loads[e] / t["kt"]])
        u = np.array([c["anti"][e], side * c["rc"][e] / (c["T"] / 2), -1.0])
        u /= np.linalg.norm(u)
        at_rest.append((side, e, centre, u))
        first -= c["mw"] * centre
        J -= c["mw"] * (centre @ centre * np.eye(3) - np.outer(centre, centre))
        J[1, 1] -= c["Iw"][e]
    place = first / rest
    J -= rest * (place @ place * np.eye(3) - np.outer(place, place))
    jac = np.zeros((3, 10))
    jac[:, :3], jac[:, 3:6] = np.eye(3), -skew(place)
    particle(rest, jac, np.cross(om, np.cross(om, place)), rest * gb)
    A[3:6, 3:6] += J
    rhs[3:6] -= np.cross(om, J @ om)
    rhs[:3] -= c["drag"] * np.linalg.norm(vb) * vb
    out = np.zeros(33)
    found = []
    for i, (side, e, centre, u) in enumerate(at_rest):
        p = centre + u * s[i]
        toe, camber = steer - side * c["steer_per_m"] * s[i], side * c["camber_per_m"] * s[i]
        axis = np.array([-math.sin(toe), math.cos(toe) * math.cos(camber), math.cos(toe) * math.sin(camber)])
        other = s[i ^ 1]
        spring = -u[2] * (loads[e] - c["mw"] * G) + c["k"][e] * s[i] + c["bar"][e] * (s[i] - other)
        spring += (c["cj"] if sd[i] > 0 else c["cr"]) * sd[i]
        into, outof = max(0, s[i] - c["bump"][0]), max(0, -s[i] - c["bump"][1])
        spring += c["ks"] * (into * (1 + 10 * into) - outof * (1 + 10 * outof))
        rel = spin[i] + om @ axis
        sign = rel / math.hypot(rel, 0.5)
        Tb, Td = brake * c["brake"][i], drive * c["drive"][i]
        lean = N @ axis
        flat = N - lean * axis
        flat /= np.linalg.norm(flat)
        # lowest point of the circle of radius r0 - rho, then the crown
        clear = up @ (y[:3] + R @ p) - (t["r0"] - t["rho"]) * (N @ flat)
        depth = t["rho"] - clear
        F, arm, Fz = np.zeros(3), p, 0.0
        if depth > 0:
            arm = p - (t["r0"] - t["rho"]) * flat - (t["rho"] - depth) * N
            vp = vb + np.cross(om, arm) + u * sd[i]
            more = max(0.0, depth - t["rim"])
            Fz = max(0.0, t["kt"] * (depth + 9 * more) - t["ct"] * (N @ vp))
            ahead = np.cross(N, axis)
            ahead /= np.linalg.norm(ahead)
            right = np.cross(ahead, N)
            re, rl = t["r0"] - depth / 3, t["r0"] - depth
            Vr = rel * re
            Vs = np.array([ahead @ vp - Vr, right @ vp])
            zeta = np.array([zx[i], zy[i]])
            zd = (-Vs - (abs(Vr) + np.linalg.norm(Vs) / t["zm"]) * zeta) / t["sigma"]
            out[25 + i], out[29 + i] = zd
            cy = t["ca"] * t["F0"] * math.sin(2 * math.atan(Fz / (t["q"] * t["F0"]))) / math.sin(2 * math.atan(1 / t["q"]))
            C = np.array([t["ck"] * Fz, cy])
            sl = zeta / (1 - np.linalg.norm(zeta) / t["zm"]) - t["slow"] / (1 + (Vr / 2) ** 2) * Vs / C
            sl[1] -= t["cg"] * Fz * lean / cy
            mu = t["mu"] * (t["sliding"] + (1 - t["sliding"]) * math.exp(-np.linalg.norm(Vs) / t["vk"]))
            mu *= max(0.3, 1 - t["loss"] * (Fz / t["F0"] - 1))
            z = min(1.0, np.linalg.norm(C * sl) / (3 * mu * Fz))
            size = mu * Fz * (1 - (1 - z) ** 3)
            e_ = (C + (math.sqrt(C[0] * C[1]) - C) * z) * sl
            Fx, Fy = size * e_ / np.linalg.norm(e_)
            F = Fx * ahead + Fy * right + Fz * N
            Tb = min(Tb, 2 * mu * Fz * rl + 50)
            sdot = (Td - Tb * sign - Fx * re - t["roll"] * Fz * rl * sign) / c["Iw"][e]
        else:
            out[25 + i], out[29 + i] = -zx[i] / 0.05, -zy[i] / 0.05
            sdot = (Td - Tb * sign) / c["Iw"][e]
        out[21 + i] = sdot
        found.append(Fz)
        jac = np.zeros((3, 10))
        jac[:, :3], jac[:, 3:6], jac[:, 6 + i] = np.eye(3), -skew(p), u
        particle(c["mw"], jac, np.cross(om, np.cross(om, p)) + 2 * sd[i] * np.cross(om, u), c["mw"] * gb)
        jac[:, 3:6] = -skew(arm)
        rhs += jac.T @ F
        rhs[6 + i] -= spring
        H = -c["Iw"][e] * spin[i] * axis
        rhs[3:6] -= -c["Iw"][e] * sdot * axis + np.cross(om, H)
    x = np.linalg.solve(A, rhs)
    w, v3 = y[3], y[4:7]
    out[:3], out[3], out[4:7] = v, -0.5 * v3 @ om, 0.5 * (w * om + np.cross(v3, om))
    out[7:10], out[10:13], out[13:17], out[17:21] = R @ x[:3], x[3:6], sd, x[6:10]
    return out, found


def standing(slope, yaw, tilt):
    """Quaternion of a car that stands on the slope, heading by `yaw`, turned by a small `tilt`."""
    up = np.array([0.0, -slope, -1.0]) / math.hypot(slope, 1.0)
    heading = np.array([math.cos(yaw), math.sin(yaw), 0.0])
    ahead = heading - up * (up @ heading)
    ahead /= np.linalg.norm(ahead)
    right = np.cross(-up, ahead)
    m = np.column_stack([ahead, right, -up]) @ rotation(np.array([1.0, *(tilt / 2)]) / math.hypot(1, np.linalg.norm(tilt) / 2))
    w = math.sqrt(max(0.0, 1 + np.trace(m))) / 2
    return [w, (m[2, 1] - m[1, 2]) / 4 / w, (m[0, 2] - m[2, 0]) / 4 / w, (m[1, 0] - m[0, 1]) / 4 / w]


def main():
    rng = np.random.default_rng(5)
    slope, cases = 0.25, []
    for case in range(12):
        yaw = rng.normal() * 0.8
        state = np.zeros(33)
        up = np.array([0.0, -slope, -1.0]) / math.hypot(slope, 1.0)
        place = rng.normal(size=2) * 3
        # now and then in the air
        state[:3] = np.array([place[0], place[1], -slope * place[1]]) + up * (0.55 + rng.normal() * 0.02 + (case % 4 == 3) * 0.06)
        state[3:7] = standing(slope, yaw, rng.normal(size=3) * 0.02)
        R = rotation(state[3:7])
        state[7:10] = R @ [20 + rng.normal() * 3, rng.normal() * 2, rng.normal() * 0.3]
        state[10:13] = rng.normal(size=3) * [0.3, 0.3, 0.6]
        state[13:17] = rng.normal(size=4) * 0.04
        state[17:21] = rng.normal(size=4) * 0.2
        state[21:25] = 62 + rng.normal(size=4) * 3
        state[25:33] = rng.normal(size=8) * 0.02
        steer, brake, drive = rng.normal() * 0.05, 2000.0 if case % 2 else 14e3, 300.0
        rate, loads = rates(state, steer, brake, drive, slope)
        cases.append(dict(state=state.tolist(), steer=steer, brake=brake, drive=drive, rate=rate.tolist(), loads=loads))
    target = pathlib.Path(__file__).with_suffix(".json")
    target.write_text(json.dumps(dict(slope=slope, cases=cases), indent=1) + "\n")
    print(target.name, [[round(x) for x in case["loads"]] for case in cases])


main()
