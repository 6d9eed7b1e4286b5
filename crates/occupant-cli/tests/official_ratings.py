"""Compares ratings of Euro NCAP 2026 with the calculator of Euro NCAP.

    python3 crates/occupant-cli/tests/official_ratings.py OCCUPANT [FILLINGS]

It fills the criteria of the calculator's own template at random, blanks and values at the limits among them, scores each
filling with the calculator and with `occupant measures --rating NAME --values FILE --json`, and compares the percentage and
points of every region, the points and caps of every dummy, and the points of every test. Without the package
`euroncap-rating-2026` (pip install euroncap-rating-2026==5.4.9) it says so and passes.
"""

import contextlib
import csv
import io
import json
import logging
import pathlib
import random
import subprocess
import sys
import tempfile

RATINGS = {
    "euro-ncap-2026-frontal": ["CP - Frontal Offset", "CP - Frontal FW", "CP - Frontal Sled & VT"],
    "euro-ncap-2026-side": ["CP - Side MDB", "CP - Side Pole"],
}
HEADS = ["Loadcase", "Seat position", "Dummy", "Body region", "Criteria", "Value"]
SEED = 20260101


def value(row, chance, data):
    """A random value of a criterion: low, between its limits, exactly at one of them or just beside, or none."""
    if chance.random() < data["blanks"]:
        return None
    if row["Criteria"] == "Direct contact with pole":
        return chance.choice([0.0, 0.0, 0.0, 1.0])
    known = [row.get(name) for name in ("HPL", "LPL", "Capping")]
    known = [float(limit) for limit in known if limit is not None and limit == limit]
    steps = {"DAMAGE": 0.42, "Shoulder belt load": 6.0, "Shoulder load": 3.0, "Viscous Criterion": 1.0}
    known = known or [steps.get(row["Criteria"], 100.0)]
    low, high = min(known), max(known)
    kind = chance.random()
    if kind < data["mild"]:
        return round(chance.uniform(0.0, low), chance.choice([1, 2, 3, 6]))
    if kind < data["mild"] + 0.15:
        third = low + (high - low) * chance.choice([0, 1, 2, 3]) / 3
        return round(third + chance.choice([-0.01, -0.005, 0.0, 0.004999, 0.005, 0.01]), 6)
    return round(chance.uniform(0.6 * low, 1.25 * high), chance.choice([1, 2, 3, 6]))


def fill(sheets, rating, chance):
    """A filling of the sheets: copies with values, and its rows for `occupant`."""
    data = {"blanks": chance.choice([0.0, 0.0, 0.02, 0.3]), "mild": chance.choice([0.3, 0.8, 0.97])}
    filled, rows = {}, []
    for name in RATINGS[rating]:
        sheet = sheets[name].copy()
        sheet["Value"] = sheet["Value"].astype(object)
        place = [""] * 4
        for index, row in sheet.iterrows():
            place = [row[head] if row[head] == row[head] and row[head] else old for head, old in zip(HEADS, place)]
            found = value(row, chance, data)
            sheet.at[index, "Value"] = float("nan") if found is None else found
            rows.append([*place, row["Criteria"], "" if found is None else repr(found)])
        filled[name] = sheet
    regions = sheets["CP - Body region scores"].copy()
    regions["Inspection [%]"] = regions["Inspection [%]"].astype(object)
    place = {}
    known = {tuple(row[:4]) for row in rows}
    for index, row in regions.iterrows():
        for head in ("Loadcase", "Seat position", "Dummy"):
            if row[head] == row[head] and row[head]:
                place[head] = row[head]
        taken = chance.choice([0.0, 0.0, 0.0, 10.0, 25.125])
        regions.at[index, "Inspection [%]"] = taken
        key = (place["Loadcase"], place["Seat position"], place["Dummy"], row["Body region"])
        if key in known or (key[0].startswith("Virtual") and rating.endswith("frontal")):
            rows.append([*key, "Inspection [%]", repr(taken)])
    return filled, regions, rows


def official(calculator, sheets, filled, regions):
    """Percentages and points of regions, points and caps of dummies, points of tests, by their places."""
    data_loader = calculator
    frames = {**sheets, **filled, "CP - Body region scores": regions}
    with contextlib.redirect_stdout(io.StringIO()):
        cases, inspections = data_loader.load_data(frames)
        _, _, tests, _ = data_loader.get_score(cases, inspections)
    told = {("test", name): points for name, points in tests.items()}
    for name in filled:
        for case in cases[name]:
            for seat in case.seats:
                place = (case.name, seat.name, seat.dummy.name)
                told[place] = (seat.dummy.get_score(), bool(seat.dummy.get_capping()))
                for region in seat.dummy.body_region_list:
                    told[(*place, region.name)] = (region.get_bodyregion_score(), region.get_score())
    return told


def ours(occupant, rating, rows, folder):
    """The same from `occupant`."""
    file = folder / "values.csv"
    with file.open("w", newline="", encoding="utf-8") as target:
        csv.writer(target).writerows([HEADS, *rows])
    command = [occupant, "measures", "--rating", rating, "--values", str(file), "--json"]
    answer = json.loads(subprocess.run(command, capture_output=True, check=True, text=True).stdout)
    told = {}
    for test in answer["results"][0]["tests"]:
        told[("test", test["test"])] = test["result"]["now"]
        for seat in test["occupants"]:
            place = (seat["case"], seat["seat"], seat["dummy"])
            told[place] = (seat["result"]["now"], seat["capped"])
            for region in seat["regions"]:
                told[(*place, region["region"])] = (region["worth"], region["result"]["now"])
    return told


def same(a, b):
    if isinstance(a, tuple):
        return all(same(x, y) for x, y in zip(a, b))
    if isinstance(a, bool) or a is None or b is None:
        return a == b
    return abs(a - b) <= 1e-9


def main():
    occupant = sys.argv[1]
    fillings = int(sys.argv[2]) if len(sys.argv) > 2 else 1000
    try:
        import euroncap_rating_2026
        from euroncap_rating_2026 import common
        from euroncap_rating_2026.crash_protection import data_loader
    except ImportError:
        print("skipped: the package euroncap-rating-2026 is not installed")
        return
    logging.disable(logging.CRITICAL)
    root = pathlib.Path(euroncap_rating_2026.__file__).parent
    template = next(p for p in (root.parent / "data" / "cp_template.xlsx", root / "data" / "cp_template.xlsx") if p.exists())
    sheets = common.read_excel_file_to_dfs(str(template))
    chance = random.Random(SEED)
    compared = 0
    with tempfile.TemporaryDirectory() as folder:
        for filling in range(fillings):
            for rating, names in RATINGS.items():
                keep = [*names, "Input parameters", "Test Scores", "CP - Dummy Scores", "CP - Body region scores"]
                own = {name: sheets[name] for name in keep}
                filled, regions, rows = fill(own, rating, chance)
                theirs = official(data_loader, own, filled, regions)
                found = ours(occupant, rating, rows, pathlib.Path(folder))
                for place, expected in theirs.items():
                    if place not in found:
                        raise SystemExit(f"filling {filling}: {place} is missing")
                    if not same(expected, found[place]):
                        raise SystemExit(f"filling {filling}: {place}: {expected} of the calculator, {found[place]} of occupant")
                compared += len(theirs)
    print(f"{fillings} fillings of {len(RATINGS)} ratings, {compared} results: all equal")


main()
