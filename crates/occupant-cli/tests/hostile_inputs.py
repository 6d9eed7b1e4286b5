"""Gives damaged and hostile files to the command and looks at how it ends: exit code, words, time and memory.

    python3 hostile_inputs.py OCCUPANT [--mcap 20000] [--others 20000] [--large MB …] [--seed 1] [--jobs 2] [--keep FOLDER]

A finding is: an exit code other than 0, 1, 2; a word of a panic; more than 1 GB at the peak; more than 2 s for an input of at
most 1 MB. Its input is copied into FOLDER with the command beside it. Numbers are the same for the same seed.
"""

import argparse
import collections
import functools
import multiprocessing
import os
import random
import re
import resource
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import zlib
from pathlib import Path

MOST_KB = 1_000_000
MOST_S = 2.0
PANIC = (b"panicked", b"overflow", b"RUST_BACKTRACE", b"abort", b"SIG", b"unreachable", b"out of bounds", b"memory allocation")
ROOT = Path(__file__).resolve().parents[3]

# ---------------------------------------------------------------- MCAP

MAGIC = b"\x89MCAP0\r\n"
CHUNK, MESSAGE, ATTACHMENT, METADATA, DATA_END, FOOTER = 0x06, 0x05, 0x09, 0x0C, 0x0F, 0x02
COUNTS = [0, 1, 2**31 - 1, 2**31, 2**32 - 1, 2**32, 2**63 - 1, 2**63, 2**64 - 1, 2**64 - 9]


def records(data):
    """Opcode and body of each record."""
    at = 0
    while at + 9 <= len(data):
        length = struct.unpack_from("<Q", data, at + 1)[0]
        yield data[at], data[at + 9 : at + 9 + length]
        at += 9 + length


def record(opcode, body):
    return bytes([opcode]) + struct.pack("<Q", len(body)) + body


def text(words):
    words = words if isinstance(words, bytes) else words.encode()
    return struct.pack("<I", len(words)) + words


def lz4_unpacked(frame):
    """What an LZ4 frame of independent or linked blocks holds."""
    flags, at, out = frame[4], 7, bytearray()
    at += 8 * bool(flags & 8)
    while True:
        size = struct.unpack_from("<I", frame, at)[0]
        at += 4
        if size == 0:
            return bytes(out)
        block = frame[at : at + (size & 0x7FFFFFFF)]
        at += len(block) + 4 * bool(flags & 16)
        if size >> 31:
            out += block
            continue
        i = 0
        while i < len(block):
            token, i = block[i], i + 1
            length = token >> 4
            while length >= 15 and block[i] == 255:
                length, i = length + 255, i + 1
            if token >> 4 == 15:
                length, i = length + block[i], i + 1
            out += block[i : i + length]
            i += length
            if i >= len(block):
                break
            offset, i = block[i] | block[i + 1] << 8, i + 2
            length = token & 15
            while length >= 15 and block[i] == 255:
                length, i = length + 255, i + 1
            if token & 15 == 15:
                length, i = length + block[i], i + 1
            for _ in range(length + 4):
                out.append(out[-offset])


def lz4_stored(content):
    """A frame whose blocks are as they were."""
    frame = b"\x04\x22\x4d\x18\x40\x70\xdf"
    for at in range(0, len(content), 4 << 20):
        part = content[at : at + (4 << 20)]
        frame += struct.pack("<I", len(part) | 1 << 31) + part
    return frame + bytes(4)


def lz4_repeated(unit, size):
    """A frame that makes `size` bytes of a unit again and again: 255 for each byte of the file."""
    frame, left = b"\x04\x22\x4d\x18\x60\x70\x73", size
    while left > len(unit) + 64:
        here = min(left, 4 << 20)
        more = here - len(unit) - 4 - 15 - 12
        block = bytes([0xFF]) + length_bytes(len(unit) - 15) + unit if len(unit) >= 15 else bytes([len(unit) << 4 | 15]) + unit
        block += struct.pack("<H", len(unit)) + length_bytes(more) + bytes([12 << 4]) + bytes(12)
        frame += struct.pack("<I", len(block)) + block
        left -= len(unit) + more + 19 + 12
    return frame + bytes(4), size - left


def length_bytes(length):
    return b"\xff" * (length // 255) + bytes([length % 255])


def chunk(content, packing, size=None, crc=None, packed=None):
    packed = packed if packed is not None else lz4_stored(content) if packing == b"lz4" else content
    size = len(content) if size is None else size
    crc = zlib.crc32(content) if crc is None else crc
    return record(CHUNK, bytes(16) + struct.pack("<QI", size, crc) + text(packing) + struct.pack("<Q", len(packed)) + packed)


def opened(data):
    """The records of a file, those of chunks in lists."""
    found = []
    for opcode, body in records(data[8:]):
        if opcode == CHUNK:
            size = struct.unpack_from("<I", body, 28)[0]
            packing, packed = body[32 : 32 + size], body[32 + size + 8 :]
            found.append(list(records(lz4_unpacked(packed) if packing == b"lz4" else packed)))
        else:
            found.append((opcode, body))
    return found


def closed(items, dice, lie=0.0):
    """A file of these records: chunks packed anew, checksums that fit."""
    out = bytearray(MAGIC)
    for item in items:
        if isinstance(item, list):
            content = b"".join(record(*r) for r in item)
            size = dice.choice(COUNTS) if dice.random() < lie else None
            packing = b"lz4" if dice.random() < 0.7 else b""
            made = chunk(content, packing, size)
            out += made if dice.random() >= lie else made[: dice.randrange(9, len(made))]
        elif item[0] == ATTACHMENT:
            body = item[1][:-4]
            out += record(ATTACHMENT, body + struct.pack("<I", zlib.crc32(body)))
        elif item[0] == DATA_END:
            out += record(DATA_END, struct.pack("<I", zlib.crc32(out) if dice.random() < 0.5 else 0))
        else:
            out += record(*item)
    return bytes(out) + MAGIC


def varint(number):
    number &= 2**64 - 1
    out = bytearray()
    while number > 127:
        out.append(number & 127 | 128)
        number >>= 7
    return bytes(out + bytes([number]))


def changed_numbers(body, dice):
    """A record with a length, a count, a float or a text of it changed."""
    body = bytearray(body)
    if not body:
        return bytes(body)
    at = dice.randrange(len(body))
    kind = dice.randrange(9)
    if kind == 0:
        body[at : at + 8] = struct.pack("<Q", dice.choice(COUNTS))
    elif kind == 1:
        body[at : at + 4] = struct.pack("<I", dice.choice(COUNTS) & 0xFFFFFFFF)
    elif kind == 2:
        body[at : at + dice.choice([1, 8])] = varint(dice.choice(COUNTS))
    elif kind == 3:
        wild = dice.choice([float("nan"), float("inf"), -1e308, 1e308, 5e-324, -0.0, 1e18, -1.0])
        body[at : at + 8] = struct.pack("<d", wild)
    elif kind == 4:
        body[at] ^= 1 << dice.randrange(8)
    elif kind == 5:
        del body[at : at + dice.randrange(1, 200)]
    elif kind == 6:
        body[at:at] = body[at : at + dice.randrange(1, 200)]
    elif kind == 7:
        # a repeated field that announces much
        body[at:at] = varint(dice.randrange(1, 40) << 3 | 2) + varint(dice.choice(COUNTS))
    else:
        body[at:at] = varint(dice.randrange(1, 40) << 3 | dice.randrange(8)) + bytes(dice.randrange(12))
    return bytes(body)


def changed_words(words, dice):
    """A text with a number, a word or a line changed."""
    numbers = [b"0", b"-1", b"1e308", b"-1e308", b"1e-308", b"nan", b"inf", b"9223372036854775807", b"99999999999999999999", b"1e9",
               b"1e-9", b"true", b'""', b"[]", b"{}", b"0x7fffffffffffffff", b"1e999999999", b"0." + b"1" * 400, b"1" * 400]
    lines = words.split(b"\n")
    for _ in range(dice.randrange(1, 4)):
        i = dice.randrange(len(lines))
        kind = dice.randrange(10)
        line = lines[i]
        if kind < 4 and b"=" in line:
            lines[i] = line.split(b"=", 1)[0] + b"= " + dice.choice(numbers)
        elif kind == 4 and line:
            at = dice.randrange(len(line))
            lines[i] = line[:at] + bytes([dice.randrange(256)]) + line[at + 1 :]
        elif kind == 5:
            del lines[i]
            lines = lines or [b""]
        elif kind == 6:
            lines.insert(dice.randrange(len(lines)), line)
        elif kind == 7:
            lines.insert(i, dice.choice(lines))
        else:
            found = list(re.finditer(rb"[-+]?[0-9.]+(e[-+]?[0-9]+)?", line))
            if found:
                m = dice.choice(found)
                lines[i] = line[: m.start()] + dice.choice(numbers) + line[m.end() :]
    return b"\n".join(lines)


def mutated_mcap(seeds, dice):
    data, items = dice.choice(seeds)
    kind = dice.randrange(12)
    if kind < 3:
        return mutated_bytes(data, dice)
    items = [list(i) if isinstance(i, list) else i for i in items]
    for _ in range(dice.randrange(1, 4)):
        lists = [i for i in items if isinstance(i, list) and i]
        here = dice.choice(lists) if lists and dice.random() < 0.6 else items
        at = dice.randrange(len(here))
        item = here[at]
        if isinstance(item, list):
            continue
        if kind in (3, 4, 5, 6):
            here[at] = (item[0], changed_numbers(item[1], dice))
        elif kind == 7:
            here[at] = (dice.choice([0, 1, 2, 5, 6, 7, 9, 12, 15, 255, dice.randrange(256)]), item[1])
        elif kind == 8:
            here.insert(dice.randrange(len(here) + 1), item)
        elif kind == 9:
            del here[at]
            if not items:
                items = [item]
        elif kind == 10:
            # the scenario, tables and what the file says of itself are texts
            texts = [i for i, r in enumerate(items) if not isinstance(r, list) and r[0] in (ATTACHMENT, METADATA)]
            at = dice.choice(texts) if texts else at
            if not isinstance(items[at], list):
                opcode, body = items[at]
                if opcode == ATTACHMENT:
                    body = changed_attachment(body, dice)
                else:
                    body = changed_words(body, dice)
                items[at] = (opcode, body)
        else:
            other = dice.choice(seeds)[1]
            here[at] = next((r for r in dice.sample(other, len(other)) if not isinstance(r, list)), item)
    return closed(items, dice, lie=0.2 if kind in (4, 9) else 0.0)


def changed_attachment(body, dice):
    at = 16
    name = struct.unpack_from("<I", body, at)[0]
    at += 4 + name
    media = struct.unpack_from("<I", body, at)[0]
    at += 4 + media
    size = struct.unpack_from("<Q", body, at)[0]
    content = changed_words(body[at + 8 : at + 8 + size], dice)
    return body[:at] + struct.pack("<Q", len(content)) + content + bytes(4)


def mutated_bytes(data, dice):
    data = bytearray(data)
    for _ in range(dice.randrange(1, 5)):
        at = dice.randrange(len(data) or 1)
        kind = dice.randrange(7)
        if kind < 2 and data:
            data[at] ^= 1 << dice.randrange(8)
        elif kind == 2 and data:
            data[at] = dice.choice([0, 1, 9, 10, 13, 34, 39, 44, 46, 0x7F, 0x80, 0xFF])
        elif kind == 3:
            data[at : at + 8] = struct.pack("<Q", dice.choice(COUNTS))
        elif kind == 4:
            del data[at : at + dice.randrange(1, 3000)]
        elif kind == 5:
            data[at:at] = data[at : at + dice.randrange(1, 3000)]
        else:
            del data[at:]
    return bytes(data)


MCAP_COMMANDS = [
    "measures {} --json", "measures {} --filter sae-j211", "print {}", "export {} -o out.csv -f", "export {} -o out.parquet -f",
    "export {} -o out.mme -f", "plot {} -o out.svg -f", "plot {} -o out.png -f", "view {} -o out.svg -f", "report {} -o out.html -f",
    "compare {} {seed}", "compare {seed} {}", "risk {}", "convert {} --extend 0.2",
    "run {case} --resume {} --until 0.004 -o out.mcap -f -q",
]

# ---------------------------------------------------------------- other texts


def giant(kind, dice, size):
    """A text of about `size` bytes of one hostile form, for its ending."""
    forms = giants(kind, size)
    name = dice.choice(sorted(forms))
    return name, forms[name][: size + 200]


# very many of one thing in a scenario that is whole
CROWDS = {
    "surfaces": '[surfaces.q{i}]\nmaterial="foam"\nfacing="order"\npoints=[[{x},{y},0],[{x}.1,{y},0],[{x}.1,{y}.1,0]]\n',
    "fan": '[surfaces.q{i}]\nmaterial="foam"\nfacing="order"\npoints=[[0,0,5],[1,0,5],[0.{i:05},1,5]]\n',
    "touching": '[solids.q{i}]\nkind="box"\nmaterial="foam"\ncentre=[0,-0.3,0.2]\nlengths=[0.4,0.4,0.4]\n',
    "solids": '[solids.q{i}]\nkind="box"\nmaterial="foam"\ncentre=[{x},{y},0]\nlengths=[0.1,0.1,0.1]\n',
    "groups": '[solids.q{i}]\nkind="box"\nmaterial="foam"\ngroup="g"\ncentre=[{x},{y},0]\nlengths=[0.1,0.1,0.1]\n',
    "belts": '[belts.b{i}]\nsphere="pelvis"\nanchors=[[-0.15,-0.6,0.23],[-0.15,-0.1,0.23]]\nk1=1e3\n',
    "triggers": '[triggers.t{i}]\nkind="any"\nof=["t{next}"]\n',
    "markers": '[markers.k{i}]\nsegment="head"\nplace=[0,0,{i}e-5]\n',
}


def crowd(n, item):
    """A scenario of about `n` bytes with as many of these as fit, 10,000 at most."""
    whole = (ROOT / "tests/data/hand/three-point.toml").read_text() + "\n"
    count = min(10_000, (n - len(whole)) // (len(item) + 12))
    return (whole + "".join(item.format(i=i, next=i + 1, x=5 + i % 100, y=i // 100) for i in range(count))).encode()


@functools.cache
def giants(kind, n):
    toml = {
        "deep-arrays": b"a = " + b"[" * n,
        "deep-arrays-closed": b"a = " + b"[" * (n // 2) + b"]" * (n // 2),
        "deep-tables": b"a = " + b"{a=" * (n // 3),
        "deep-header": b"[" + b"a." * (n // 2) + b"a]\n",
        "deep-key": b"a." * (n // 2) + b"a = 1\n",
        "token": b"title = \"" + b"x" * n + b"\"\n",
        "bare-token": b"x" * n,
        "spaces": b" " * n + b"x",
        "newlines": b"\n" * n + b"x",
        "number": b"a = " + b"1" * n,
        "float": b"a = 0." + b"0" * n + b"1e-" + b"9" * 9,
        "exponent": b"a = 1e" + b"9" * n,
        "keys": b"".join(b"k%d=1\n" % i for i in range(n // 9)),
        "same-keys": b"k=1\n" * (n // 4),
        "tables": b"[[surfaces]]\n" * (n // 13),
        "named-tables": b"".join(b"[surfaces.s%d]\n" % i for i in range(n // 18)),
        "nested-headers": b"".join(b"[" + b".".join([b"a"] * (i % 200 + 1)) + b"]\n" for i in range(n // 200)),
        "array": b"a = [" + b"1," * (n // 2) + b"]\n",
        "array-of-tables": b"a = [" + b"{}," * (n // 3) + b"]\n",
        "escapes": b"title = \"" + b"\\u0041" * (n // 6) + b"\"\n",
        "control": b"title = \"" + b"\\u001b" * (n // 6) + b"\"\n",
        "utf8": "ä".encode() * (n // 2),
        "not-utf8": b"\xff" * n,
        "parameters": b"base=\"s.toml\"\n" + b"[[parameters]]\nname=\"a\"\npath=\"x\"\nrange={from=0,to=1}\n" * (n // 60),
        "set": b"base=\"s.toml\"\n[set]\n" + b"".join(b"\"a.b%d\" = 1\n" % i for i in range(n // 16)),
        "list": b"base=\"s.toml\"\n[design]\nkind=\"full_factorial\"\n[[parameters]]\nname=\"a\"\npath=\"path.speed\"\nvalues=["
        + b"1," * (n // 2) + b"]\n",
        "points": b"[path]\nkind=\"table\"\npoints=[" + b"[0,0]," * (n // 6) + b"]\n",
        "inline-tables": b"a = [" + b"{a=1}," * (n // 6) + b"]\n",
        "nested-inline-tables": b"a = [" + b"{a.a.a=1}," * (n // 10) + b"]\n",
        "nested-arrays": b"a = [" + b"[[]]," * (n // 5) + b"]\n",
        "tables-with-keys": b"[[a]]\nb=1\n" * (n // 10),
        "perturbations": b"base=\"s.toml\"\n[ensemble]\nmembers=3\nperturbations = ["
        + b"{path=\"belts.lap.k1\",offset=1}," * (n // 32) + b"]\n",
        "paths": b"base=\"s.toml\"\n[[parameters]]\nname=\"a\"\npaths=[" + b"\"path.x\"," * (n // 9) + b"]\nrange={from=0,to=1}\n",
        "tests": b"base=\"s.toml\"\n[fit]\n" + b"[[fit.tests]]\nfile=\"test.csv\"\n" * (n // 32),
        "comments": b"# x\n" * (n // 4),
        **{f"crowd-{name}": crowd(n, item) for name, item in CROWDS.items()},
        "quotes": b"\"\"\"" * (n // 3),
    }
    json = {
        "deep-arrays": b"[" * n,
        "deep-objects": b'{"a":' * (n // 5),
        "deep-closed": b'{"a":' * (n // 6) + b"1" + b"}" * (n // 6),
        "token": b'"' + b"x" * n + b'"',
        "number": b"1" * n,
        "keys": b"{" + b",".join(b'"k%d":1' % i for i in range(n // 10)) + b"}",
        "same-keys": b"{" + b",".join([b'"k":1'] * (n // 6)) + b"}",
        "array": b'{"a":[' + b"1," * (n // 2) + b"1]}",
        "objects": b'{"a":[' + b"{}," * (n // 3) + b"{}]}",
        "escapes": b'{"title":"' + b"\\u0041" * (n // 6) + b'"}',
        "comments": b"/*" * (n // 2),
        "spaces": b" " * n,
        "surfaces": b'{"surfaces":{' + b",".join(b'"s%d":{}' % i for i in range(n // 10)) + b"}}",
    }
    csv = {
        "columns": b",".join(b"c%d" % i for i in range(n // 8)) + b"\n",
        "columns-and-row": b",".join([b"a"] * (n // 4)) + b"\n" + b",".join([b"1"] * (n // 4)) + b"\n",
        "commas": b"t[s],ax[g]\n" + b"," * n,
        "rows": b"t[s],ax[g]\n" + b"".join(b"%d,1\n" % i for i in range(n // 8)),
        "same-rows": b"t[s],ax[g]\n" + b"0,1\n" * (n // 4),
        "fine-rows": b"t[s],ax[g]\n" + b"".join(b"%de-9,1\n" % i for i in range(n // 10)),
        "wide-time": b"t[s],ax[g]\n0,1\n1e9,1\n" + b"# \n" * (n // 3),
        "empty-rows": b"t[s],ax[g]\n" + b"\n" * n,
        "token": b"t[s],ax[g]\n" + b"1" * n + b",1\n",
        "quote": b"t[s],ax[g]\n\"" + b"x\n" * (n // 2),
        "header": b"t[" + b"s" * n + b"]\n",
        "units": b"t[" + b"s*" * (n // 2) + b"s],ax[g]\n0,1\n",
        "powers": b"t[s" + b"^9" * (n // 2) + b"],ax[g]\n0,1\n",
        "not-utf8": b"\xff" * n,
        "semicolons": b"t[s];ax[g]\n" + b"0,0;1\n" * (n // 6),
    }
    deck = {
        "cards": (b"1234567890" * 8 + b"\n") * (n // 81),
        "line": b"9" * n,
        "blank": b" " * n,
        "newlines": b"\n" * n,
        "not-utf8": b"\xff" * n,
        "repeated": (ROOT / "scenarios/decks/driver-lap-torso.dat").read_bytes() * (n // 8000 + 1),
    }
    return {"toml": toml, "json": json, "csv": csv, "dat": deck}[kind]


TEXT_COMMANDS = {
    "scenario": ["check {}", "check {} --json", "risk {}", "convert {} -o out.dat -f", "run {} --until 0.001 --no-mcap --set time.end=0.002"],
    "study": ["sweep {} -o file/out", "fit {} --to {test} -o file/out", "fit {} -o file/out"],
    "deck": ["convert {}", "convert {} --lenient", "convert {} --strict --extend 0.3", "convert {} --lenient --path {path}"],
    "table": ["risk {}", "risk {} --interval 0.1ms --z-up", "compare {seed} {}", "compare {} {test}", "plot {seed} {} -o out.svg -f",
              "convert {pathdeck} --path {}"],
}


def mutated_text(name, seeds, dice):
    data = dice.choice(seeds)
    kind = dice.randrange(10)
    if kind < 6:
        return changed_words(data, dice)
    if kind < 8:
        return mutated_bytes(data, dice)
    other = dice.choice(seeds)
    a, b = dice.randrange(len(data) + 1), dice.randrange(len(other) + 1)
    return data[:a] + other[b:]


# ---------------------------------------------------------------- running

Case = collections.namedtuple("Case", "kind name data command files")


def made(case, folder):
    """Writes the files of a case and gives the words of its command."""
    path = folder / case.name
    path.write_bytes(case.data)
    words = case.command.format(case.name, **case.files)
    return words.split(" ")


def limits():
    resource.setrlimit(resource.RLIMIT_AS, (6 << 30, 6 << 30))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    resource.setrlimit(resource.RLIMIT_CPU, (30, 30))
    os.nice(5)


def given(occupant, words, folder, most_s=600.0):
    """Exit code (negative for a signal, None out of time), the end of its words, seconds, CPU seconds, peak in kB."""
    with open(folder / "stderr", "w+b") as talk:
        began = time.monotonic()
        child = subprocess.Popen([occupant, *words], cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=talk,
                                 preexec_fn=limits)
        timer = None
        signal.signal(signal.SIGALRM, lambda *_: child.kill())
        signal.setitimer(signal.ITIMER_REAL, most_s)
        _, status, used = os.wait4(child.pid, 0)
        signal.setitimer(signal.ITIMER_REAL, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        seconds = time.monotonic() - began
        talk.seek(0)
        said = talk.read(200_000)
    code = None if child.returncode == -9 and seconds >= most_s else child.returncode
    return code, said, seconds, used.ru_utime + used.ru_stime, used.ru_maxrss


def judged(case, answer):
    code, said, seconds, cpu, peak = answer
    small = len(case.data) <= 1_100_000
    wrong = []
    if code not in (0, 1, 2):
        wrong.append(f"exit {code}")
    if any(word in said for word in PANIC) and b"panic" in said:
        wrong.append("panic")
    if code == 0 and not case.kind.startswith("large") and b"RUST_BACKTRACE" in said:
        wrong.append("backtrace")
    if peak > MOST_KB:
        wrong.append(f"{peak / 1e6:.2f} GB")
    if small and min(seconds, cpu) > MOST_S:
        wrong.append(f"{seconds:.1f} s")
    if not small and cpu > 20:
        wrong.append(f"{cpu:.1f} s (large)")
    if code in (1, 2) and not said.strip():
        wrong.append("silent")
    return wrong


def worker(task):
    occupant, base, keep, number, case = task
    folder = Path(tempfile.mkdtemp(prefix="hostile-", dir=base))
    try:
        for name in ("case.toml", "s.toml", "seed.mcap", "test.csv", "path.csv", "pathdeck.dat", "side-slope-path.csv", "side-slope-sensors.csv"):
            os.link(base / name, folder / name)
        (folder / "file").write_bytes(b"")
        if callable(case.data):
            case = case._replace(data=case.data())
        if case.kind == "folder":
            words = folder_case(case, folder, base)
        else:
            words = made(case, folder)
        answer = given(occupant, words, folder)
        wrong = judged(case, answer)
        if wrong:
            place = Path(keep) / f"{number:06d}-{case.kind}"
            place.mkdir(parents=True, exist_ok=True)
            if case.kind == "folder":
                shutil.copytree(folder / "out", place / "out", dirs_exist_ok=True)
            else:
                shutil.copy(folder / case.name, place / case.name)
            (place / "command").write_text(" ".join(words) + "\n" + ", ".join(wrong) + "\n" + answer[1][:3000].decode(errors="replace"))
        return number, case.kind, case.command, wrong, answer[0], answer[2], answer[3], answer[4], len(case.data)
    finally:
        shutil.rmtree(folder, ignore_errors=True)


FOLDER_COMMANDS = ["study report out -o page.html -f", "sweep merge out --csv", "sweep study.toml -o out -q --threads 1",
                   "study bands out", "sweep study.toml -o out -q --restart --threads 1"]


def folder_case(case, folder, base):
    shutil.copytree(base / case.files["folder"], folder / "out")
    shutil.copy(base / case.files["study"], folder / "study.toml")
    (folder / "out" / case.name).write_bytes(case.data)
    return case.command.split(" ")


# ---------------------------------------------------------------- seeds

STUDY = """base = "case.toml"
seed = 1
keep = [0]
[set]
"time.end" = "2 ms"
"output.interval" = "1 ms"
{}
"""
LHS = """[design]
kind = "latin_hypercube"
samples = 5
[[parameters]]
name = "damping"
path = "joints.*.damping"
apply = "factor"
range = { from = 0.5, to = 2, scale = "log" }
[[parameters]]
name = "friction"
path = "materials.foam.friction"
range = { from = 0.2, to = 1 }
"""
ENSEMBLE = """[ensemble]
members = 4
posture = "1 deg"
place = "5 mm"
path = "1 %"
stiffness = "2 %"
"""
FIT = """[[parameters]]
name = "friction"
path = "materials.foam.friction"
range = { from = 0.2, to = 1 }
[fit]
objective = "rms"
[[fit.channels]]
channel = "head.acceleration.x"
"""


def prepare(occupant, base):
    """Files that are whole, to be damaged."""
    def do(*words):
        done = subprocess.run([occupant, *words], cwd=base, capture_output=True)
        assert done.returncode == 0, (words, done.stderr.decode())

    scenarios = ROOT / "scenarios"
    for name in ("side-slope-path.csv", "side-slope-sensors.csv"):
        shutil.copy(scenarios / name, base / name)
    shutil.copy(scenarios / "decks/driver-path-from-disk.csv", base / "path.csv")
    shutil.copy(scenarios / "decks/driver-path-from-disk.dat", base / "pathdeck.dat")
    do("new", "case.toml")
    shutil.copy(base / "case.toml", base / "s.toml")
    for name, set_ in {
        "seed.mcap": ("time.end=0.003", "output.interval='1 ms'"),
        "fine.mcap": ("time.end=0.006", "output.interval='0.1 ms'"),
    }.items():
        do("run", "case.toml", "-o", name, "-q", *(w for s in set_ for w in ("--set", s)))
    do("run", str(scenarios / "side-slope.toml"), "-o", "slope.mcap", "-q", "--set", "time.end=0.003", "--set", "output.interval='1 ms'")
    do("run", "case.toml", "--resume", "seed.mcap", "--until", "0.005", "-o", "resumed.mcap", "-q", "--set", "time.end=0.003", "--set", "output.interval='1 ms'")
    do("convert", str(scenarios / "decks/driver-lap-torso.dat"), "-o", "deck.toml", "-q")
    do("run", "deck.toml", "-o", "deck.mcap", "-q", "--until", "0.004")
    do("export", "seed.mcap", "-o", "test.csv")
    for name, rest in {"lhs": LHS, "ens": ENSEMBLE}.items():
        (base / f"{name}.toml").write_text(STUDY.format(rest))
        do("sweep", f"{name}.toml", "-o", name, "-q", "--csv")
    mcaps = []
    for name in ("seed", "fine", "slope", "resumed", "deck"):
        data = (base / f"{name}.mcap").read_bytes()
        items = opened(data)
        if name == "fine":
            # cut off, as a killed run leaves it
            mcaps.append((data[: len(data) * 2 // 3], items[: len(items) // 2]))
        mcaps.append((data, items))
    read = lambda paths: [p.read_bytes() for p in paths]
    studies = [STUDY.format(r).encode() for r in (LHS, ENSEMBLE, FIT)]
    studies += [s.replace(b"../cart", b"case").replace(b"case-lap-torso", b"case") for s in read(sorted((scenarios / "studies").glob("*.toml")))]
    studies += [s.replace(b"../../cart-lap-torso", b"case") for s in read(sorted((scenarios / "studies/fit-cart").glob("*.toml")))]
    texts = {
        "scenario": ("toml", read(sorted(scenarios.glob("*.toml")) + [base / "case.toml", base / "deck.toml"])),
        "study": ("toml", studies),
        "deck": ("dat", read(sorted((scenarios / "decks").glob("*.dat")))),
        "table": ("csv", read([base / "test.csv", base / "path.csv", base / "side-slope-sensors.csv", base / "side-slope-path.csv"])),
    }
    return mcaps, texts


def other_cases(texts, base, dice, count):
    files = {"seed": "seed.mcap", "test": "test.csv", "path": "path.csv", "pathdeck": "pathdeck.dat", "case": "case.toml"}
    folders = [(f, p.relative_to(base / f)) for f in ("lhs", "ens") for p in sorted((base / f).rglob("*"))
               if p.is_file() and not p.name.endswith((".lock", ".parquet"))]
    for number in range(count):
        kind = dice.choice(["scenario", "scenario", "study", "study", "deck", "table", "folder", "folder"])
        giant_here = dice.random() < 0.08
        if kind == "folder":
            folder, name = dice.choice(folders)
            data = (base / folder / name).read_bytes()
            how = dice.randrange(3)
            data = changed_words(data, dice) if how == 0 else mutated_bytes(data, dice) if how == 1 else changed_json(data, dice)
            if giant_here:
                data = giant(dice.choice(["json", "csv"]), dice, 1_000_000)[1]
            yield Case(kind, str(name), data, dice.choice(FOLDER_COMMANDS), {"folder": folder, "study": f"{folder}.toml"})
            continue
        ending, seeds = texts[kind]
        if giant_here:
            if ending == "toml" and dice.random() < 0.4:
                ending = "json"
            data = giant(ending, dice, 1_000_000)[1]
        else:
            data = mutated_text(kind, seeds, dice)
        yield Case(kind, f"mutated.{ending}", data, dice.choice(TEXT_COMMANDS[kind]), files)


def changed_json(data, dice):
    """A number or a word of a JSON text replaced."""
    found = list(re.finditer(rb'-?[0-9]+(\.[0-9]+)?|"[^"]*"|null|true|false', data))
    for _ in range(dice.randrange(1, 3)):
        if not found:
            break
        m = dice.choice(found)
        put = dice.choice([b"0", b"-1", b"1e308", b"18446744073709551615", b"1e400", b'""', b"null", b"[]", b"{}", b"[" * 300, b'"../../x"'])
        data = data[: m.start()] + put + data[m.end() :]
        found = list(re.finditer(rb'-?[0-9]+(\.[0-9]+)?|"[^"]*"|null|true|false', data))
    return data


def mcap_cases(mcaps, dice, count):
    files = {"seed": "seed.mcap", "case": "case.toml"}
    for _ in range(count):
        yield Case("mcap", "mutated.mcap", mutated_mcap(mcaps, dice), dice.choice(MCAP_COMMANDS), files)


CHANNEL = 0x04


def checkpoint_message(items):
    """The number of the channel of checkpoints and one of its messages."""
    flat = [r for i in items for r in (i if isinstance(i, list) else [i])]
    number = next(body[:2] for op, body in flat if op == CHANNEL and b"/checkpoint" in body)
    return number, next(body for op, body in flat if op == MESSAGE and body[:2] == number)


def large_mcaps(items, size):
    """Files of about `size` bytes that ask for as much memory as they can."""
    head = [i for i in items if not isinstance(i, list) and i[0] not in (DATA_END, FOOTER, 0x0B, 0x0A, 0x0D, 0x08, 0x0E)]
    chunks = [i for i in items if isinstance(i, list)]
    channels = [r for i in chunks for r in i if r[0] in (3, CHANNEL)]
    dice = random.Random(1)
    start = closed([*head, channels], dice)[:-8]
    number, whole = checkpoint_message(items)
    empty = lambda i: record(MESSAGE, number + bytes(20) + b"\x10" + varint(i))
    full = lambda i: record(MESSAGE, whole[:31] + b"\x10" + varint(i) + whole[33:])
    attached = lambda name, content: record(ATTACHMENT, bytes(16) + text(name) + text("") + struct.pack("<Q", len(content)) + content + bytes(4))
    spaces = lambda much: lz4_repeated(b" " * 64, much)

    def in_chunks(unit, each):
        """Chunks of this content, packed 255-fold, up to the size."""
        content_frame, much = lz4_repeated(unit, 200 << 20)
        made = chunk(b"", b"lz4", much, 0, content_frame)
        return made * max(1, each // len(made))

    def attachments():
        out, i = b"", 0
        while len(out) < size:
            frame, much = spaces(120 << 20)
            # an attachment that reaches to the end of the chunk
            body = bytes(16) + text("a%d" % i) + text("")
            frame_head = lz4_stored(record(ATTACHMENT, b"")[:1] + struct.pack("<Q", len(body) + 8 + much + 4) + body + struct.pack("<Q", much))[:-4]
            tail = struct.pack("<I", 4 | 1 << 31) + bytes(4) + bytes(4)
            packed = frame_head + frame[7:-4] + tail
            out += chunk(b"", b"lz4", 9 + len(body) + 8 + much + 4, 0, packed)
            i += 1
        return out

    toml = lambda form, n: giants("toml", n)[form]
    yield "empty checkpoints", start + b"".join(empty(i) for i in range(1, size // 35))
    yield "whole checkpoints", start + b"".join(full(i) for i in range(1, size // (len(whole) + 12)))
    yield "attachments in chunks", start + attachments()
    yield "zeros in chunks", start + in_chunks(bytes(64), size)
    yield "messages in chunks", start + in_chunks(record(MESSAGE, b"\xff\xff" + bytes(20)), size)
    yield "metadata in chunks", start + in_chunks(record(METADATA, text("occupant.run") + text(b"")), size)
    yield "metadata", start + record(METADATA, text("occupant.run") + text(b"".join(text(b"%x" % i) + text("") for i in range(size // 14))))
    yield "attachments", start + b"".join(attached("%x" % i, b"") for i in range(size // 50))
    yield "one attachment", start + attached("big", bytes(size))
    yield "indices", start + record(MESSAGE, number + bytes(20) + b"\x10\x01" + varint(11 << 3 | 2) + varint(size) + bytes(size))
    yield "channels", start + b"".join(record(CHANNEL, struct.pack("<HH", i % 65536, 0) + text("/c") + text("") + text(b"")) for i in range(size // 32))
    for form in ("surfaces", "tables", "named-tables", "keys", "array", "array-of-tables", "points", "deep-key", "escapes"):
        if form != "surfaces":
            rest = b"".join(closed([i for i in items if isinstance(i, list)], dice)[8:-8] for _ in range(1))
            yield f"scenario of {form}", start + attached("resolved.toml", toml(form, size)) + rest


LARGE_JOURNAL = {
    "cells": lambda n: b'{"index":0,"status":"completed","reason":"","cells":[' + b"1," * (n // 2) + b'1],"wall_time_s":0,"kernel":""}\n',
    "nulls": lambda n: b'{"index":0,"status":"completed","reason":"","cells":[' + b"null," * (n // 5) + b'1],"wall_time_s":0,"kernel":""}\n',
    "rows": lambda n: b'{"index":0,"status":"completed","reason":"","cells":[],"wall_time_s":0,"kernel":""}\n' * (n // 80),
    "reason": lambda n: b'{"index":0,"status":"completed","reason":"' + b"\\n" * (n // 2) + b'","cells":[],"wall_time_s":0,"kernel":""}\n',
    "lines": lambda n: b"\n" * n,
}


def large_cases(mcaps, base, sizes):
    """Hostile files of each size, and what each takes."""
    files = {"seed": "seed.mcap", "test": "test.csv", "path": "path.csv", "pathdeck": "pathdeck.dat", "case": "case.toml"}
    dice = random.Random(1)
    items = mcaps[0][1]
    for size in sizes:
        for what, data in large_mcaps(items, size):
            for command in ("measures {} --json", "report {} -o out.html -f", "run {case} --resume {} --until 0.004 -o out.mcap -f -q"):
                yield Case(f"large mcap {what}", "large.mcap", data, command, files)
        for kind, ending, most in (("scenario", "toml", 2), ("scenario", "json", 2), ("study", "toml", 2), ("deck", "dat", 4), ("table", "csv", 32)):
            n = min(size, most * 1_000_000 - 300)
            for form in sorted(giants(ending, n)):
                for command in TEXT_COMMANDS[kind][:2]:
                    yield Case(f"large {kind} {form}", f"large.{ending}", giants(ending, n)[form][: n + 200], command, files)
            giants.cache_clear()
        piece = next((base / "lhs/journal").glob("*.rows"))
        lines = piece.read_bytes().split(b"\n")
        for form, make in LARGE_JOURNAL.items():
            data = lines[0] + b"\n" + b"".join(b'{"crc32":"%08x","is":%s}\n' % (zlib.crc32(row), row) for row in make(size).split(b"\n")[:-1])
            for command in FOLDER_COMMANDS[:3]:
                yield Case("folder", f"journal/{piece.name}", data, command, {"folder": "lhs", "study": "lhs.toml"})
        for name in ("sweep.json", "SHA256SUMS"):
            for form in ("keys", "array", "objects", "deep-closed", "token", "escapes"):
                yield Case("folder", name, giants("json", size)[form], "study report out -o page.html -f", {"folder": "lhs", "study": "lhs.toml"})


def run_all(occupant, base, keep, cases, jobs):
    ends, worst_s, worst_kb, findings, began = collections.Counter(), (0, ""), (0, ""), 0, time.monotonic()
    tasks = ((occupant, base, keep, number, case) for number, case in enumerate(cases))
    with multiprocessing.Pool(jobs, maxtasksperchild=2000) as pool:
        for number, kind, command, wrong, code, seconds, cpu, peak, size in pool.imap_unordered(worker, tasks, chunksize=8):
            ends[code] += 1
            worst_s = max(worst_s, (round(cpu, 2), f"{kind} {number} {command} {size}"))
            worst_kb = max(worst_kb, (peak, f"{kind} {number} {command} {size}"))
            if wrong:
                findings += 1
                print(f"FINDING {number} {kind} ({size} bytes): {', '.join(wrong)}: {command}", flush=True)
    total = sum(ends.values())
    print(f"{total} inputs in {time.monotonic() - began:.0f} s, exit codes {dict(ends)}, {findings} findings")
    print(f"longest {worst_s}, largest {worst_kb}")
    return findings


def main():
    wants = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    wants.add_argument("occupant", type=lambda p: str(Path(p).resolve()))
    wants.add_argument("--mcap", type=int, default=0)
    wants.add_argument("--others", type=int, default=0)
    wants.add_argument("--large", type=int, nargs="*", default=[], metavar="MB")
    wants.add_argument("--seed", type=int, default=1)
    wants.add_argument("--jobs", type=int, default=2)
    wants.add_argument("--keep", default="found")
    asked = wants.parse_args()
    findings = 0
    with tempfile.TemporaryDirectory() as base:
        base = Path(base)
        mcaps, texts = prepare(asked.occupant, base)
        if asked.mcap:
            dice = random.Random(asked.seed)
            findings += run_all(asked.occupant, base, asked.keep + "/mcap", mcap_cases(mcaps, dice, asked.mcap), asked.jobs)
        if asked.others:
            dice = random.Random(asked.seed)
            findings += run_all(asked.occupant, base, asked.keep + "/others", other_cases(texts, base, dice, asked.others), asked.jobs)
        if asked.large:
            sizes = [mb * 1_000_000 for mb in asked.large]
            findings += run_all(asked.occupant, base, asked.keep + "/large", large_cases(mcaps, base, sizes), 1)
    sys.exit(findings > 0)


if __name__ == "__main__":
    main()
