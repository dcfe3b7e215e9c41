# SPDX-License-Identifier: GPL-3.0-or-later
"""Global rigid registration of range scans that overlap in part, with an answer that says whether it can be believed.

>>> import crude_registration as cr
>>> result = cr.register("source.ply", "target.ply")  # doctest: +SKIP
>>> result.status, result.T_target_source  # doctest: +SKIP

Scans are files, arrays of numpy of shape (n, 3) (points, with faces a mesh) or (rows, columns, 3) (a range image), or
a Scan, which is prepared once for all pairs it takes part in. All lengths are in the unit of the input, whatever it is.
A matrix T_target_source maps the source into the frame of the target. Results are the same, bit by bit, as those of the
C++ package and of its program crude_register.
"""

from ._assembly import assemble
from ._core import (
    RegistrationResult,
    Scan,
    ScanFile,
    judge,
    make_statue,
    read_scan,
    refine,
    register,
    register_with_scale,
    simplify,
    simulate,
)
from ._types import (
    AssembledScan,
    AssemblyEdge,
    AssemblyOverlap,
    AssemblyResult,
    DepthCamera,
    EdgeStatus,
    Mesh,
    MotionJudgement,
    MotionStatus,
    PreparationInterrupted,
    RefinedMotion,
    RegistrationStatus,
    ScaledRegistration,
    ScanKind,
    ScoredMotion,
    Stage,
)

for _function in (judge, make_statue, read_scan, refine, register, register_with_scale, simplify, simulate):
    _function.__module__ = __name__
del _function

__all__ = [
    "AssembledScan",
    "AssemblyEdge",
    "AssemblyOverlap",
    "AssemblyResult",
    "DepthCamera",
    "EdgeStatus",
    "Mesh",
    "MotionJudgement",
    "MotionStatus",
    "PreparationInterrupted",
    "RefinedMotion",
    "RegistrationResult",
    "RegistrationStatus",
    "ScaledRegistration",
    "Scan",
    "ScanFile",
    "ScanKind",
    "ScoredMotion",
    "Stage",
    "assemble",
    "judge",
    "make_statue",
    "read_scan",
    "refine",
    "register",
    "register_with_scale",
    "simplify",
    "simulate",
]
