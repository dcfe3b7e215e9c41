# SPDX-License-Identifier: GPL-3.0-or-later
"""The types of the module that hold no more than values."""

import dataclasses
import enum
import typing

import numpy
import numpy.typing

if typing.TYPE_CHECKING:
    from ._core import RegistrationResult

_Floats = numpy.typing.NDArray[numpy.float64]


class RegistrationStatus(enum.Enum):
    """What came out of a registration.

    REGISTERED: one motion explains the scans, and it is certain.
    AMBIGUOUS: several distinct motions, or a family of motions, explain the scans about as well.
    NOT_REGISTERED: no motion was found that can be believed.
    """

    REGISTERED = "registered"
    AMBIGUOUS = "ambiguous"
    NOT_REGISTERED = "not_registered"

    def __str__(self) -> str:
        return self.value


class MotionStatus(enum.Enum):
    """What is to be said of a motion that somebody found.

    RIGHT: it brings the scans together, to within one and a half sampling distances.
    REFINABLE: it does not, but what refinement makes of it does.
    WRONG: neither it nor what refinement makes of it can be told from chance.
    """

    RIGHT = "right"
    REFINABLE = "refinable"
    WRONG = "wrong"

    def __str__(self) -> str:
        return self.value


class ScanKind(enum.Enum):
    """What a ScanFile holds.

    RANGE_IMAGE: samples in the cells of a grid, and the sensor if it is known.
    MESH: triangles.
    POINTS: points, and nothing that joins them.
    """

    RANGE_IMAGE = "range image"
    MESH = "mesh"
    POINTS = "points"

    def __str__(self) -> str:
        return self.value


class DepthCamera(typing.NamedTuple):
    """What makes points of a depth image: the value d in column u and row v, counted from 0, is the point
    ((u - cx) z / fx, (v - cy) z / fy, z) with z = d / scale, in the frame of the camera, which looks along z.

    fx, fy: the focal lengths, in pixels.
    cx, cy: the image of the optical axis, in pixels.
    scale: how many units of depth there are to the unit of length: 1000 where a value is in millimetres and points shall
        be in metres.
    """

    fx: float
    fy: float
    cx: float
    cy: float
    scale: float


class Mesh(typing.NamedTuple):
    """A triangle mesh.

    points: (n, 3): the vertices, in the unit and the frame of the scan that the mesh is of.
    faces: (m, 3): rows of points, counterclockwise seen from outside or from the sensor.
    """

    points: _Floats
    faces: numpy.typing.NDArray[numpy.int32]


class ScoredMotion(typing.NamedTuple):
    """A motion that was considered, and how good it is.

    T_target_source: (4, 4): maps the source into the frame of the target.
    score: the natural logarithm of the odds that it is right, against none of the distinct motions being right.
    probability: that it is right, among all motions that were considered and none of them; of the answer its confidence.
    """

    T_target_source: _Floats
    score: float
    probability: float


@dataclasses.dataclass(frozen=True)
class Stage:
    """What a stage of a registration did.

    name: of the stage; behind a colon that of a part of it.
    count: how many items it worked on.
    seconds: how long that took.
    """

    name: str
    count: int
    seconds: float


class ScaledRegistration(typing.NamedTuple):
    """What register_with_scale() returns.

    scale: the factor by which the coordinates of the source are multiplied, an estimate; 1.0 if NOT_REGISTERED.
    scale_deviation: its standard deviation by the scatter of the samples, as a share of it.
    registration: the RegistrationResult of the source multiplied by it, whose motions are rigid.
    similarity: (4, 4): maps the source, in its own unit, into the frame of the target.
    """

    scale: float
    scale_deviation: float
    registration: "RegistrationResult"
    similarity: _Floats


class RefinedMotion(typing.NamedTuple):
    """What refine() returns.

    T_target_source: (4, 4): maps the source into the frame of the target.
    iterations: how many there were.
    is_converged: whether the last step was shorter than the tolerance.
    sampling_distance: the distance of neighbouring samples that was used, in the unit of the coordinates.
    residual: RMS distance of corresponding points along their normals, in sampling distances.
    overlap: share of the source's vertices on which the target lies, from 0 to 1.
    number_of_free_motions: how many independent small motions the surfaces leave free: 3 on a plane, 0 where the motion
        is determined.
    covariance: (6, 6): of the small motion that follows, turns about the target's axes in radians before displacements
        in the unit of the coordinates.
    """

    T_target_source: _Floats
    iterations: int
    is_converged: bool
    sampling_distance: float
    residual: float
    overlap: float
    number_of_free_motions: int
    covariance: _Floats


class MotionJudgement(typing.NamedTuple):
    """What judge() says of a motion.

    status: a MotionStatus.
    confidence: the probability that what refinement makes of the motion is right, from 0 to 1.
    displacement: how far the motion is from that: RMS over the part of the source that overlaps, in sampling distances.
    refined: what refinement makes of the motion, as if a registration had found it; its rivals are runners-up.
    """

    status: MotionStatus
    confidence: float
    displacement: float
    refined: "RegistrationResult"


class EdgeStatus(enum.Enum):
    """What came of a pair of scans that assemble() registered.

    USED: a motion of the pair is that of the model.
    DROPPED: its motions contradict the model.
    NOT_CONNECTING: its motions would join two components, and are not believed.
    WITHOUT_OVERLAP: no motion was found.
    """

    USED = "used"
    DROPPED = "dropped"
    NOT_CONNECTING = "not_connecting"
    WITHOUT_OVERLAP = "without_overlap"

    def __str__(self) -> str:
        return self.value


class AssembledScan(typing.NamedTuple):
    """A scan in a model.

    component: the component it is in, 0 for the largest.
    T_model_scan: (4, 4): maps the scan into the frame of its component, which is that of the first scan of it.
    reason: why it is alone in its component, as a sentence; empty if it is not.
    residual: RMS distance along the normals from the scans that it overlaps, in sampling distances.
    covariance: (6, 6): of the small motion that follows, turns about the model's axes in radians before displacements in
        the unit of the coordinates; zeros for the scan whose frame is that of the component.
    """

    component: int
    T_model_scan: _Floats
    reason: str
    residual: float
    covariance: _Floats


class AssemblyEdge(typing.NamedTuple):
    """A pair of scans that was registered, by their places.

    source, target: the places of the scans among those that were given.
    status: an EdgeStatus.
    reason: why it was not used, or what is to be known of it.
    registration: the RegistrationStatus of the two alone.
    confidence: that of the registration in its best motion.
    overlap, residual: of that motion.
    """

    source: int
    target: int
    status: EdgeStatus
    reason: str
    registration: RegistrationStatus
    confidence: float
    overlap: float
    residual: float


class AssemblyOverlap(typing.NamedTuple):
    """Two scans that overlap as they lie in the model, by their places.

    source, target: the places of the scans among those that were given.
    overlap: the share of the source's surface that lies on the target's.
    residual: RMS distance along the normals, in sampling distances.
    """

    source: int
    target: int
    overlap: float
    residual: float


@dataclasses.dataclass(frozen=True)
class AssemblyResult:
    """What assemble() returns.

    number_of_components: into how many parts the scans fall.
    scans: an AssembledScan for each scan, in the order in which they were given.
    edges: an AssemblyEdge for each pair that was registered.
    overlaps: an AssemblyOverlap for each pair that overlaps in the model.
    statistics: what each stage did.
    is_interrupted: whether the time budget or the progress function ended the run: there may be more to connect.
    """

    number_of_components: int
    scans: typing.List[AssembledScan]
    edges: typing.List[AssemblyEdge]
    overlaps: typing.List[AssemblyOverlap]
    statistics: typing.List[Stage]
    is_interrupted: bool

    @property
    def components(self) -> typing.List[typing.List[int]]:
        """The places of the scans of each component, the largest first."""
        lists: typing.List[typing.List[int]] = [[] for _ in range(self.number_of_components)]
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
    ScaledRegistration,
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
