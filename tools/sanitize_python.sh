#!/usr/bin/env bash
# Runs the tests of the Python module under AddressSanitizer and UndefinedBehaviorSanitizer: tools/sanitize_python.sh
#
# Builds in build-python-address/. The interpreter itself is not instrumented: the runtime is loaded before it, and what
# the interpreter leaves behind at its end is no finding. Arguments are those of pytest (`-k register`). Dask and MPI are
# left out: their processes are not ours. A finding ends the run, and is printed.
# CRUDE_REGISTRATION_CASES=2000 asks for more generated arrays, other ones each time.
set -euo pipefail
cd "$(dirname "$0")/.."
root=$PWD
build=${CRUDE_REGISTRATION_BUILD:-build-python-address}

compiler=$(command -v clang++-14 || command -v clang++)
launcher=$(command -v ccache || true)
cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER="$compiler" \
  ${launcher:+-DCMAKE_CXX_COMPILER_LAUNCHER="$launcher"} -DCRUDE_REGISTRATION_SANITIZE=address \
  -DCMAKE_SHARED_LINKER_FLAGS=-shared-libsan -DCMAKE_MODULE_LINKER_FLAGS=-shared-libsan \
  -DCRUDE_REGISTRATION_WITH_PYTHON=ON -DCRUDE_REGISTRATION_WITH_TESTS=OFF -DCRUDE_REGISTRATION_WITH_BENCHMARKS=OFF \
  -DCRUDE_REGISTRATION_WITH_APPS=OFF -DCRUDE_REGISTRATION_WITH_EXAMPLES=OFF -DCRUDE_REGISTRATION_WITH_DOC=OFF
ninja -C "$build" crude_registration_python
runtime=$("$compiler" -print-file-name=libclang_rt.asan-"$(uname -m)".so)
python=$(sed -n 's/^CRUDE_REGISTRATION_PYTHON:.*=//p' "$build/CMakeCache.txt")
cd "$build/python"
PYTHONPATH=$PWD PYTHONDONTWRITEBYTECODE=1 PYTHONMALLOC=malloc UBSAN_OPTIONS=print_stacktrace=1 \
  ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=1 LD_PRELOAD=$runtime \
  "$python" -m pytest -q --capture=sys -p no:cacheprovider "$root/python/tests" --ignore="$root/python/tests/test_clusters.py" "$@"
