"""Tables of crash tests 7292 and 10146 of NHTSA's vehicle database, for the scenarios beside this file.

make_table.py FOLDER vehicle > 7292-path.csv           the car's motion, from its sides: all that a scenario is made of
make_table.py FOLDER driver driver > 7292-driver.csv   what driver.csv says that a dummy felt, as channels of the occupant "driver"
make_table.py FOLDER driver > 10146-driver.csv         the same of a scenario's only occupant

FOLDER holds vehicle.csv and driver.csv, a test's signals of -10 to 200 ms from NHTSA's database: a column t_ms, and columns named
LOCATION_AXIS_TYPE_unit_class, such as HDCG_XL_AC_g_cfc1000, with the signs of SAE J211.
"""

import csv
import sys
from pathlib import Path

SIDES = [("DSLF_XG_AC", "DSRF_XG_AC"), ("FLLR_XG_AC", "FLRR_XG_AC")]  # left, right: sills; rear cross-member
LATERAL = ("DSLF_YG_AC", "DSRF_YG_AC")
APART_M = 1.45  # of the two, ours: the car's width less its doors
SEGMENTS = {"HDCG": "head", "CHST": "upper_torso", "PVCN": "lower_torso"}
SIGNS = {"X": ("x", 1), "Y": ("y", -1), "Z": ("z", -1)}  # of SAE J211, in axes of a segment
FORCES = {"FMRL_ZL_LC": "left_femur.axial", "FMRR_ZL_LC": "right_femur.axial"}
BELTS = {"SHBT": "d_ring_shoulder", "LPBO": "buckle_sill"}
G_MPS2 = 9.80665


def read(path):
    with open(path, encoding="utf8") as file:
        rows = list(csv.DictReader(file))
    return {name: [float(row[name]) for row in rows] for name in rows[0]}


def column(table, start):
    return next((values for name, values in table.items() if name.startswith(start)), None)


def path(table):
    """Accelerations midway between the two sides; the yaw rate is what their difference integrates to."""
    left, right = next(pair for names in SIDES if None not in (pair := [column(table, name) for name in names]))
    lateral = [column(table, name) for name in LATERAL]
    out = {"t[ms]": table["t_ms"], "ax[g]": [(a + b) / 2 for a, b in zip(left, right)]}
    if None not in lateral:
        out["ay[g]"] = [(a + b) / 2 for a, b in zip(*lateral)]
    turning = [(a - b) * G_MPS2 / APART_M for a, b in zip(left, right)]
    rest = [rate for t, rate in zip(table["t_ms"], turning) if t < 0]
    turning = [rate - sum(rest) / len(rest) for rate in turning]
    rates = [0.0]
    for i in range(1, len(turning)):
        step_s = (table["t_ms"][i] - table["t_ms"][i - 1]) / 1000
        rates.append(rates[-1] + (turning[i] + turning[i - 1]) / 2 * step_s if table["t_ms"][i] > 0 else 0.0)
    return out | {"wz[rad/s]": [f"{rate:.5f}" for rate in rates]}


def occupant(table, who):
    """`who` is the occupant's name with a dot behind it, or nothing."""
    out = {"t[ms]": table["t_ms"]}
    for short, segment in SEGMENTS.items():
        axes = {axis: column(table, f"{short}_{axis}L_AC") for axis in SIGNS}
        for axis, values in axes.items():
            if values is not None:
                ours, sign = SIGNS[axis]
                out[f"{who}{segment}.acceleration.{ours}[g]"] = [sign * value for value in values]
        if None not in axes.values():
            size = [sum(v * v for v in row) ** 0.5 for row in zip(*axes.values())]
            out[f"{who}{segment}.acceleration.resultant[g]"] = [f"{value:.3f}" for value in size]
    for start, channel in FORCES.items():
        if (values := column(table, start)) is not None:
            out[f"{who}{channel}[N]"] = values
    for start, strap in BELTS.items():
        if (values := column(table, start)) is not None:
            out[f"strap.{who}belt.{strap}.force[N]"] = values
    return out


def main(folder, what, who=None):
    signals = read(Path(folder) / f"{what}.csv")
    out = path(signals) if what == "vehicle" else occupant(signals, f"{who}." if who else "")
    table = csv.writer(sys.stdout, lineterminator="\n")
    table.writerow(out)
    table.writerows(zip(*out.values()))


if __name__ == "__main__":
    main(*sys.argv[1:])
