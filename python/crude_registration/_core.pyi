# SPDX-License-Identifier: GPL-3.0-or-later
# The types of what is written in C++: python/src.

import os
from typing import Any, Callable, List, Optional, Sequence, Tuple, Union

import numpy
import numpy.typing

from ._types import (
    AssemblyResult,
    DepthCamera,
    Mesh,
    MotionJudgement,
    RefinedMotion,
    RegistrationStatus,
    ScaledRegistration,
    ScanKind,
    ScoredMotion,
    Stage,
)

_Floats = numpy.typing.NDArray[numpy.float64]
_Path = Union[str, bytes, "os.PathLike[Any]"]
# An array of shape (n, 3) or (rows, columns, 3), of float32 or float64, or what numpy.asarray() makes one of.
_Samples = Union[_Path, "ScanFile", Mesh, numpy.typing.ArrayLike]
_Scan = Union["Scan", _Samples]
_Three = Union[Sequence[float], numpy.typing.ArrayLike]
_Progress = Callable[[float], Optional[bool]]

class Scan:
    def __init__(
        self,
        points: _Samples,
        faces: Optional[numpy.typing.ArrayLike] = None,
        *,
        normals: Optional[numpy.typing.ArrayLike] = None,
        viewpoint: Optional[_Three] = None,
        viewing_direction: Optional[_Three] = None,
        method: str = "pairs",
        approximation_error: Optional[float] = None,
        number_of_vertices: Optional[int] = None,
        cell_size: float = 0.0,
        time_budget: Optional[float] = None,
        progress: Optional[_Progress] = None,
    ) -> None: ...
    @property
    def number_of_samples(self) -> int: ...
    @property
    def spacing(self) -> float: ...
    @property
    def extent(self) -> float: ...
    @property
    def points(self) -> _Floats: ...
    @property
    def normals(self) -> _Floats: ...
    @property
    def has_free_space(self) -> bool: ...
    def to_bytes(self) -> bytes: ...
    @staticmethod
    def from_bytes(bytes: bytes) -> Scan: ...
    def save(self, path: _Path) -> None: ...
    @staticmethod
    def load(path: _Path) -> Scan: ...
    def __getstate__(self) -> bytes: ...
    def __setstate__(self, state: bytes) -> None: ...

class ScanFile:
    @property
    def kind(self) -> ScanKind: ...
    @property
    def points(self) -> _Floats: ...
    @property
    def faces(self) -> Optional[numpy.typing.NDArray[numpy.int32]]: ...
    @property
    def normals(self) -> Optional[_Floats]: ...
    @property
    def colors(self) -> Optional[numpy.typing.NDArray[numpy.uint8]]: ...
    @property
    def grid(self) -> Optional[numpy.typing.NDArray[numpy.int32]]: ...
    @property
    def viewpoint(self) -> Optional[_Floats]: ...
    @property
    def viewing_direction(self) -> Optional[_Floats]: ...
    @property
    def missing(self) -> int: ...
    @property
    def notes(self) -> List[str]: ...
    def surface(self) -> Mesh: ...
    def write(self, path: _Path) -> None: ...

class RegistrationResult:
    @property
    def status(self) -> RegistrationStatus: ...
    @property
    def reason(self) -> str: ...
    @property
    def T_target_source(self) -> _Floats: ...
    @property
    def crude_T_target_source(self) -> _Floats: ...
    @property
    def correspondence(self) -> _Floats: ...
    @property
    def confidence(self) -> float: ...
    @property
    def score(self) -> float: ...
    @property
    def overlap(self) -> float: ...
    @property
    def residual(self) -> float: ...
    @property
    def free_space_violations(self) -> float: ...
    @property
    def source_has_free_space(self) -> bool: ...
    @property
    def target_has_free_space(self) -> bool: ...
    @property
    def covariance(self) -> _Floats: ...
    @property
    def free_motions(self) -> List[str]: ...
    @property
    def poses(self) -> List[ScoredMotion]: ...
    @property
    def runners_up(self) -> List[ScoredMotion]: ...
    @property
    def statistics(self) -> List[Stage]: ...
    def to_json(self, *, times: bool = False) -> str: ...
    def __getstate__(self) -> Tuple[Any, ...]: ...
    def __setstate__(self, state: Tuple[Any, ...]) -> None: ...

def assemble_scans(
    scans: Sequence[Scan],
    register_pairs: Optional[
        Callable[[List[Tuple[int, int]], Callable[[], bool]], Optional[List[str]]]
    ] = None,
    store: Optional[bytes] = None,
    time_budget: Optional[float] = None,
    parallel: bool = True,
    progress: Optional[_Progress] = None,
) -> AssemblyResult: ...
def register_pair(source: Scan, target: Scan, store: Optional[bytes] = None) -> str: ...
def stored_pair(store: bytes, source: str, target: str) -> Optional[str]: ...
def scan_hash(scan: Scan) -> str: ...
def read_scan(
    path: _Path, *, camera: Optional[Union[DepthCamera, Sequence[float], numpy.typing.ArrayLike]] = None
) -> ScanFile: ...
def register(
    source: _Scan,
    target: _Scan,
    *,
    viewpoint: Optional[_Three] = None,
    source_viewpoint: Optional[_Three] = None,
    target_viewpoint: Optional[_Three] = None,
    source_viewing_direction: Optional[_Three] = None,
    target_viewing_direction: Optional[_Three] = None,
    method: str = "pairs",
    minimum_extent: float = 0.0,
    maximum_extent: float = 0.3,
    tolerance: Optional[float] = None,
    use_normals: bool = True,
    approximation_error: Optional[float] = None,
    number_of_vertices: Optional[int] = None,
    cell_size: float = 0.0,
    time_budget: Optional[float] = None,
    parallel: bool = True,
    progress: Optional[_Progress] = None,
) -> RegistrationResult: ...
def register_with_scale(
    source: _Scan,
    target: _Scan,
    *,
    viewpoint: Optional[_Three] = None,
    source_viewpoint: Optional[_Three] = None,
    target_viewpoint: Optional[_Three] = None,
    source_viewing_direction: Optional[_Three] = None,
    target_viewing_direction: Optional[_Three] = None,
    method: str = "pairs",
    minimum_extent: float = 0.0,
    maximum_extent: float = 0.3,
    tolerance: Optional[float] = None,
    use_normals: bool = True,
    approximation_error: Optional[float] = None,
    number_of_vertices: Optional[int] = None,
    cell_size: float = 0.0,
    time_budget: Optional[float] = None,
    parallel: bool = True,
    progress: Optional[_Progress] = None,
) -> ScaledRegistration: ...
def judge(
    source: _Scan,
    target: _Scan,
    T_target_source: numpy.typing.ArrayLike,
    *,
    viewpoint: Optional[_Three] = None,
    source_viewpoint: Optional[_Three] = None,
    target_viewpoint: Optional[_Three] = None,
    source_viewing_direction: Optional[_Three] = None,
    target_viewing_direction: Optional[_Three] = None,
    method: str = "pairs",
    minimum_extent: float = 0.0,
    maximum_extent: float = 0.3,
    time_budget: Optional[float] = None,
    parallel: bool = True,
    progress: Optional[_Progress] = None,
) -> MotionJudgement: ...
def refine(
    source: _Samples,
    target: _Samples,
    T_target_source: numpy.typing.ArrayLike,
    *,
    maximum_distance: Optional[float] = None,
    sampling_distance: Optional[float] = None,
    tolerance: float = 0.05,
    number_of_iterations: int = 50,
    parallel: bool = True,
) -> RefinedMotion: ...
def simplify(
    source: _Samples,
    *,
    approximation_error: Optional[float] = None,
    number_of_vertices: Optional[int] = None,
    cell_size: float = 0.0,
) -> Mesh: ...
def make_statue(resolution: int = 96, seed: int = 0) -> Mesh: ...
def simulate(
    scene: _Samples,
    direction: _Three,
    *,
    samples: int = 400,
    perspective: bool = False,
    noise: float = 0.0,
    quantization: float = 0.0,
    drop_out: float = 0.0,
    grazing_drop_out: float = 0.0,
    seed: int = 0,
) -> Tuple[ScanFile, _Floats]: ...
