"""The means of the sled tests of Shaw et al. (2009) as a table with the names of channels of scenarios/sled-person.toml.

make_table.py FOLDER > shaw.csv

FOLDER holds the curves as the validation catalogue of the SAFER human body model publishes them (saferhbm/validation on GitHub,
Shaw-2009-gold-standard-1): kinematics.csv, ms and mm, columns such as hXm; shoulder-belt-8-tests.csv, ms and kN, columns such as
upper_1_kN. Displacements begin at 0.
"""

import csv
import sys
from pathlib import Path

MARKERS = {"h": "head", "t1": "t1", "t8": "t8", "l2": "l2", "l4": "l4", "p": "pelvis", "la": "left_acromion", "ra": "right_acromion"}
BELTS = {"upper": "d_ring_shoulder", "lower": "shoulder_buckle"}
LAST_MS = 125


def read(path):
    with open(path, encoding="utf8") as file:
        return list(csv.DictReader(file))


def main(folder):
    ways = [row for row in read(folder / "kinematics.csv") if float(row["time"]) <= LAST_MS]
    belts = {float(row["t_ms"]): row for row in read(folder / "shoulder-belt-8-tests.csv")}
    columns = {"t[ms]": [row["time"] for row in ways]}
    for short, name in MARKERS.items():
        for axis in "xyz":
            mm = [float(row[f"{short}{axis.upper()}m"]) for row in ways]
            columns[f"marker.{name}.displacement.{axis}[mm]"] = [f"{way - mm[0]:.3f}" for way in mm]
    for which, strap in BELTS.items():
        mean = [sum(float(belts[float(t)][f"{which}_{i}_kN"]) for i in range(1, 9)) / 8 for t in columns["t[ms]"]]
        columns[f"strap.torso.{strap}.force[kN]"] = [f"{force:.4f}" for force in mean]
    table = csv.writer(sys.stdout, lineterminator="\n")
    table.writerow(columns)
    table.writerows(zip(*columns.values()))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
