#!/usr/bin/env python3
"""Holds the derivatives of restraint scenarios against the secants of full runs at a hundredth of the tolerances.

    python3 tests/sensitivity_pairs.py OCCUPANT [SCENARIO ...]

OCCUPANT is the command (built with --release). One line a pair of measure and parameter: the derivative, the mean of the
secants to both sides at each change, or the secant to the one side that the scenario allows, and the verdict. The exit code is 1
if a derivative that is said to hold is more than 2 % from a mean. It takes some minutes.
"""

import json
import subprocess
import sys
from pathlib import Path

HOLDS = 0.02
MEASURES = "hic15,head.peak,chest.peak,chest.three_ms_cumulative"
BELT = ["limiters.torsion_bar.force[1]", "limiters.torsion_bar.payout[1]", "retractors.driver.pretensioner.delay",
        "retractors.driver.pretensioner.stall_force"]
BAG = ["bags.driver.delay", "bags.driver.vents[0].area"]
PARAMETERS = {"three-point": BELT, "airbag-driver": BELT + BAG, "column-driver": BELT + BAG}


def mean(change):
    """The mean of the secants of a change that there are."""
    slopes = [change[side] for side in ("secant_below", "secant_above") if change[side] is not None]
    return sum(slopes) / len(slopes) if slopes else None, len(slopes)


def pairs(occupant, scenario):
    """All pairs of a scenario, each parameter by itself: one that is refused says so."""
    for parameter in PARAMETERS[scenario]:
        path = Path(__file__).parent.parent / "scenarios" / f"{scenario}.toml"
        words = [occupant, "sensitivity", path, "--to", MEASURES, "--of", parameter, "--json"]
        ran = subprocess.run(words, capture_output=True, text=True, check=False)
        if ran.returncode != 0:
            print(f"| {scenario} | | `{parameter}` | refused: {ran.stderr.strip().splitlines()[-1]} | | |")
            continue
        yield from json.loads(ran.stdout)["sensitivities"]


def main(occupant, scenarios):
    wrong = 0
    print("| scenario | measure | parameter | derivative | finite changes | verdict |\n|---|---|---|---|---|---|")
    for scenario in scenarios or PARAMETERS:
        for pair in pairs(occupant, scenario):
            derivative, verdict = pair["derivative"], pair["verdict"]
            means = [mean(change) for change in pair["changes"]]
            far = [abs(slope - derivative) > HOLDS * abs(derivative) for slope, sides in means if sides == 2]
            is_wrong = verdict == "holds" and any(far)
            wrong += is_wrong
            shown = " · ".join("none" if slope is None else f"{slope:.5g}" for slope, _ in means)
            said = verdict if pair["reason"] is None else f"{verdict}: {pair['reason']}"
            mark = " **wrong**" if is_wrong else ""
            print(f"| {scenario} | {pair['measure']} | `{pair['parameter']}` | {derivative:.5g} | {shown} | {said}{mark} |", flush=True)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2:]))
