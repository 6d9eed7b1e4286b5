"""Makes the synthetic tests of this folder: a run with hidden numbers, measured badly.

    python3 make_test.py OCCUPANT          # the command, such as target/release/occupant

The run is exported at 10 kHz; noise is added to every sample, a sensor's gain is off, the recorder averages over 1.1 ms and
keeps a sample a millisecond. Nothing but the Python standard library; the same seed gives the same file.
"""

import csv
import pathlib
import random
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
SCENARIO = HERE / "cart.toml"
CHANNELS = ["lower_torso.acceleration.x", "upper_torso.acceleration.x", "belt.lap.force", "belt.torso.force"]
NOISE = 0.03  # standard deviation, of each channel's peak
GAIN = 0.01  # standard deviation
AVERAGED = 11  # samples
KEPT = 10  # every tenth sample

# what the fit is not told; the README tells it at its end
HIDDEN = ["belts.lap.k1=520", "belts.lap.k2=1170", "belts.torso.slack=0.8", "materials.seat.friction=0.45"]
TESTS = {
    "test-20mph.csv": (7, []),
    "test-15mph.csv": (8, ["path.speed=15 mph", "path.delta_v=15 mph"]),
}


def run(occupant, changes, folder):
    sets = [word for change in changes for word in ("--set", change)]
    common = ["--set", "output.interval=0.1 ms", "--set", "time.end=0.13"]
    mcap, table = folder / "run.mcap", folder / "run.csv"
    subprocess.run([occupant, "run", SCENARIO, "-o", mcap, "--quiet", *common, *sets], check=True)
    channels = ["--channel", ",".join(CHANNELS)]
    subprocess.run([occupant, "export", mcap, "-o", table, *channels], check=True)
    with open(table, newline="") as file:
        rows = [row for row in csv.reader(file) if row and not row[0].startswith("#")]
    head, rows = rows[0], [[float(cell) for cell in row] for row in rows[1:]]
    return head, list(zip(*rows))


def measured(values, seed):
    chance = random.Random(seed)
    peak = max(abs(v) for v in values)
    gain = 1 + chance.gauss(0, GAIN)
    noisy = [gain * v + chance.gauss(0, NOISE * peak) for v in values]
    half = AVERAGED // 2
    mean = []
    for i in range(0, len(noisy), KEPT):
        near = noisy[max(0, i - half) : i + half + 1]
        mean.append(sum(near) / len(near))
    return mean


def main():
    occupant = sys.argv[1]
    for name, (seed, changes) in TESTS.items():
        with tempfile.TemporaryDirectory() as folder:
            head, columns = run(occupant, HIDDEN + changes, pathlib.Path(folder))
        time = [f"{t:.3f}" for t in columns[0][::KEPT]]
        made = [measured(column, f"{seed}.{i}") for i, column in enumerate(columns[1:])]
        with open(HERE / name, "w", newline="") as file:
            file.write("# synthetic: made by make_test.py\n")
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(head)
            writer.writerows([t, *(f"{c[i]:.3f}" for c in made)] for i, t in enumerate(time))


if __name__ == "__main__":
    main()
