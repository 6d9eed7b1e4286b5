"""Compares ratings of Euro NCAP 2026 with the calculator of Euro NCAP.

    python3 crates/occupant-cli/tests/official_ratings.py OCCUPANT [FILLINGS]

It fills the criteria of the calculator's own template at random, blanks and values at the limits among them, scores each
filling with the calculator and with `occupant measures --rating NAME --values FILE --json`, and compares the percentage and
points of every region, the points and caps of every dummy, the points of every test and their sum. On the far side the
calculator has one dummy where the rating has the worst of several, and passes over a blank among them, which counts nothing in
the rating: there, all of them are blank or none. Without the package `euroncap-rating-2026`
(pip install euroncap-rating-2026==5.4.9) it says so and passes.
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
    "euro-ncap-2026-side": ["CP - Side MDB", "CP - Side Pole", "CP - Side Farside"],
}
HEADS = ["Loadcase", "Seat position", "Dummy", "Body region", "Criteria", "Value"]
COLOURS = ["Green", "Yellow", "Orange", "Red", "Capping"]
# values from which modifiers take something off
STEPS = {
    "DAMAGE": 0.42,
    "Shoulder belt load": 6.0,
    "Shoulder load": 3.0,
    "Viscous Criterion": 1.0,
    "Fpubic symphysis": 2.8,
    "Fy lumbar": 2.0,
    "Fz lumbar": 3.5,
    "Mx lumbar": 120.0,
}
FAR_SIDE = "CP - Side Farside"
SEED = 20260101


def shared(place):
    """The dummy of the calculator that stands for several of the far side, or the same place."""
    case, seat, dummy = place
    if dummy == "WorldSID-50-Farside":
        return (case, "Driver and Front Passenger", dummy)
    if case.startswith("Robustness"):
        return ("Robustness-AEMDB" if "AEMDB" in case else "Robustness-Pole", seat, dummy)
    return (case, seat, dummy)


def value(row, chance, data):
    """A random value of a criterion: low, between its limits, exactly at one of them or just beside, or none."""
    if chance.random() < data["blanks"]:
        return None
    if row["Criteria"] == "Farside excursion":
        return chance.choices(COLOURS, data["colours"])[0]
    if row["Criteria"] == "Direct contact with pole":
        return chance.choice([0.0, 0.0, 0.0, 1.0])
    known = [row.get(name) for name in ("HPL", "LPL", "Capping")]
    known = [float(limit) for limit in known if limit is not None and limit == limit]
    known = known or [STEPS.get(row["Criteria"], 100.0)]
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
    data = {"blanks": chance.choice([0.0, 0.0, 0.02, 0.3]), "mild": chance.choice([0.3, 0.8, 0.97, 0.995])}
    data["colours"] = chance.choice([[1, 1, 1, 1, 1], [6, 5, 3, 1, 0], [0, 1, 3, 3, 0]])
    filled, rows, blank = {}, [], {}
    for name in RATINGS[rating]:
        sheet = sheets[name].copy()
        sheet["Value"] = sheet["Value"].astype(object)
        place = [""] * 4
        for index, row in sheet.iterrows():
            place = [row[head] if row[head] == row[head] and row[head] else old for head, old in zip(HEADS, place)]
            found = value(row, chance, data)
            case = tuple(place[:3])
            if name == FAR_SIDE and (shared(case) != case):
                is_blank = blank.setdefault(shared(case), chance.random() < data["blanks"])
                while not is_blank and found is None:
                    found = value(row, chance, data)
                found = None if is_blank else found
            sheet.at[index, "Value"] = float("nan") if found is None else found
            rows.append([*place, row["Criteria"], "" if found is None else found])
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
        keys = [own for own in sorted(known) if own == key or (*shared(own[:3]), own[3]) == key]
        if key[0].startswith("Virtual") and rating.endswith("frontal"):
            keys = [key]
        rows.extend([*own, "Inspection [%]", taken] for own in keys)
    return filled, regions, rows


def answer(sheets, chance):
    """Random answers to the questions on the car: the sheet with them, and its rows for `occupant`."""
    sheet = sheets["Input parameters"].copy()
    sheet["Value"] = [chance.choice(["Yes", "No"]) for _ in sheet.index]
    return sheet, [["Input parameter", "Value"], *sheet[["Input parameter", "Value"]].values.tolist()]


def official(calculator, sheets, filled, regions):
    """Percentages and points of regions, points and caps of dummies, points of tests, by their places."""
    data_loader = calculator
    frames = {**sheets, **filled, "CP - Body region scores": regions}
    with contextlib.redirect_stdout(io.StringIO()):
        cases, inspections = data_loader.load_data(frames)
        _, _, tests, _ = data_loader.get_score(cases, inspections)
    told = {("test", name): points for name, points in tests.items()}
    told["sum"] = sum(tests.values())
    for name in filled:
        for case in cases[name]:
            for seat in case.seats:
                place = (case.name, seat.name, seat.dummy.name)
                told[place] = (seat.dummy.get_score(), bool(seat.dummy.get_capping()))
                for region in seat.dummy.body_region_list:
                    told[(*place, region.name)] = (region.get_bodyregion_score(), region.get_score())
                if name == FAR_SIDE:
                    # a blank colour has no score; regions that only cap have none either
                    known = [place] + [(*place, region.name) for region in seat.dummy.body_region_list]
                    told.update({own: tuple(one or 0.0 for one in told[own]) for own in known})
    return told


def ours(occupant, rating, rows, answers, folder):
    """The same from `occupant`."""
    file = folder / "values.csv"
    with file.open("w", newline="", encoding="utf-8") as target:
        csv.writer(target).writerows([*answers, HEADS, *rows])
    command = [occupant, "measures", "--rating", rating, "--values", str(file), "--json"]
    answer = json.loads(subprocess.run(command, capture_output=True, check=True, text=True).stdout)
    told = {"sum": answer["results"][0]["sum"]["now"]}
    for test in answer["results"][0]["tests"]:
        told[("test", test["test"])] = test["result"]["now"]
        for seat in test["occupants"]:
            place = (seat["case"], seat["seat"], seat["dummy"])
            told[place] = (seat["result"]["now"], seat["capped"])
            for region in seat["regions"]:
                told[(*place, region["region"])] = (region["worth"], region["result"]["now"])
            if test["test"] == "Farside":
                of_several(told, place, [region["region"] for region in seat["regions"]])
    return told


def of_several(told, place, regions):
    """The worst of several on the far side, under the name that they have together."""
    for own in [()] + [(region,) for region in regions]:
        one = tuple(value or 0.0 for value in told[(*place, *own)])
        known = tuple(value or 0.0 for value in told.get((*shared(place), *own), one))
        told[(*shared(place), *own)] = (min(known[0], one[0]), min(known[1], one[1]) if own else known[1] or one[1])


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
                own["Input parameters"], answers = answer(own, chance)
                theirs = official(data_loader, own, filled, regions)
                found = ours(occupant, rating, rows, answers, pathlib.Path(folder))
                for place, expected in theirs.items():
                    if place not in found:
                        raise SystemExit(f"filling {filling}: {place} is missing")
                    if not same(expected, found[place]):
                        raise SystemExit(f"filling {filling}: {place}: {expected} of the calculator, {found[place]} of occupant")
                compared += len(theirs)
    print(f"{fillings} fillings of {len(RATINGS)} ratings, {compared} results: all equal")


main()
