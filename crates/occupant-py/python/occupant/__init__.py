"""Simulator of a car's occupant in a crash or a violent manoeuvre.

>>> import occupant
>>> scenario = occupant.Scenario("scenarios/cart-lap-torso.toml")
>>> scenario["path.speed"] = "25 mph"
>>> run = scenario.run()
>>> run.measures["hic15"], run["head.acceleration.resultant"].max()
"""

from ._occupant import (
    LiveRun,
    OccupantError,
    Run,
    Scenario,
    Study,
    __version__,
    compare,
    film,
    rate,
    read,
    report,
    study_report,
    view,
)

__all__ = [
    "LiveRun",
    "OccupantError",
    "Run",
    "Scenario",
    "Study",
    "__version__",
    "compare",
    "film",
    "rate",
    "read",
    "report",
    "study_report",
    "view",
]
