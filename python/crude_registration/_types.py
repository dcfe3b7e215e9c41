# SPDX-License-Identifier: GPL-3.0-or-later
"""The types of the module that hold no more than values."""

from __future__ import annotations

import dataclasses
import enum
import typing

import numpy
import numpy.typing

if typing.TYPE_CHECKING:
    from ._core import RegistrationResult


class RegistrationStatus(enum.Enum):
    """What came out of a registration."""

    REGISTERED = "registered"
    """One motion explains the scans, and it is certain."""
    AMBIGUOUS = "ambiguous"
    """Several distinct motions, or a family of motions, explain the scans about as well."""
    NOT_REGISTERED = "not_registered"
    """No motion was found that can be believed."""

    def __str__(self) -> str:
        return self.value


class MotionStatus(enum.Enum):
    """What is to be said of a motion that somebody found."""

    RIGHT = "right"
    """It brings the scans together, to within a sampling distance."""
    REFINABLE = "refinable"
    """It does not, but what refinement makes of it does."""
    WRONG = "wrong"
    """Neither it nor what refinement makes of it can be told from chance."""

    def __str__(self) -> str:
        return self.value


class ScanKind(enum.Enum):
    """What a ScanFile holds."""

    RANGE_IMAGE = "range image"
    """Samples in the cells of a grid, and the sensor if it is known."""
    MESH = "mesh"
    """Triangles."""
    POINTS = "points"
    """Points, and nothing that joins them."""

    def __str__(self) -> str:
        return self.value


class DepthCamera(typing.NamedTuple):
    """What makes points of a depth image: the value d in column u and row v, counted from 0, is the point
    ((u - cx) z / fx, (v - cy) z / fy, z) with z = d / scale, in the frame of the camera, which looks along z."""

    fx: float
    """The focal lengths, in pixels."""
    fy: float
    cx: float
    """The image of the optical axis, in pixels."""
    cy: float
    scale: float
    """How many units of depth there are to the unit of length: 1000 where a value is in millimetres and points shall be
    in metres."""


class Mesh(typing.NamedTuple):
    """A triangle mesh."""

    points: numpy.typing.NDArray[numpy.float64]
    """(n, 3): the vertices, in the unit and the frame of the scan that the mesh is of."""
    faces: numpy.typing.NDArray[numpy.int32]
    """(m, 3): rows of points, counterclockwise seen from outside or from the sensor."""


class ScoredMotion(typing.NamedTuple):
    """A motion that was considered, and how good it is."""

    T_target_source: numpy.typing.NDArray[numpy.float64]
    """(4, 4): maps the source into the frame of the target."""
    score: float
    """The natural logarithm of the odds that it is right: what the evidence says of it alone, whatever its rivals."""
    probability: float
    """That it is right, among all motions that were considered and none of them; of the answer its confidence."""


@dataclasses.dataclass(frozen=True)
class Stage:
    """What a stage of a registration did."""

    name: str
    count: int
    """How many items it worked on."""
    seconds: float
    """How long that took."""


class RefinedMotion(typing.NamedTuple):
    """What refine() returns."""

    T_target_source: numpy.typing.NDArray[numpy.float64]
    """(4, 4): maps the source into the frame of the target."""
    iterations: int
    is_converged: bool
    """Whether the last step was shorter than the tolerance."""
    sampling_distance: float
    """The distance of neighbouring samples that was used, in the unit of the coordinates."""
    residual: float
    """RMS distance of corresponding points along their normals, in sampling distances."""
    overlap: float
    """Share of the source's vertices on which the target lies, from 0 to 1."""
    number_of_free_motions: int
    """How many independent small motions the surfaces leave free: 3 on a plane, 0 where the motion is determined."""
    covariance: numpy.typing.NDArray[numpy.float64]
    """(6, 6): of the small motion that follows, turns about the target's axes in radians before displacements in the
    unit of the coordinates."""


class MotionJudgement(typing.NamedTuple):
    """What judge() says of a motion."""

    status: MotionStatus
    confidence: float
    """The probability that what refinement makes of the motion is right, from 0 to 1."""
    displacement: float
    """How far the motion is from that: RMS over the part of the source that overlaps, in sampling distances."""
    refined: RegistrationResult
    """What refinement makes of the motion, as if a registration had found it; its rivals are runners-up."""


class EdgeStatus(enum.Enum):
    """What came of a pair of scans that assemble() registered."""

    USED = "used"
    """A motion of the pair is that of the model."""
    DROPPED = "dropped"
    """Its motions contradict the model."""
    NOT_CONNECTING = "not_connecting"
    """Its motions would join two components, and are not believed."""
    WITHOUT_OVERLAP = "without_overlap"
    """No motion was found."""

    def __str__(self) -> str:
        return self.value


class AssembledScan(typing.NamedTuple):
    """A scan in a model."""

    component: int
    """The component it is in, 0 for the largest."""
    T_model_scan: numpy.typing.NDArray[numpy.float64]
    """(4, 4): maps the scan into the frame of its component, which is that of the first scan of it."""
    reason: str
    """Why it is alone in its component, as a sentence; empty if it is not."""
    residual: float
    """RMS distance along the normals from the scans that it overlaps, in sampling distances."""
    covariance: numpy.typing.NDArray[numpy.float64]
    """(6, 6): of the small motion that follows, turns about the model's axes in radians before displacements in the
    unit of the coordinates; zeros for the scan whose frame is that of the component."""


class AssemblyEdge(typing.NamedTuple):
    """A pair of scans that was registered, by their places."""

    source: int
    target: int
    status: EdgeStatus
    reason: str
    """Why it was not used, or what is to be known of it."""
    registration: RegistrationStatus
    """What the registration of the two alone has said."""
    confidence: float
    """Its confidence in its best motion."""
    overlap: float
    residual: float


class AssemblyOverlap(typing.NamedTuple):
    """Two scans that overlap as they lie in the model, by their places."""

    source: int
    target: int
    overlap: float
    """The share of the source's surface that lies on the target's."""
    residual: float
    """RMS distance along the normals, in sampling distances."""


@dataclasses.dataclass(frozen=True)
class AssemblyResult:
    """What assemble() returns."""

    number_of_components: int
    scans: list[AssembledScan]
    """Of each scan, in the order in which they were given."""
    edges: list[AssemblyEdge]
    overlaps: list[AssemblyOverlap]
    statistics: list[Stage]
    is_interrupted: bool
    """Whether the time budget or the progress function ended the run: there may be more to connect."""

    @property
    def components(self) -> list[list[int]]:
        """The places of the scans of each component, the largest first."""
        lists: list[list[int]] = [[] for _ in range(self.number_of_components)]
        for i, scan in enumerate(self.scans):
            lists[scan.component].append(i)
        return lists

    def __repr__(self) -> str:
        sizes = ", ".join(str(len(c)) for c in self.components)
        return f"<AssemblyResult: {len(self.scans)} scans in components of {sizes or 'none'}>"


class PreparationInterrupted(RuntimeError):
    """Raised by Scan() where its time budget or its progress function ends it: no part of a scan is of use."""


for _type in (
    RegistrationStatus,
    MotionStatus,
    ScanKind,
    DepthCamera,
    Mesh,
    ScoredMotion,
    Stage,
    RefinedMotion,
    MotionJudgement,
    EdgeStatus,
    AssembledScan,
    AssemblyEdge,
    AssemblyOverlap,
    AssemblyResult,
    PreparationInterrupted,
):
    _type.__module__ = "crude_registration"
del _type
