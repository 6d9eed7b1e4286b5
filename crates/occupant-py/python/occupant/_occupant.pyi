"""Types of the module."""

from collections.abc import Callable, Iterable, Sequence
from os import PathLike
from typing import Any, TypeAlias, final

import numpy as np
from numpy.typing import NDArray

__version__: str

_Path: TypeAlias = str | PathLike[str]
_Changes: TypeAlias = dict[str, Any] | Iterable[str]
_Progress: TypeAlias = bool | Callable[[int, int], object] | None
_Table: TypeAlias = dict[str, Any]

def read(path: _Path) -> Run: ...
def compare(
    computed: Run | _Path,
    measured: Run | _Path,
    channels: Sequence[str] = ...,
    maps: Sequence[str] = ...,
    seat: str = "1",
    start: float | None = None,
    end: float | None = None,
    shift: float = 0.0,
    filter: str = "none",
    coefficients: str = "iso6487",
    protocol: str | None = None,
) -> dict[str, Any]: ...
def rate(
    rating: str,
    *runs: Run | _Path,
    places: Sequence[str] = ...,
    values: _Path | None = None,
    path: _Path | None = None,
    force: bool = False,
) -> dict[str, Any]: ...
def report(
    *runs: Run | _Path, path: _Path, channels: Sequence[str] = ..., verdict: bool = False, force: bool = False
) -> None: ...
def study_report(
    folder: _Path,
    path: _Path | None = None,
    to: Sequence[str] = ...,
    limits: Sequence[str] = ...,
    force: bool = False,
    progress: _Progress = None,
) -> dict[str, Any]: ...
def view(
    source: Run | Scenario | _Path,
    path: _Path,
    times: Sequence[float] | str | None = None,
    views: Sequence[str] = ...,
    dimensions: bool = False,
    solid: bool = False,
    camera: str = "vehicle",
    size: tuple[int, int] | None = None,
    ghosts: Sequence[Run | _Path] = ...,
    beside: Run | _Path | None = None,
    force: bool = False,
) -> None: ...
def film(
    source: Run | _Path,
    path: _Path,
    slow_motion: float = ...,
    freeze: float | None = None,
    views: Sequence[str] = ...,
    solid: bool = False,
    camera: str = "vehicle",
    size: tuple[int, int] | None = None,
    ghosts: Sequence[Run | _Path] = ...,
    beside: Run | _Path | None = None,
    force: bool = False,
    progress: _Progress = None,
) -> None: ...

class OccupantError(ValueError):
    """A scenario or study that is wrong, or a run that failed."""

    problems: list[dict[str, Any]]

@final
class Scenario:
    """A scenario: a file in TOML or JSON, or a dict of its keys."""

    def __init__(self, source: _Path | dict[str, Any]) -> None: ...
    @staticmethod
    def from_text(text: str, format: str = "toml", folder: _Path = ...) -> Scenario: ...
    def paths(self, pattern: str = "*") -> list[dict[str, Any]]: ...
    def __setitem__(self, path: str, value: Any, /) -> None: ...
    def __getitem__(self, path: str, /) -> Any: ...
    def __delitem__(self, path: str, /) -> None: ...
    def copy(self) -> Scenario: ...
    def check(self) -> list[dict[str, Any]]: ...
    def to_toml(self) -> str: ...
    def add_force(
        self,
        name: str,
        places: Sequence[str | tuple[str, Sequence[float]]],
        function: Callable[[float, list[list[float]], list[list[float]]], Sequence[Sequence[float]]],
    ) -> None: ...
    def live(
        self,
        velocity: Sequence[float] | None = None,
        place: Sequence[float] = (0.0, 0.0, 0.0),
        attitude: Sequence[float] = (0.0, 0.0, 0.0),
        rates: Sequence[float] = (0.0, 0.0, 0.0),
    ) -> LiveRun: ...
    def run(
        self, until: float | str | None = None, overrides: _Changes | None = None, progress: _Progress = None
    ) -> Run: ...
    def batch(
        self,
        paths: Sequence[str],
        matrix: Iterable[Sequence[Any]] | NDArray[np.float64],
        threads: int | None = None,
        progress: _Progress = None,
    ) -> _Table: ...
    def sensitivity(self, to: Sequence[str], of: Sequence[str], progress: _Progress = None) -> dict[str, Any]: ...

@final
class LiveRun:
    """A run that is stepped from outside."""

    @property
    def time(self) -> float: ...
    @property
    def end(self) -> float: ...
    @property
    def known_until(self) -> float: ...
    def push(
        self, until: float, acceleration: Sequence[float], angular: Sequence[float] = (0.0, 0.0, 0.0)
    ) -> None: ...
    def push_state(
        self,
        until: float,
        place: Sequence[float],
        velocity: Sequence[float],
        attitude: Sequence[float] = (0.0, 0.0, 0.0),
        rates: Sequence[float] = (0.0, 0.0, 0.0),
    ) -> None: ...
    def advance(self, to: float | None = None) -> None: ...
    def kick(self, segment: str, impulse: Sequence[float], at: Sequence[float] = (0.0, 0.0, 0.0)) -> None: ...
    def __getitem__(self, name: str, /) -> float: ...
    def values(self, *patterns: str) -> dict[str, float]: ...
    def record(self) -> None: ...
    def summary(self) -> dict[str, Any]: ...
    def save(self) -> bytes: ...
    def load(self, bytes: bytes) -> None: ...
    def copy(self) -> LiveRun: ...

@final
class Run:
    """A run that has ended."""

    @staticmethod
    def from_bytes(bytes: bytes, name: str = "run.mcap") -> Run: ...
    def to_bytes(self) -> bytes: ...
    def save(self, path: _Path, force: bool = False) -> None: ...
    @property
    def status(self) -> str: ...
    @property
    def summary(self) -> dict[str, Any]: ...
    @property
    def measures(self) -> dict[str, float | None]: ...
    @property
    def caveats(self) -> list[dict[str, Any]]: ...
    @property
    def notes(self) -> list[str]: ...
    def judge(
        self,
        filter: str = "none",
        coefficients: str = "iso6487",
        dummy: str | None = None,
        interval: float | None = None,
    ) -> dict[str, Any]: ...
    @property
    def time(self) -> NDArray[np.float64]: ...
    def channels(self, pattern: str = "*") -> list[dict[str, str]]: ...
    def __getitem__(self, name: str, /) -> NDArray[np.float64]: ...
    def series_of(self, *patterns: str) -> dict[str, NDArray[np.float64]]: ...
    def to_pandas(self, *patterns: str) -> Any: ...
    def to_xarray(self, *patterns: str) -> Any: ...

@final
class Study:
    """A study: a scenario in which values are varied."""

    def __init__(
        self, source: _Path | dict[str, Any], changes: _Changes | None = None, folder: _Path = ...
    ) -> None: ...
    @staticmethod
    def from_text(
        text: str, format: str = "toml", folder: _Path = ..., changes: _Changes | None = None
    ) -> Study: ...
    def __len__(self) -> int: ...
    @property
    def columns(self) -> list[dict[str, str]]: ...
    def sample(self, index: int) -> dict[str, float | str]: ...
    def scenario(self, index: int) -> Scenario: ...
    def run(self, threads: int | None = None, progress: _Progress = None) -> _Table: ...
    def fit(
        self,
        tests: Sequence[_Path] = ...,
        maps: Sequence[str] = ...,
        folder: _Path | None = None,
        restart: bool = False,
        threads: int | None = None,
        progress: _Progress = None,
    ) -> dict[str, Any]: ...
    def optimise(
        self,
        folder: _Path | None = None,
        restart: bool = False,
        threads: int | None = None,
        progress: _Progress = None,
    ) -> dict[str, Any]: ...
    def sweep(
        self,
        folder: _Path,
        csv: bool = False,
        keep: str | None = None,
        restart: bool = False,
        threads: int | None = None,
        progress: _Progress = None,
    ) -> str: ...
