#!/usr/bin/env python3
"""Counts instructions (callgrind) and compares them with instructions.toml: of one evaluation, one step, one output, one
whole run and one sample of a study.

    CARGO_INCREMENTAL=0 cargo build --release --package occupant-bench --example count
    python3 crates/occupant-bench/instructions.py target/release/examples/count [--update]

An incremental build inlines other functions, so it counts other instructions.

Only instructions of our own program count: what it calls in the C library (memcpy) picks its code by the processor. The
count of one call is (that of N2 calls - that of N1)/(N2 - N1). A difference of more than the file's tolerance, up or
down, ends with status 1: --update writes the new counts, and the commit says why they moved. Another compiler or target
than the file's counts other instructions, so then nothing is compared, and the script says so. A figure that this
processor cannot run as they were counted (those of a machine with AVX2 on one without), or that holds an instruction which
valgrind does not know, is left out with a word.
"""

import re
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

FILE = Path(__file__).with_name("instructions.toml")
TOLERANCE = 0.02
# Numbers of calls; the runs begin with the crash, so their calls are steps from 50 to 150 ms of it.
CALLS = {"run_step_scalar": (500, 1500), "run_step_lanes4": (500, 1500)}
# Whole runs and samples are long and all alike.
CALLS |= {name: (1, 3) for name in ("run_three_point", "run_air_bag")}
CALLS |= {name: (5, 25) for name in ("sample_cart", "sample_three_point")}
# As many steps with few outputs as with many.
CALLS |= {name: (100, 500) for name in ("output_scalar", "output_lanes4")}
OTHERS = (100, 600)


def compiler():
    """Version and target of rustc."""
    lines = subprocess.run(["rustc", "-vV"], check=True, capture_output=True, text=True).stdout.splitlines()
    about = dict(line.split(": ", 1) for line in lines if ": " in line)
    return {"rustc": about["release"], "target": about["host"]}


def own_instructions(counts, program):
    """Sum of the self costs of all functions of `program` in callgrind's output."""
    names, ours, total, skip = {}, False, 0, False
    for line in counts.read_text().splitlines():
        if line.startswith("ob="):
            number, name = re.fullmatch(r"ob=\((\d+)\)(?: (.*))?", line).groups()
            names.setdefault(number, name)
            ours = names[number] == str(program)
        elif line.startswith("cob="):
            number, name = re.fullmatch(r"cob=\((\d+)\)(?: (.*))?", line).groups()
            names.setdefault(number, name)
        elif line.startswith("calls="):
            skip = True  # the next line is what the called function cost
        elif line[:1].isdigit() or line[:1] in "+-*":
            if ours and not skip:
                total += sum(int(cost) for cost in line.split()[1:2])  # a cost of nothing is left out
            skip = False
    if total == 0:
        sys.exit(f"callgrind counted no instruction of {program}: is its output of another form?")
    return total


def count(program, name, calls):
    """Instructions of `calls` calls and of what comes before them."""
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "callgrind.out"
        command = ["valgrind", "--quiet", "--tool=callgrind", f"--callgrind-out-file={out}", program, name, str(calls)]
        subprocess.run(command, check=True)
        return own_instructions(out, program)


def measure(program):
    """Instructions of one call by name, for what runs here; callgrind's processor has no AVX-512."""
    command = ["valgrind", "--quiet", "--tool=none", program]
    listed = subprocess.run(command, check=True, capture_output=True, text=True).stdout.split()
    found = {}
    for name in listed:
        few, many = CALLS.get(name, OTHERS)
        try:
            found[name] = round((count(program, name, many) - count(program, name, few)) / (many - few))
        except subprocess.CalledProcessError as error:
            if error.returncode != -signal.SIGILL:
                raise
            # Such as the form of vmovq that stores, between registers. It has four bytes where its source is xmm8 to 15 and
            # its target is not; the form that valgrind knows has five then, so it cannot be put in its place.
            print(f"{name}: left out, valgrind does not know an instruction in it", file=sys.stderr)
            continue
        print(f"{name:30} {found[name]:10,}", flush=True)
    return found


def read():
    """Compiler and counts of the file."""
    pairs = re.findall(r'^(\w+) = (?:"(.*)"|([\d.]+))$', FILE.read_text(), re.MULTILINE)
    values = {key: text or number for key, text, number in pairs}
    about = {key: values.pop(key) for key in ("rustc", "target")}
    return about, float(values.pop("tolerance")), {name: int(value) for name, value in values.items()}


def write(about, found):
    lines = [
        "# Instructions of one call in the release profile, counted by instructions.py, which also compares them.",
        "# Written by its --update; the commit that changes a number says why.",
        "",
        f"tolerance = {TOLERANCE}",
        *(f'{key} = "{value}"' for key, value in about.items()),
        "",
        "[instructions]",
        *(f"{name} = {value}" for name, value in found.items()),
    ]
    FILE.write_text("\n".join(lines) + "\n")


def compare(found):
    """Exit status."""
    _, tolerance, recorded = read()
    status = 0
    for name, before in recorded.items():
        if name not in found:
            print(f"{name}: left out, it could not be run here")
            continue
        change = found[name] / before - 1
        if abs(change) > tolerance:
            status = 1
            print(f"{name}: {before:,} are recorded, {found[name]:,} are counted: {change:+.1%}", file=sys.stderr)
    for name in found.keys() - recorded.keys():
        status = 1
        print(f"{name}: counted, not recorded", file=sys.stderr)
    if status:
        print("record them with --update, and say in the commit why they moved", file=sys.stderr)
    else:
        print(f"all within {tolerance:.0%} of {FILE.name}")
    return status


def main(arguments):
    update = "--update" in arguments
    programs = [a for a in arguments if a != "--update"]
    if len(programs) != 1:
        sys.exit(__doc__)
    about = compiler()
    if not update and read()[0] != about:
        print(f"nothing is compared: {FILE.name} is of {read()[0]}, this is {about}")
        return 0
    found = measure(Path(programs[0]).resolve())
    if update:
        # what is left out here keeps its count, if it is of this compiler
        known = read()[2] if FILE.exists() and read()[0] == about else {}
        write(about, known | found)
        return 0
    return compare(found)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
