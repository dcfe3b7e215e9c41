# SPDX-License-Identifier: GPL-3.0-or-later
"""assemble(): many scans to one model, by the processors of this machine or by an executor of any kind."""

from __future__ import annotations

import concurrent.futures
import functools
import hashlib
import os
import typing

import numpy

from . import _core
from ._types import AssemblyResult

if typing.TYPE_CHECKING:
    from ._core import Scan, _Path, _Progress, _Scan, _Three

_Viewpoint = typing.Optional[tuple[float, ...]]


class _File(typing.NamedTuple):
    """A file that a scan is made of, as a task carries it."""

    path: str
    viewpoint: _Viewpoint
    store: typing.Optional[str]


class _Place(typing.NamedTuple):
    """Where a worker finds a prepared scan, and how it knows that it is the one that is meant."""

    hash: str
    file: typing.Optional[_File]
    """What it is made of, if that is a file,"""
    prepared: typing.Optional[str]
    """the file of the store that has it prepared, if there is a store,"""
    scan: typing.Optional[Scan]
    """and where there is neither, the scan itself."""


# Prepared scans, some megabytes each, that a worker keeps in its memory for the next pairs.
_KEPT = 64


def _stamp(path: str) -> tuple[int, int]:
    """Another one where a file was written anew."""
    try:
        status = os.stat(_name_of_file(path))
    except OSError:
        return 0, 0  # who reads it says what is the matter
    return status.st_mtime_ns, status.st_size


def _name_of_file(path: str) -> str:
    """Without the number of one of several scans in a file, FILE.ptx#2."""
    name, mark, number = path.rpartition("#")
    return name if mark and number.isdigit() and not os.path.exists(path) else path


@functools.lru_cache(_KEPT)
def _made(path: str, viewpoint: _Viewpoint, stamp: tuple[int, int]) -> Scan:
    del stamp
    return _core.Scan(path, viewpoint=viewpoint)


@functools.lru_cache(_KEPT)
def _loaded(path: str, stamp: tuple[int, int]) -> Scan:
    del stamp
    return _core.Scan.load(path)


def _prepared_file(file: _File) -> str:
    """The name in the store of what is prepared of a file, which is told by what is in it, wherever it lies."""
    assert file.store is not None
    content = hashlib.sha256(repr((os.path.basename(file.path), file.viewpoint)).encode(errors="surrogateescape"))
    with open(_name_of_file(file.path), "rb") as data:
        while part := data.read(1 << 20):
            content.update(part)
    return os.path.join(file.store, content.hexdigest() + ".scan")


def _prepare_file(file: _File) -> tuple[_Place, typing.Optional[Scan]]:
    """A task: prepares a file, or finds it prepared in the store. Without a store the scan comes back."""
    prepared = None
    scan = None
    if file.store is not None and os.path.isfile(_name_of_file(file.path)):
        prepared = _prepared_file(file)
        try:
            scan = _core.Scan.load(prepared)
        except OSError:
            pass  # it is not there, is damaged, or of another version
    if scan is None:
        scan = _core.Scan(file.path, viewpoint=file.viewpoint)
        if prepared is not None:
            scan.save(prepared)
    place = _Place(_core.scan_hash(scan), file, prepared, None)
    return place, scan if prepared is None else None


def _prepare_here(scan: _Scan, viewpoint: _Viewpoint, store: typing.Optional[str]) -> tuple[_Place, Scan]:
    """What is no file: arrays, which go to a task as they are, and what this process has made."""
    if not isinstance(scan, _core.Scan):
        scan = _core.Scan(scan, viewpoint=viewpoint)
    content = _core.scan_hash(scan)
    if store is None:
        return _Place(content, None, None, scan), scan
    prepared = os.path.join(store, content + ".scan")
    if not os.path.exists(prepared):
        scan.save(prepared)
    return _Place(content, None, prepared, None), scan


def _scan_at(place: _Place) -> Scan:
    """In the process of a worker."""
    if place.scan is not None:
        return place.scan
    if place.prepared is not None:
        try:
            scan = _loaded(place.prepared, _stamp(place.prepared))
            if _core.scan_hash(scan) == place.hash:
                return scan
        except OSError:
            if place.file is None:
                raise
    if place.file is None:
        raise OSError(f"{place.prepared}: the file holds another scan than it did when it was prepared")
    scan = _made(place.file.path, place.file.viewpoint, _stamp(place.file.path))
    if _core.scan_hash(scan) != place.hash:
        raise OSError(f"{place.file.path}: the file is another one than it was when it was prepared")
    return scan


def _register(source: _Place, target: _Place, store: typing.Optional[str]) -> str:
    """A task: registers a pair, or finds it in the store."""
    folder = None if store is None else os.fsencode(store)
    if folder is not None:
        answer = _core.stored_pair(folder, source.hash, target.hash)
        if answer is not None:
            return answer
    return _core.register_pair(_scan_at(source), _scan_at(target), folder)


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


def _three_numbers(viewpoint: typing.Optional[_Three]) -> _Viewpoint:
    if viewpoint is None:
        return None
    array = numpy.asarray(viewpoint)
    if array.shape != (3,):
        raise ValueError(f"assemble: viewpoint: three numbers are needed, not an array of shape {array.shape}")
    return tuple(array.tolist())


def _is_path(scan: _Scan) -> bool:
    return isinstance(scan, (str, bytes, os.PathLike))


def _prepared_by(
    executor: concurrent.futures.Executor,
    items: typing.Sequence[_Scan],
    viewpoint: _Viewpoint,
    store: typing.Optional[str],
) -> tuple[list[_Place], list[Scan]]:
    futures: dict[int, concurrent.futures.Future[typing.Any]] = {}
    answers: dict[int, tuple[_Place, typing.Optional[Scan]]] = {}
    for i, item in enumerate(items):
        if _is_path(item):
            # A worker may have another working directory.
            path = os.path.abspath(os.fsdecode(typing.cast("os.PathLike[str]", item)))
            futures[i] = executor.submit(_prepare_file, _File(path, viewpoint, store))
        elif not isinstance(item, (_core.Scan, _core.ScanFile)):
            futures[i] = executor.submit(_prepare_here, item, viewpoint, store)
    answers.update(zip(futures, _answers(list(futures.values()), lambda: True) or []))
    for i, item in enumerate(items):
        if i not in answers:
            answers[i] = _prepare_here(item, viewpoint, store)
    places, scans = [], []
    for i in range(len(items)):
        place, scan = answers[i]
        places.append(place)
        scans.append(_scan_at(place) if scan is None else scan)
    return places, scans


def assemble(
    scans: typing.Iterable[_Scan],
    *,
    executor: typing.Optional[concurrent.futures.Executor] = None,
    viewpoint: typing.Optional[_Three] = None,
    store: typing.Optional[_Path] = None,
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
        MPIPoolExecutor. Its tasks are independent of each other, and may be done again elsewhere where a worker dies.
        Of files they carry the paths and the hashes of what is in them, which all workers have to see; of arrays what
        is in them, unless there is a store. The plan and the refinement of all poses stay in this process. The answer
        is the same, bit by bit, with any executor and with none.
    viewpoint: three numbers, where the sensor stood, in the own frame of each scan that is not a Scan; by default what
        its file says.
    store: a folder, made if missing, that keeps the answer of each pair: a run that was ended, or has more scans,
        registers none of them again. With an executor it keeps the prepared scans, too, some megabytes each, where
        the workers find them; all of them have to see the folder.
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
    folder = None if store is None else os.path.abspath(os.fsdecode(store))
    where = _three_numbers(viewpoint)
    places: list[_Place] = []
    if executor is None:
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count() if parallel else 1) as threads:
            futures = [
                threads.submit(lambda s: s if isinstance(s, _core.Scan) else _core.Scan(s, viewpoint=where), item)
                for item in items
            ]
            prepared = _answers(futures, lambda: True) or []
    else:
        if folder is not None:
            os.makedirs(folder, exist_ok=True)
        places, prepared = _prepared_by(executor, items, where, folder)

    def register_pairs(
        pairs: list[tuple[int, int]], go_on: typing.Callable[[], bool]
    ) -> typing.Optional[list[str]]:
        assert executor is not None
        return _answers([executor.submit(_register, places[i], places[j], folder) for i, j in pairs], go_on)

    return _core.assemble_scans(
        prepared,
        None if executor is None else register_pairs,
        None if folder is None else os.fsencode(folder),
        time_budget,
        parallel,
        progress,
    )


assemble.__module__ = "crude_registration"
assemble.__annotations__.clear()  # help() would show them as text; type checkers read the source
