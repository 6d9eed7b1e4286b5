"""The gallery: every shipped scenario with a picture of its run and its key figures.

    python3 docs/gallery.py                       checks that gallery.md has every scenario, its command and its picture
    python3 docs/gallery.py OCCUPANT [NAME...]    runs the scenarios (all, or those named), draws the pictures, writes the
                                                  figures into gallery.md; needs Pillow

What is drawn and told of a run stands in gallery.md in a comment: `<!-- NAME: VIEW, TIMES; FIGURE FIGURE ... -->`. What
stands below it, up to a blank line, is written by this program.
"""

import json
import re
import subprocess
import sys
import tempfile
from fnmatch import fnmatch
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs/gallery.md"
PICTURES = ROOT / "docs/gallery"
ENTRY = re.compile(r"^<!-- ([a-z0-9/-]+): (side|top|front), ([^;]+); ([^>]+) -->\n((?:[^\n]+\n)*)", re.M)
LARGEST, LARGEST_TOGETHER, WIDTH, COLOURS = 40_000, 1_500_000, 700, 16
G = 9.80665
# figure: label, its unit, how many of it are one of SI
FIGURES = {
    "hic15": ("HIC15", "", 1),
    "nij": ("Nij", "", 1),
    "bric": ("BrIC", "", 1),
    "head_peak": ("head, peak", "g", 1 / G),
    "head_3ms_cumulative": ("head, 3 ms", "g", 1 / G),
    "chest_peak": ("chest, peak", "g", 1 / G),
    "chest_3ms_cumulative": ("chest, 3 ms", "g", 1 / G),
    "rib_deflection": ("deepest rib", "mm", 1000),
    "rib_viscous_criterion": ("VC of a rib", "m/s", 1),
    "abdomen_force": ("abdomen", "kN", 1e-3),
    "pelvis_force": ("pelvis", "kN", 1e-3),
    "pelvis_peak": ("pelvis, peak", "g", 1 / G),
    "nic": ("NIC", "m²/s²", 1),
    "nkm": ("Nkm", "", 1),
    "t1_acceleration": ("T1", "g", 1 / G),
    "neck_flexion": ("neck flexion", "N·m", 1),
    "right_femur": ("right femur", "kN", 1e-3),
    "left_femur": ("left femur", "kN", 1e-3),
}
EXCURSIONS = {"forward_m": "head forward", "right_m": "head to the right", "left_m": "head to the left"}


def picture_of(name):
    """Where the picture of a scenario is."""
    return PICTURES / f"{name.replace('/', '-')}.png"


def shown(value):
    """A number with two digits, or all that stand before its point."""
    return f"{value:.0f}" if abs(value) >= 100 else f"{value:#.2g}".rstrip(".")


def own(table, occupant):
    """What a table of names has of an occupant, or of the only one."""
    return table[occupant] if occupant in table else next(iter(table.values()))


def told(name, body, run, occupant):
    """One figure of one body: its words, with a mark where it is not to be quoted."""
    if name == "ejection":
        return f"ejection {own(run['ejections'], occupant)['degree']}"
    if name == "throw":
        return f"lands {shown(own(run['throws'], occupant)['landing']['distance_m'])} m on"
    if name in EXCURSIONS:
        label, unit, factor = EXCURSIONS[name], "mm", 1000
        value, name = body["head_excursion"][name], "head_excursion"
    else:
        label, unit, factor = FIGURES[name]
        value = next(m["value"] for m in body["measures"] if m["name"] == name)
    full = f"{occupant}.{name}" if occupant else name
    marked = any(fnmatch(full, pattern) for caveat in run["caveats"] for pattern in caveat["figures"])
    return f"{label} {shown(value * factor)}{'!' if marked else ''} {unit}".rstrip()


def figures(run, names):
    """The figures of a run, a line for each of its people."""
    bodies = {run.get("occupant"): run} | run.get("others", {})
    lines = [f"**{' · '.join(told(figure, body, run, name) for figure in names)}**" for name, body in bodies.items()]
    if len(lines) == 1:
        return lines[0] + "\n"
    return "".join(f"- {name}: {line}\n" for name, line in zip(bodies, lines))


def draw(occupant, result, view, times, picture):
    """A strip of the run, small enough for a page."""
    from PIL import Image

    large = result.with_suffix(".png")
    options = ["--views", view, "--times", times, "--force", "--output", large]
    subprocess.run([occupant, "view", result, *options], check=True, capture_output=True)
    image = Image.open(large).convert("RGB")
    width = min(WIDTH, image.width)
    image = image.resize((width, round(image.height * width / image.width)), Image.Resampling.LANCZOS)
    # the colours of body, belts and forces are few beside the greys of the car: the usual choice would lose them
    image.quantize(COLOURS, method=Image.Quantize.MAXCOVERAGE).save(picture, optimize=True)


def make(occupant, wanted):
    """Runs, draws and writes what the page asks for."""
    PICTURES.mkdir(exist_ok=True)

    for name, view, times, names, _ in ENTRY.findall(PAGE.read_text()):
        if wanted and name not in wanted:
            continue
        with tempfile.TemporaryDirectory() as folder:
            result = Path(folder) / "run.mcap"
            command = [occupant, "run", ROOT / f"scenarios/{name}.toml", "--json", "--output", result]
            run = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
            draw(occupant, result, view, times, picture_of(name))
        text = f"<!-- {name}: {view}, {times}; {names} -->\n{figures(run, names.split())}"
        PAGE.write_text(ENTRY.sub(lambda match: text if match[1] == name else match.group(), PAGE.read_text()))
        print(f"drawn: {name}", flush=True)


def check():
    """What the page lacks."""
    page = PAGE.read_text()
    there = {match[1] for match in ENTRY.finditer(page)}
    scenarios = ROOT / "scenarios"
    faults = [f"gallery.md lacks scenarios/{path.name}" for path in scenarios.glob("*.toml") if path.stem not in there]
    total = 0
    for name in sorted(there):
        picture = picture_of(name)
        size = picture.stat().st_size if picture.is_file() else 0
        total += size
        if not (scenarios / f"{name}.toml").is_file():
            faults.append(f"gallery.md has {name}, which is not shipped")
        if not 0 < size <= LARGEST:
            faults.append(f"{picture.relative_to(ROOT)}: {size} bytes, expected 1 to {LARGEST}")
        for needed in (f"`occupant run scenarios/{name}.toml`", f"](gallery/{picture.name})"):
            if needed not in page:
                faults.append(f"gallery.md lacks {needed}")
    if total > LARGEST_TOGETHER:
        faults.append(f"docs/gallery: {total} bytes, expected at most {LARGEST_TOGETHER}")
    return faults


if __name__ == "__main__":
    if len(sys.argv) > 1:
        make(Path(sys.argv[1]).resolve(), set(sys.argv[2:]))
    found = check()
    print("\n".join(found), file=sys.stderr if found else sys.stdout, end="\n" if found else "")
    sys.exit(bool(found))
