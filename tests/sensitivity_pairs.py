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
MORE_OF_BELT = ["retractors.driver.lock.payout", "retractors.driver.on_spool", "materials.foam.k1", "materials.foam.friction"]
MORE_OF_BAG = ["bags.driver.volume", "bags.driver.vents[0].opens_at", "bags.driver.mount[0]", "bags.driver.friction"]
SLED = ["belts.lap.nodes[0].at[0]", "belts.torso.nodes[0].at[2]", "belts.torso.nodes[1].friction"]
PARAMETERS = {
    "three-point": BELT + MORE_OF_BELT,
    "airbag-driver": BELT + BAG + MORE_OF_BAG,
    "column-driver": BELT + BAG + ["frames.column.force[2]", "frames.column.mass"],
    "sled-person": SLED,
}


def mean(change):
    """The mean of the secants of a change that there are."""
    slopes = [change[side] for side in ("secant_below", "secant_above") if change[side] is not None]
    return sum(slopes) / len(slopes) if slopes else None, len(slopes)


def pairs(occupant, scenario, parameters):
    """All pairs of a scenario; where a parameter is refused each by itself, and that one says so."""
    folder = "scenarios" if scenario.startswith("sled") else "tests/data/hand"
    path = Path(__file__).parent.parent / folder / f"{scenario}.toml"
    words = [occupant, "sensitivity", path, "--to", MEASURES, "--of", ",".join(parameters), "--json"]
    ran = subprocess.run(words, capture_output=True, text=True, check=False)
    if ran.returncode == 0:
        yield from json.loads(ran.stdout)["sensitivities"]
    elif len(parameters) == 1:
        print(f"| {scenario} | | `{parameters[0]}` | refused: {ran.stderr.strip().splitlines()[0]} | | |")
    else:
        for parameter in parameters:
            yield from pairs(occupant, scenario, [parameter])


def main(occupant, scenarios):
    wrong = holding = 0
    print("| scenario | measure | parameter | derivative | finite changes | verdict |\n|---|---|---|---|---|---|")
    for scenario in scenarios or PARAMETERS:
        for pair in pairs(occupant, scenario, PARAMETERS[scenario]):
            derivative, verdict = pair["derivative"], pair["verdict"]
            means = [mean(change) for change in pair["changes"]]
            far = [abs(slope - derivative) > HOLDS * abs(derivative) for slope, sides in means if sides == 2]
            is_wrong = verdict == "holds" and any(far)
            wrong += is_wrong
            holding += verdict == "holds"
            shown = " · ".join("none" if slope is None else f"{slope:.5g}" for slope, _ in means)
            said = verdict if pair["reason"] is None else f"{verdict}: {pair['reason']}"
            mark = " **wrong**" if is_wrong else ""
            print(f"| {scenario} | {pair['measure']} | `{pair['parameter']}` | {derivative:.5g} | {shown} | {said}{mark} |", flush=True)
    print(f"{holding} hold, {wrong} wrongly")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2:]))
