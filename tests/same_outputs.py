#!/usr/bin/env python3
"""Runs two binaries of the command `occupant` over everything in scenarios/ and compares what they produce, to the bit.

    python3 tests/same_outputs.py OLD NEW [--only PATTERN] [--keep DIR] [--jobs N] [--strict-words]

For a change that must move no number: build the command before and after it (with --release), and compare. Every case is
one call of the command. Compared are the exit code, standard output and every file that was written. What is said on
standard error, help texts, descriptions in the schema and the text of `occupant new` are words: their differences are shown
but do not count, unless --strict-words is given. One line a case:

    same     cart-lap/run                 all that was produced is the same
    refused  errors/unknown-path          both refuse it with the same exit code, as they should
    words    cart-lap/check               the same but for words, which are shown
    DIFFERS  cart-lap/measures            the first differing place of each product is shown
    FAILED   cart-lap/export-csv          in one of them, or in both where it should not

The exit code is 0 if nothing differs and nothing failed.

--only takes the cases whose name `group/case` the pattern matches (`*` stands for anything: 'cart-*', '*/run*'); what they
need is run as well. --keep leaves all products in DIR/old and DIR/new, which must not be there yet.

Ignored is only what differs between two runs of one program, or with its version or that of a library:

- the slashes of paths on standard output, which are those of the platform;
- wall times in tables, in JSON and in the columns `wall_time_s`; lines of progress of sweeps and fits;
- `results.parquet` and `history.parquet`, the journals of sweeps and fits, which hold wall times, and `SHA256SUMS` of them;
- the program's version and build; the library named in Parquet files; of MCAP files the library and, where that differs, index,
  checksums and compression of the chunks.

The cases are listed in same_outputs.toml. The fits get a small budget in the copy of scenarios/ that is used.
"""

import argparse
import fnmatch
import json
import os
import re
import resource
import shlex
import shutil
import subprocess
import sys
import tempfile
import time
import tomllib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Callable, Iterator, NamedTuple, Optional

ROOT = Path(__file__).resolve().parent.parent
LIMIT_S = 600  # of one call
MOST_LINES = 6  # of differences of one case

CALLS = tomllib.loads((ROOT / "tests/same_outputs.toml").read_text())
BEGINS_WITH = CALLS["begins_with"]
TIMED = {"results.parquet", "history.parquet", "journal", "parts", "SHA256SUMS"}  # hold wall times


# --- What is run ------------------------------------------------------------------------------------------------------


class Case(NamedTuple):
    group: str
    name: str
    call: list[str]
    only_words: bool = False

    @property
    def full(self) -> str:
        return f"{self.group}/{self.name}"

    def needs(self) -> set[str]:
        """Cases of the group whose products it reads."""
        named = {m[1] for word in self.call if (m := re.match(r"\.\./([\w-]+)/", word))}
        return named | {BEGINS_WITH.get(self.name, self.name)}


def all_cases(old: str) -> list[list[Case]]:
    """The cases by groups; those of a group run one after the other."""
    scenarios, groups = ROOT / "scenarios", []

    def group(name: str, path: Path, *kinds: str, **more: str) -> None:
        more["s"] = f"../../{path.relative_to(ROOT)}"
        cases = []
        for case, call in (item for kind in kinds for item in CALLS[kind].items()):
            for key, value in more.items():
                call = call.replace(f"{{{key}}}", value)
            cases.append(Case(name, case, shlex.split(call)))
        groups.append(cases)

    for path in sorted(scenarios.glob("*.toml")):
        kinds = [kind for kind in ("cart", "cart-lap-torso") if path.stem.startswith(kind)]
        group(path.stem, path, "scenario", *kinds)
    for path in sorted(scenarios.glob("decks/*.dat")):
        beside = f"../../scenarios/decks/{path.stem}"
        table = f"--path {beside}.csv" if path.with_suffix(".csv").exists() else ""
        group(f"deck-{path.stem}", path, "deck", beside=beside, table=table)
    for path in sorted(scenarios.glob("studies/*.toml")):
        group(path.stem, path, "study", *(["ensemble"] if "[ensemble]" in path.read_text() else []))
    # the folder also has their scenario
    for path in (path for path in sorted(scenarios.glob("studies/fit-cart/*.toml")) if "[fit]" in path.read_text()):
        test = "" if "[[fit.tests]]" in path.read_text() else "--to ../../scenarios/studies/fit-cart/test-20mph.csv"
        group(f"fit-{path.stem}", path, "fit", test=test)
    group("record", scenarios / "side-slope-sensors.csv", "record")
    group("errors", scenarios / "cart-lap-torso.toml", "errors")
    words = {"schema": ["schema"], "new": ["new", "case.toml"]}
    words |= {f"completions-{shell}": ["completions", shell] for shell in ("bash", "fish", "zsh")}
    words |= {"-".join(["help", *command]): [*command, "--help"] for command in commands(old, [])}
    new = Case("words", "run-new", ["run", "../new/case.toml", "--no-mcap", "--json"])
    groups.append([*(Case("words", name, call, True) for name, call in words.items()), new])
    return groups


Sides = dict[str, bytes]  # of "old" and of "new"
Verdict = tuple[str, Case, list[str]]


def commands(binary: str, words: list[str]) -> Iterator[list[str]]:
    """All commands that the help texts name."""
    yield words
    text = subprocess.run([binary, *words, "--help"], capture_output=True, text=True, timeout=LIMIT_S).stdout
    listed = re.search(r"^Commands:\n((?:  .*\n)+)", text, re.M)
    for name in re.findall(r"^  ([a-z]+)", listed[1] if listed else "", re.M):
        if name != "help":
            yield from commands(binary, [*words, name])


def shorten_fits(scenarios: Path) -> None:
    """Fits with fewer candidates: the option is in the file."""
    for path in (scenarios / "studies/fit-cart").glob("*.toml"):
        path.write_text(path.read_text().replace("[fit]\n", "[fit]\nbudget = 48\npopulation = 8\n"))


def produce(binary: str, side: Path, case: Case) -> dict[str, bytes]:
    """Runs a case; what it produced, by name."""
    folder = side / case.group / case.name
    folder.mkdir(parents=True)
    if source := BEGINS_WITH.get(case.name):
        shutil.copytree(side / case.group / source / "out", folder / "out")
    environment = {k: v for k, v in os.environ.items() if not k.startswith(("OCCUPANT_", "SLURM_"))}
    ended = subprocess.run([binary, *case.call], cwd=folder, env=environment, capture_output=True, timeout=LIMIT_S)
    made = {"exit code": str(ended.returncode).encode(), "standard output": ended.stdout, "standard error": ended.stderr}
    written = folder.parent / "sweep/out/bands" if case.name == "bands" else folder
    for path in sorted(p for p in written.rglob("*") if p.is_file()):
        name = path.relative_to(written)
        if TIMED.isdisjoint(name.parts):
            made[str(name)] = path.read_bytes()
    return made


# --- From bytes to parts with names, without what may differ ----------------------------------------------------------


class Part(NamedTuple):
    place: str
    data: bytes
    expand: Optional[Callable[[], list["Part"]]] = None  # what it is made of, looked at only where the bytes differ


NEUTRAL = [
    (rb'"wall_time_s": [0-9.e-]+', b'"wall_time_s": TIME'),
    (rb'"build": "[0-9a-f]*"', b'"build": BUILD'),
    (rb"[0-9.]+ s of wall time", b"TIME s of wall time"),
    (rb"samples in [0-9.]+ s,", b"samples in TIME s,"),
    (rb"(?m)^[0-9]+ (evaluations, .*: score |of [0-9]+ samples, ).*\n", b""),  # reported every few seconds
    (rb"[0-9.]+ times the plain run,? for", b"RATIO times the plain run for"),
    (rb'"plain_run_s": [0-9.e-]+', b'"plain_run_s": TIME'),
    (rb'"run_in_duals_s": [0-9.e-]+,\s+"ratio": [0-9.e-]+', b'"run_in_duals_s", "ratio": TIME'),
]


def parts_of(name: str, data: bytes, version: bytes) -> list[Part]:
    """Parts of a product, in order."""
    if name.endswith(".png") or name == "exit code":
        return [Part("", data)]
    if name.endswith(".parquet"):
        return [Part("", re.sub(rb"parquet-rs version \S+", b"parquet-rs", data))]
    if name.endswith(".mcap"):
        try:
            return list(mcap_parts(data[8:-8], version, {}))
        except (ValueError, KeyError) as trouble:
            return [Part(f"cannot be read ({trouble}), raw", data)]
    return text_parts(name, data, version)


def text_parts(name: str, data: bytes, version: bytes) -> list[Part]:
    data = data.replace(version, b"occupant VERSION")
    if name.startswith("standard "):  # paths as Windows writes them
        data = data.replace(b"\\", b"/")
    for pattern, neutral in NEUTRAL:
        data = re.sub(pattern, neutral, data)
    lines = data.split(b"\n")
    if name.endswith(".csv") and b",wall_time_s," in lines[0]:  # the last column but one
        lines = [re.sub(rb",[0-9.e-]+(,[^,]*)$", rb",TIME\1", line) for line in lines]
    return [Part(f"line {i}", line) for i, line in enumerate(lines, 1)]


class Reader:
    """Takes fields from bytes, one after the other."""

    def __init__(self, data: bytes, at: int = 0):
        self.data, self.at = data, at

    def bytes(self, count: int) -> bytes:
        self.at += count
        if self.at > len(self.data):
            raise ValueError("cut off")
        return self.data[self.at - count : self.at]

    def number(self, size: int) -> int:
        return int.from_bytes(self.bytes(size), "little")

    def text(self) -> str:
        return self.bytes(self.number(4)).decode()

    def more(self) -> bool:
        return self.at < len(self.data)


def mcap_parts(data: bytes, version: bytes, topics: dict[int, str]) -> Iterator[Part]:
    """The records of an MCAP file or chunk except its index; `topics` learns the names of the channels."""
    file = Reader(data)
    while file.more():
        kind = file.number(1)
        record = Reader(file.bytes(file.number(8)))
        if kind == 0x01:
            yield Part("profile", record.text().encode())
        elif kind == 0x03:
            record.number(2)
            yield Part(f"schema {record.text()}", record.data)
        elif kind == 0x04:
            number, _ = record.number(2), record.number(2)
            topics[number] = record.text()
            yield Part(f"channel {topics[number]}", record.data)
        elif kind == 0x05:
            topic, _ = topics.get(record.number(2)), record.number(4)
            yield Part(f"message on {topic} at {record.number(8) / 1e9:g} s", record.data)
        elif kind == 0x06:
            start, end, _ = record.number(8), record.number(8), record.bytes(12)
            unpack = lz4 if record.text() == "lz4" else bytes
            packed = record.bytes(record.number(8))
            inside = lambda unpack=unpack, packed=packed: list(mcap_parts(unpack(packed), version, topics))
            yield Part(f"chunk {start / 1e9:g} to {end / 1e9:g} s", packed, inside)
        elif kind == 0x09:
            record.bytes(16)
            name, media = record.text(), record.text()
            content = record.bytes(record.number(8))
            yield Part(f"attachment {name}, type", media.encode())
            yield from (Part(f"attachment {name}, {p.place}", p.data) for p in text_parts(name, content, version))
        elif kind == 0x0C:
            name, pairs = record.text(), Reader(record.bytes(record.number(4)))
            while pairs.more():
                key, value = pairs.text(), pairs.text().encode()
                yield Part(f"metadata {name}, {key}", value.replace(version, b"occupant VERSION"))


def mcap_library(data: bytes) -> str:
    """The library that wrote an MCAP file: the second text of its header."""
    header = Reader(data, 17)
    header.text()
    return header.text()


def lz4(frame: bytes) -> bytes:
    """The content of an LZ4 frame."""
    reader, out = Reader(frame, 4), bytearray()
    flags = reader.number(1)
    reader.at += 2 + (8 if flags & 8 else 0) + (4 if flags & 1 else 0)
    while size := reader.number(4):
        block = Reader(reader.bytes(size & 0x7FFFFFFF))
        reader.at += 4 if flags & 16 else 0
        if size >> 31:
            out += block.data
            continue
        while block.more():
            token = block.number(1)
            out += block.bytes(long_length(token >> 4, block))
            if not block.more():
                break
            start = len(out) - block.number(2)
            length = 4 + long_length(token & 15, block)
            while length > 0:  # may overlap with what it writes
                piece = out[start : start + length]
                out += piece
                start, length = start + len(piece), length - len(piece)
    return bytes(out)


def long_length(length: int, block: Reader) -> int:
    more = 255 if length == 15 else 0
    while more == 255:
        more = block.number(1)
        length += more
    return length


# --- Comparison -------------------------------------------------------------------------------------------------------


def first_difference(old: list[Part], new: list[Part]) -> Optional[str]:
    """The first place where two lists of parts differ, in words."""
    differing, first = 0, None
    for a, b in zip(old, new):
        if a.place != b.place:
            return first or f"{a.place} / {b.place}: {shown(a.data, b.data)}"
        if a.data == b.data:
            continue
        found = first_difference(a.expand(), b.expand()) if a.expand and b.expand else shown(a.data, b.data)
        if found:
            differing += 1
            first = first or ": ".join(filter(None, (a.place, found)))
    if first is None and len(old) != len(new):
        first = f"{len(old)} / {len(new)} parts; one has no {max(old, new, key=len)[min(len(old), len(new))].place}"
    return f"{first} (and {differing - 1} more)" if differing > 1 else first


def shown(old: bytes, new: bytes) -> str:
    """Both sides around the first byte that differs."""
    at = next((i for i, (a, b) in enumerate(zip(old, new)) if a != b), min(len(old), len(new)))
    start = max(0, at - 40)
    texts = [side[start : at + 40].decode(errors="replace") for side in (old, new)]
    if any(not c.isprintable() for text in texts for c in text[3:-3]):  # a character may be cut at an end
        return f"byte {at} of {len(old)} / {len(new)}"
    return " / ".join(f"`{text}`" for text in texts)


def differences(case: Case, made: dict[str, dict[str, bytes]], versions: Sides) -> Iterator[tuple[bool, str]]:
    """For each product that differs: whether it is only words, and where."""
    old, new = made["old"], made["new"]
    for name in [*old, *(n for n in new if n not in old)]:
        if name not in old or name not in new:
            yield False, f"{name}: only from {'OLD' if name in old else 'NEW'}"
        elif old[name] != new[name]:
            parts = (parts_of(name, made[side][name], versions[side]) for side in ("old", "new"))
            place = first_difference(*parts)
            if not place and name.endswith(".mcap") and mcap_library(old[name]) == mcap_library(new[name]):
                place = "index, checksums or compression"
            if place:
                only_words = name == "standard error" or (case.only_words and name != "exit code")
                yield only_words, f"{name}, {place}"
    if case.only_words and structure(old["standard output"]) != structure(new["standard output"]):
        yield False, "these are not only words: other options, values or keys"


def structure(text: bytes) -> object:
    """What is more than words: of a help text its options and commands, of a schema all but titles and descriptions."""

    def without_words(value):
        if isinstance(value, dict):
            words = {k for k in ("description", "title") if isinstance(value.get(k), str)}
            return {k: without_words(v) for k, v in value.items() if k not in words}
        return [without_words(v) for v in value] if isinstance(value, list) else value

    if text.startswith(b"{"):
        return without_words(json.loads(text))
    options = rb"^ {2,6}(-\S.*?)(?:  .*)?$|^  ([a-z]+)  |^ +- ([\w-]+):|^(Usage: .*)|\[((?:default|possible values): .*?)\]"
    return re.findall(options, text, re.M) if b"Usage: " in text else None


def judge(case: Case, binaries: dict[str, str], folder: Path, versions: Sides) -> Verdict:
    """Runs a case with both binaries: the verdict and the differences."""
    try:
        made = {side: produce(binary, folder / side, case) for side, binary in binaries.items()}
        found = list(differences(case, made, versions))
    except (OSError, subprocess.TimeoutExpired, ValueError) as trouble:
        return "FAILED", case, [repr(trouble)]
    lines = [line for _, line in found]
    if len(lines) > MOST_LINES:
        lines[MOST_LINES:] = [f"and {len(lines) - MOST_LINES} products more"]
    old, new = (products["exit code"] for products in made.values())
    if (old == b"0") != (new == b"0"):
        return "FAILED", case, lines
    if old != b"0" and not any(fnmatch.fnmatch(case.full, pattern) for pattern in CALLS["may_be_refused"]["cases"]):
        said = made["new"]["standard error"].decode(errors="replace").split("\n")
        return "FAILED", case, ["in both: " + next((line for line in said if line.startswith("error")), said[0]), *lines]
    if any(not only_words for only_words, _ in found):
        return "DIFFERS", case, lines
    return "words" if found else "same" if old == b"0" else "refused", case, lines


def chosen(cases: list[Case], pattern: str) -> list[Case]:
    """The cases that the pattern matches, and what they need."""
    wanted = {case.name for case in cases if fnmatch.fnmatch(case.full, pattern)}
    for case in reversed(cases):  # what is needed stands before
        if case.name in wanted:
            wanted |= case.needs()
    return [case for case in cases if case.name in wanted]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("old", metavar="OLD")
    parser.add_argument("new", metavar="NEW")
    parser.add_argument("--only", metavar="PATTERN", default="*", help="cases whose name group/case matches")
    parser.add_argument("--keep", metavar="DIR", type=Path, help="leave all products here")
    parser.add_argument("--jobs", metavar="N", type=int, default=os.cpu_count(), help="groups of cases side by side")
    parser.add_argument("--strict-words", action="store_true", help="differing words count")
    args = parser.parse_args()
    if args.keep and args.keep.exists():
        parser.error(f"{args.keep} exists")
    binaries = {side: str(Path(path).resolve()) for side, path in (("old", args.old), ("new", args.new))}
    versions = {side: subprocess.check_output([path, "--version"]).strip() for side, path in binaries.items()}
    groups = [cases for group in all_cases(binaries["old"]) if (cases := chosen(group, args.only))]
    began = time.monotonic()
    counts = dict.fromkeys(("same", "refused", "words", "DIFFERS", "FAILED"), 0)
    with tempfile.TemporaryDirectory() as temporary, ThreadPoolExecutor(args.jobs) as pool:
        folder = (args.keep or Path(temporary)).resolve()
        for side in binaries:
            shutil.copytree(ROOT / "scenarios", folder / side / "scenarios")
            shorten_fits(folder / side / "scenarios")
        for verdicts in pool.map(lambda cases: [judge(case, binaries, folder, versions) for case in cases], groups):
            for verdict, case, lines in verdicts:
                counts[verdict] += 1
                print("\n         ".join([f"{verdict:8} {case.full}", *lines]), flush=True)
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu_s = used.ru_utime + used.ru_stime
    summary = ", ".join(f"{count} {verdict}" for verdict, count in counts.items() if count)
    times = f"{time.monotonic() - began:.0f} s, {cpu_s:.0f} s of processor time of the binaries"
    print(f"\n{sum(counts.values())} cases: {summary or 'none'}; {times}")
    wrong = counts["DIFFERS"] + counts["FAILED"] + (counts["words"] if args.strict_words else 0)
    return 1 if wrong or not any(counts.values()) else 0


if __name__ == "__main__":
    sys.exit(main())
