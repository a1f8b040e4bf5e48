#!/usr/bin/env bash
# The tests of the Python package with its module and the library under the address and undefined-behaviour sanitizers, in
# build-asan.
#   scripts/python_asan.sh [interpreter]      that of scripts/python_environment.sh if none is given
set -euo pipefail
cd "$(dirname "$0")/.."
python="${1:-$(scripts/python_environment.sh)}"
cmake --preset asan -DFLOATFRAME_PYTHON=ON -DPython_EXECUTABLE="$python"
cmake --build build-asan --parallel "${JOBS:-$(nproc)}" --target floatframe_python floatframe_program
LD_PRELOAD="$(c++ -print-file-name=libasan.so) $(c++ -print-file-name=libubsan.so) $(c++ -print-file-name=libstdc++.so)" \
  MPLBACKEND=agg ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=1:handle_segv=0 PYTHONPATH=$PWD/build-asan/python \
  "$python" -B -m pytest -q -p no:cacheprovider
