"""Runs the recipes of docs/sweeps.md for Dask, Ray and Slurm as they are printed there, kills what computes, and compares bits.

    python -m pip install distributed ray pyarrow
    python recipes.py OCCUPANT [--kills 3] [--samples 400] [--seed 1] [--only dask]

Commands and workers end with SIGKILL at random moments. A recipe that ends early is given again, as its page says. The table at
the end must have the bits of a sweep that nobody disturbed. What is not installed here is left out and named: Slurm needs a
cluster (`sinfo` lists it) that sees the folder for temporary files.
"""

import argparse
import importlib.util
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import uuid
from pathlib import Path

import pyarrow.parquet as parquet

ROOT = Path(__file__).resolve().parents[3]
SHARDS = 8
MARK = "OCCUPANT_RECIPE"
STUDY = """base = "{base}"
design = {{ kind = "latin_hypercube", samples = {samples} }}
set = {{ "time.end" = "120 ms" }}
keep = [1]
[[parameters]]
path = "joints.neck.damping"
range = {{ from = "10 in lbf s/rad", to = "40 in lbf s/rad" }}
"""


def recipe(heading):
    """The first block of code below a heading of the page, without its indent."""
    page = (ROOT / "docs/sweeps.md").read_text().split(f"\n## {heading}\n", 1)[1].split("\n## ", 1)[0]
    block = re.search(r"(?:^(?:    .*)?\n)+", page[page.index("\n    ") + 1:], re.MULTILINE).group()
    return re.sub(r"^    ", "", block, flags=re.MULTILINE).strip("\n") + "\n"


def ours(token):
    """Processes of this recipe that compute: commands, and workers, which begin them."""
    for entry in Path("/proc").iterdir():
        try:
            if entry.name.isdigit() and f"{MARK}={token}".encode() in (entry / "environ").read_bytes().split(b"\0"):
                words = (entry / "cmdline").read_bytes().decode(errors="replace").split("\0")
                is_command = Path(words[0]).name == "occupant" and "sweep" in words and "merge" not in words
                is_worker = words[0].startswith("ray::") or any("spawn_main" in word for word in words)
                if is_command or is_worker:
                    yield int(entry.name), "command" if is_command else "worker"
        except OSError:  # it has ended
            continue


def table(folder):
    """All that has the same bits each time; NaN counts as itself."""
    rows = parquet.read_table(folder / "results.parquet").drop_columns(["wall_time_s", "kernel"])
    return rows.num_rows, [repr(column.to_pylist()) for column in rows.columns]


def dask_or_ray(heading):
    def start(at):
        (at / "recipe.py").write_text(recipe(heading))
        return [sys.executable, "recipe.py", str(at / "study.toml"), str(at / "out"), str(SHARDS)]
    return start


def slurm(at):
    """The script with its array, and the two commands below it; the merge is waited for."""
    script, commands = recipe("Slurm").split("\n\n", 1)
    (at / "sweep.sh").write_text(script + "\n")
    return ["sh", "-c", commands.replace("sbatch --dependency", "sbatch --wait --dependency")]


ENGINES = {
    "dask": (dask_or_ray("Dask"), lambda: importlib.util.find_spec("distributed")),
    "ray": (dask_or_ray("Ray"), lambda: importlib.util.find_spec("ray")),
    "slurm": (slurm, lambda: shutil.which("sbatch") and subprocess.run(["sinfo"], capture_output=True).returncode == 0),
}


def disturbed(at, words, path, kills, chance):
    """Gives a recipe until it ends well, with so many kills; how often it was given, and what was killed."""
    token, killed, given = uuid.uuid4().hex, [], 0
    environment = {**os.environ, "PATH": path, MARK: token, "RAY_USAGE_STATS_ENABLED": "0"}
    began = time.monotonic()
    while True:
        given += 1
        with open(at / "log", "ab") as log:
            run = subprocess.Popen(words, cwd=at, env=environment, stdout=log, stderr=log)
            while run.poll() is None:
                time.sleep(chance.uniform(0.2, 1.2))
                living = sorted(ours(token))
                kind = chance.choice(["command", "command", "worker"])
                living = [process for process in living if process[1] == kind]
                if len(killed) < kills and any(True for _ in (at / "out").glob("journal/*")) and living:
                    process, what = chance.choice(living)
                    try:
                        os.kill(process, signal.SIGKILL)
                        killed.append(what)
                    except ProcessLookupError:
                        pass
                if time.monotonic() - began > 900:
                    run.kill()
                    sys.exit(f"recipes: it does not end; see {at / 'log'}")
        if run.returncode == 0 and (at / "out/results.parquet").is_file():
            return given, killed
        if given > kills + 2:
            sys.exit(f"recipes: it fails again and again:\n{(at / 'log').read_text()[-3000:]}")
        time.sleep(1)


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("occupant", type=Path)
    arguments.add_argument("--kills", type=int, default=3)
    arguments.add_argument("--samples", type=int, default=400)
    arguments.add_argument("--seed", type=int, default=1)
    arguments.add_argument("--only", choices=ENGINES)
    given = arguments.parse_args()
    chance = random.Random(given.seed)
    path = f"{given.occupant.resolve().parent}:{os.environ['PATH']}"
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        folder = Path(folder)
        study = STUDY.format(base=ROOT / "scenarios/cart-lap.toml", samples=given.samples)
        (folder / "study.toml").write_text(study)
        words = [given.occupant.resolve(), "sweep", "study.toml", "-o", "out", "--quiet", "--shard", "1/1"]
        subprocess.run(words, cwd=folder, check=True)
        expected = table(folder / "out")
        for name, (start, is_here) in ENGINES.items():
            if given.only not in (None, name):
                continue
            if not is_here():
                print(f"left out: {name} is not here")
                continue
            at = folder / name
            at.mkdir()
            (at / "study.toml").write_text(study)
            began = time.monotonic()
            times, killed = disturbed(at, start(at), path, given.kills, chance)
            if table(at / "out") != expected:
                sys.exit(f"recipes: the table of {name} is another one")
            counts = ", ".join(f"{killed.count(kind)} of {kind}s" for kind in ("command", "worker"))
            print(f"{name}: {len(killed)} kills ({counts}), given {times} times, {time.monotonic() - began:.0f} s: same table")
            if not killed:
                sys.exit("recipes: nothing was killed; give more --samples")


if __name__ == "__main__":
    main()
