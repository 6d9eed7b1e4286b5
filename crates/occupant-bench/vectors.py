#!/usr/bin/env python3
"""Finds calls of vector instructions where lanes are computed.

    cargo build --release --package occupant-bench --example count
    python3 crates/occupant-bench/vectors.py target/release

The kernel is inlined whole into functions that may use wide registers. What is not inlined, such as a closure handed to
`fold`, is compiled without them: each of its vector instructions is a call then. This follows all calls from the functions
of `run::batch::machine` in the compiled crate, and ends with status 1 where one of them leads to such a call. It needs
objdump of binutils.
"""

import re
import subprocess
import sys
from pathlib import Path

# Parts of compiled names: what is hot; what is called there once in a while only (odd arguments of arcs and sines, what
# flies so fast that steps must see it); an instruction.
HOT = re.compile(r"run5batch7machine(4avx2|6avx512)")
COLD = re.compile(r"_one_by_one|10look_ahead|14ahead_of_solid")
INSTRUCTION = re.compile(r"core_arch")
# Functions in a listing, and what they call or jump to.
FUNCTION = re.compile(r"^[0-9a-f]+ <(.*)>:$")
TARGET = re.compile(r"R_X86_64_(?:PLT32|PC32|GOTPCREL\w*)\s+(.*?)(?:[-+]0x[0-9a-f]+)?$")
LOCAL = re.compile(r"\s(?:call|jmp)\s+[0-9a-f]+ <([^>]*?)(?:\+0x[0-9a-f]+)?>")


def newest(folder):
    """The compiled crate."""
    found = sorted(folder.glob("deps/liboccupant_core-*.rlib"), key=lambda path: path.stat().st_mtime)
    if not found:
        sys.exit(f"{folder}/deps holds no liboccupant_core-*.rlib: build it first, as the script's head says")
    return found[-1]


def calls(library):
    """What each function calls."""
    command = ["objdump", "--disassemble", "--reloc", "--no-show-raw-insn", str(library)]
    listing = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    graph, current = {}, None
    for line in listing.stdout:
        line = line.rstrip("\n")
        if begins := FUNCTION.match(line):
            current = graph.setdefault(begins[1], set())
        elif current is not None and (found := TARGET.search(line) or LOCAL.search(line)):
            current.add(found[1].removeprefix(".text."))
    if listing.wait() != 0:
        sys.exit("objdump failed")
    return graph


def readable(names):
    """Names as they stand in the source."""
    found = subprocess.run(["c++filt", *names], check=True, capture_output=True, text=True).stdout
    return found.splitlines()


def main(arguments):
    if len(arguments) != 1:
        sys.exit(__doc__)
    graph = calls(newest(Path(arguments[0])))
    ahead = [name for name in graph if HOT.search(name)]
    if not ahead:
        sys.exit("no function of run::batch::machine was found: was it renamed?")
    seen, wrong = set(ahead), set()
    while ahead:
        name = ahead.pop()
        for called in graph.get(name, ()):
            if INSTRUCTION.search(called):
                wrong.add(name)
            elif called not in seen and not COLD.search(called):
                seen.add(called)
                ahead.append(called)
    for name in readable(sorted(wrong)) if wrong else []:
        print(f"{name}: calls vector instructions; inline it into its caller", file=sys.stderr)
    if not wrong:
        print(f"no vector instruction is called in {len(seen)} functions")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
