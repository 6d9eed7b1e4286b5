"""Kills the command at random moments, and lets it write on disks that are full, and looks at what is left.

    python3 kills_and_full_disks.py OCCUPANT [--kills 100] [--disks 20] [--seed 1]

Kills: run, sweep, ensemble with bands, and fit end with SIGKILL at a random moment, again and again, until one process comes to
its end; its results must be the bytes of one that nobody disturbed (times and paths of the machine aside). Disks: small file
systems in memory (root mounts them) take run, sweep, bands, fit, print, report, export, plot, view, convert and new; the
exit code must be 1, the message must name the file and say that there is no room, and what has its final name must be whole.
"""

import argparse
import collections
import json
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

STUDY = 'base = "case.toml"\nseed = 1\n[set]\n"time.end" = "{end}"\n"output.interval" = "1 ms"\n'
FRICTION = '[[parameters]]\nname = "friction"\npath = "materials.foam.friction"\nrange = {{ from = 0.2, to = 1 }}\n'
SWEEP = STUDY + "keep = [0, 7]\n[design]\nkind = \"latin_hypercube\"\nsamples = {count}\n" + FRICTION
ENSEMBLE = STUDY + '[ensemble]\nmembers = {count}\nposture = "1 deg"\nplace = "5 mm"\n'
FIT = STUDY + FRICTION + '[fit]\nobjective = "rms"\nbudget = {count}\n[[fit.channels]]\nchannel = "lower_torso.acceleration.x"\n'


def texts(folder, count):
    """Scenario, studies and a test to fit to."""
    for name, text, end in (("sweep", SWEEP, "40 ms"), ("ensemble", ENSEMBLE, "40 ms"), ("fit", FIT, "40 ms")):
        text = text.format(end=end, count=count)
        head, _, rest = text.partition("[set]")
        if "keep" in rest:
            line = next(line for line in rest.split("\n") if line.startswith("keep"))
            head, rest = head + line + "\n", rest.replace(line + "\n", "")
        (folder / f"{name}.toml").write_text(head + "[set]" + rest)


WORK = {
    "run": ["run case.toml -q -o run.mcap --set time.end=0.15"],
    "sweep": ["sweep sweep.toml -o sweep -q --csv"],
    "bands": ["sweep ensemble.toml -o ensemble -q --csv", "study bands ensemble"],
    "fit": ["fit fit.toml --test test.csv -o fit -q"],
}


def do(occupant, words, folder, kill_after=None):
    """Exit code, or None for one that was killed, and what was said."""
    child = subprocess.Popen([occupant, *words.split(" ")], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    try:
        said = child.communicate(timeout=kill_after)[1]
    except subprocess.TimeoutExpired:
        child.send_signal(signal.SIGKILL)
        said = child.communicate()[1]
        return None, said.decode()
    return child.returncode, said.decode()


def results(folder, what):
    """What stays the same, by name: files without journals, locks, checksums, wall times."""
    found = {}
    for path in sorted((folder / what).rglob("*")) if what != "run" else [folder / "run.mcap"]:
        name = str(path.relative_to(folder))
        if not path.is_file() or "journal" in name or path.suffix in (".lock", ".parquet") or path.name == "SHA256SUMS":
            continue
        data = path.read_bytes()
        if path.suffix == ".csv" and b"wall_time" in data.split(b"\n")[0]:
            at = next(i for i, c in enumerate(data.split(b"\n")[0].split(b",")) if b"wall_time" in c)
            data = b"\n".join(b",".join(c for i, c in enumerate(line.split(b",")) if i != at) for line in data.split(b"\n"))
        found[name] = data
    return found


def kills(occupant, base, count, dice):
    wrong, done, ends = 0, 0, collections.Counter()
    takes, wanted = {}, {}
    whole = base / "whole"
    shutil.copytree(base / "texts", whole)
    for what, commands in WORK.items():
        began = time.monotonic()
        for words in commands:
            code, said = do(occupant, words, whole)
            assert code == 0, (words, said)
        takes[what], wanted[what] = time.monotonic() - began, results(whole, {"bands": "ensemble"}.get(what, what))
    print({what: f"{s:.1f} s" for what, s in takes.items()}, flush=True)
    while done < count:
        for what, commands in WORK.items():
            folder = base / "killed"
            shutil.rmtree(folder, ignore_errors=True)
            shutil.copytree(base / "texts", folder)
            killed, said = 0, ""
            for words in commands:
                while True:
                    again = words + (" -f" if what == "run" and killed else "")
                    code, said = do(occupant, again, folder, dice.random() * takes[what] * 1.2 if killed < 4 else None)
                    ends[code] += 1
                    if code is not None:
                        break
                    killed += 1
                    if what == "run" and (folder / "run.mcap").exists() and results(folder, what) != wanted[what]:
                        print(f"FINDING {what}: another file under the final name")
                        wrong += 1
                if code != 0:
                    print(f"FINDING {what}: exit {code} after {killed} kills: {said}")
                    wrong += 1
            done += killed
            found = results(folder, {"bands": "ensemble"}.get(what, what))
            if found != wanted[what]:
                names = [n for n in wanted[what].keys() | found.keys() if wanted[what].get(n) != found.get(n)]
                print(f"FINDING {what}: after {killed} kills other results: {names}", flush=True)
                wrong += 1
            left = [p.name for p in folder.rglob("*") if ".partial" in p.name]
            if left:
                print(f"FINDING {what}: left behind: {left}", flush=True)
                wrong += 1
    print(f"{done} kills, exit codes {dict(ends)}, {wrong} findings")
    return wrong


SMALL = [
    "run case.toml -q -o run.mcap --set time.end=0.15", "sweep sweep.toml -o sweep -q --csv", "sweep ensemble.toml -o ensemble -q --csv",
    "fit fit.toml --test test.csv -o fit -q", "print ../texts/seed.mcap -o out.txt", "report ../texts/seed.mcap -o out.html",
    "export ../texts/seed.mcap -o out.csv", "export ../texts/seed.mcap -o out.parquet", "export ../texts/seed.mcap -o out.mme",
    "plot ../texts/seed.mcap -o out.svg", "plot ../texts/seed.mcap -o out.png", "view ../texts/seed.mcap -o out.png",
    "convert ../texts/deck.dat -o out.toml", "new out.toml", "run case.toml -q --ensemble 4 -o run.mcap",
    "sensitivity case.toml --to hic15 --of joints.neck.damping --channels head.* -o out.csv", "study bands swept",
]


def named(words, said):
    """Whether a message says which file or folder of the command's output it is about."""
    words = words.split(" ")
    output = words[words.index("-o") + 1] if "-o" in words else words[-1]
    stem, _, ending = output.partition(".")
    return re.search(rf"(^|[ /]){stem}(\.partial(-\d+)?)?(\.{ending or '$'}|[/:. ])", said, re.M) is not None


def disks(occupant, base, count, dice):
    wrong, ends = 0, collections.Counter()
    place = base / "disk"
    place.mkdir()
    for number in range(count):
        for words in SMALL:
            given = [p for p in (base / "texts").rglob("*") if p.suffix != ".mcap" and ("swept" in words or "swept" not in p.parts)]
            whole = sum(-(-p.stat().st_size // 4096) for p in given) + 20
            pages = whole + dice.choice([0, 1, 2, 3, 5, 8, 13, 21, 34, 55, 89, 144])
            subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={pages * 4}k", "tmpfs", place], check=True)
            try:
                for path in given:
                    to = place / path.relative_to(base / "texts")
                    to.mkdir() if path.is_dir() else shutil.copy(path, to)
                before = set(place.rglob("*"))
                code, said = do(occupant, words, place)
                ends[code] += 1
                if code not in (0, 1) or "panick" in said or (code == 1 and not ("o space left" in said and named(words, said))):
                    print(f"FINDING {words} on {pages} pages: exit {code}: {said[:400]}", flush=True)
                    wrong += 1
                left = [p for p in place.rglob("*") if p.is_file() and p not in before]
                for path in left:
                    if code == 1 and path.name.startswith("out") or path.suffix == ".json" and not readable(path):
                        print(f"FINDING {words}: exit {code} and {path.name} of {path.stat().st_size} bytes", flush=True)
                        wrong += 1
                if code == 1 and words.startswith(("sweep", "fit", "study")):
                    subprocess.run(["mount", "-o", "remount,size=200M", place], check=True)
                    code, said = do(occupant, words, place)
                    if code != 0:
                        print(f"FINDING {words} with room again: exit {code}: {said[:400]}", flush=True)
                        wrong += 1
                # what a run has left can be resumed
                partial = [p.name for p in place.rglob("*.partial*") if not words.startswith("run")]
                if partial:
                    print(f"FINDING {words}: left behind: {partial}", flush=True)
                    wrong += 1
            finally:
                subprocess.run(["umount", place], check=True)
    print(f"{count} disks, exit codes {dict(ends)}, {wrong} findings")
    return wrong


def readable(path):
    try:
        json.loads(path.read_text())
        return True
    except ValueError:
        return False


def main():
    wants = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    wants.add_argument("occupant", type=lambda p: str(Path(p).resolve()))
    wants.add_argument("--kills", type=int, default=0)
    wants.add_argument("--disks", type=int, default=0)
    wants.add_argument("--seed", type=int, default=1)
    asked = wants.parse_args()
    with tempfile.TemporaryDirectory() as base:
        base = Path(base)
        (base / "texts").mkdir()
        texts(base / "texts", 24)
        root = Path(__file__).resolve().parents[3]
        shutil.copy(root / "scenarios/decks/driver-lap-torso.dat", base / "texts/deck.dat")
        first = ("new case.toml", "run case.toml -q -o seed.mcap --set time.end=0.04", "export seed.mcap -o test.csv")
        for words in (*first, "sweep ensemble.toml -o swept -q"):
            code, said = do(asked.occupant, words, base / "texts")
            assert code == 0, (words, said)
        (base / "texts/test.csv-metadata.json").unlink(missing_ok=True)
        wrong = 0
        if asked.kills:
            wrong += kills(asked.occupant, base, asked.kills, random.Random(asked.seed))
        if asked.disks:
            wrong += disks(asked.occupant, base, asked.disks, random.Random(asked.seed))
    sys.exit(wrong > 0)


if __name__ == "__main__":
    main()
