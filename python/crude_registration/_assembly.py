# SPDX-License-Identifier: GPL-3.0-or-later
"""assemble(): many scans to one model, by the processors of this machine or by an executor of any kind."""

from __future__ import annotations

import concurrent.futures
import os
import typing

from . import _core
from ._types import AssemblyResult

if typing.TYPE_CHECKING:
    from ._core import RegistrationResult, Scan, _Progress, _Scan, _Three


def _prepare(scan: _Scan, viewpoint: typing.Optional[_Three]) -> Scan:
    return scan if isinstance(scan, _core.Scan) else _core.Scan(scan, viewpoint=viewpoint)


def _register(source: Scan, target: Scan) -> RegistrationResult:
    return _core.register(source, target, parallel=False)


_Answer = typing.TypeVar("_Answer")


def _answers(
    futures: typing.Sequence[concurrent.futures.Future[_Answer]], go_on: typing.Callable[[], bool]
) -> typing.Optional[list[_Answer]]:
    """Of all, in their order; None where the run is to end. The first that fails ends the others that have not begun."""
    try:
        pending = set(futures)
        while pending:
            done, pending = concurrent.futures.wait(
                pending, timeout=0.05, return_when=concurrent.futures.FIRST_EXCEPTION
            )
            for future in done:
                future.result()
            if not go_on():
                return None
        return [future.result() for future in futures]
    finally:
        for future in futures:
            future.cancel()


def assemble(
    scans: typing.Iterable[_Scan],
    *,
    executor: typing.Optional[concurrent.futures.Executor] = None,
    viewpoint: typing.Optional[_Three] = None,
    store: typing.Optional[typing.Union[str, os.PathLike[str]]] = None,
    time_budget: typing.Optional[float] = None,
    parallel: bool = True,
    progress: typing.Optional[_Progress] = None,
) -> AssemblyResult:
    """Puts many scans together: finds a pose for each, from nothing but their surfaces.

    Pairs that promise to overlap are registered in rounds, until all scans are connected and each connection is
    confirmed by others; what cannot be connected with certainty comes back as components of its own.

    scans: in any order, each a Scan or what Scan() takes as points: the path of a file, an array, a ScanFile, a Mesh.
    executor: what prepares the scans and registers the pairs: anything with the interface of
        concurrent.futures.Executor, such as a ProcessPoolExecutor, Dask's Client.get_executor() or mpi4py's
        MPIPoolExecutor. Its tasks are independent of each other; they carry paths or arrays, and prepared scans as
        their bytes. The plan and the refinement of all poses stay in this process. The answer is the same, bit by bit,
        with any executor and with none. A ScanFile is prepared here.
    viewpoint: three numbers, where the sensor stood, in the own frame of each scan that is not a Scan; by default what
        its file says.
    store: a folder that keeps the answer of each pair: a run that was ended, or has more scans, registers none of them
        again. Without an executor only.
    time_budget: seconds after which the registration of pairs ends, with what has been found.
    parallel: whether all processors of this machine are used for what is done here.
    progress: a function that is called with the share of the work that is done at most, and may end the run by
        returning False; the scans that are being prepared are prepared before.

    >>> import crude_registration as cr
    >>> statue = cr.make_statue(resolution=48)
    >>> views = [cr.simulate(statue, d, samples=150)[0] for d in ((-1, 0, -0.25), (-1, -0.7, -0.25), (-1, -2, -0.25))]
    >>> cr.assemble(views)
    <AssemblyResult: 3 scans in components of 3>
    """
    items = list(scans)
    if executor is not None and store is not None:
        raise ValueError("assemble: store is used without an executor only")
    prepared: list[Scan] = []
    if executor is None:
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count() if parallel else 1) as threads:
            prepared = _answers([threads.submit(_prepare, s, viewpoint) for s in items], lambda: True) or []
    else:
        # What is no argument of a task, as it cannot be pickled or is done, is prepared here.
        is_here = [isinstance(s, (_core.Scan, _core.ScanFile)) for s in items]
        tasks = [executor.submit(_prepare, s, viewpoint) for s, here in zip(items, is_here) if not here]
        answers = iter(_answers(tasks, lambda: True) or [])
        prepared = [_prepare(s, viewpoint) if here else next(answers) for s, here in zip(items, is_here)]

    def register_pairs(
        pairs: list[tuple[int, int]], go_on: typing.Callable[[], bool]
    ) -> typing.Optional[list[RegistrationResult]]:
        assert executor is not None
        return _answers([executor.submit(_register, prepared[i], prepared[j]) for i, j in pairs], go_on)

    return _core.assemble_scans(
        prepared,
        None if executor is None else register_pairs,
        None if store is None else os.fspath(store),
        time_budget,
        parallel,
        progress,
    )


assemble.__module__ = "crude_registration"
