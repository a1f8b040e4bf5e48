#!/usr/bin/env bash
# The tests of the Python package with its module under the address sanitizer; the library is that of build/python, whose
# memory the sanitizer sees as well. After `make test-python`.
#   scripts/python_asan.sh [interpreter]      that of scripts/python_environment.sh if none is given
set -euo pipefail
cd "$(dirname "$0")/.."
python="${1:-$(scripts/python_environment.sh)}"
folder=build/python-asan
rm -rf "$folder"
mkdir -p "$folder/floatframe/bin"
include="$("$python" -c 'import sysconfig; print(sysconfig.get_paths()["include"])')"
suffix="$("$python" -c 'import sysconfig; print(sysconfig.get_config_var("EXT_SUFFIX"))')"
nanobind="$("$python" -m nanobind --include_dir)"
# The settings of the CMake package; with others it would not link.
export FLAGS="-std=c++20 -O1 -g1 -fPIC -fvisibility=hidden -fsanitize=address -fno-omit-frame-pointer -DEIGEN_MPL2_ONLY
  -DEIGEN_MAX_ALIGN_BYTES=32 -DEIGEN_MAX_STATIC_ALIGN_BYTES=32 -DEIGEN_STACK_ALLOCATION_LIMIT=1048576
  -Isrc -Ibuild/generated -isystem /usr/include/eigen3 -isystem $nanobind -isystem $include"
export folder
find python/src -name '*.cpp' -print0 | xargs -0 -P2 -I{} bash -c 'c++ $FLAGS -c {} -o $folder/$(basename {}).o'
c++ -shared -fsanitize=address -o "$folder/floatframe/_core$suffix" "$folder"/*.o \
  "$(find build/python -name 'libnanobind-static*.a' | head -1)" -Lbuild/lib -lfloatframe -Wl,-rpath,"$PWD/build/lib"
cp python/floatframe/*.py "$folder/floatframe"
ln -s "$PWD/examples" "$folder/floatframe/examples"
ln -s "$PWD/build/floatframe" "$folder/floatframe/bin/floatframe"
# Studies are processes of the program, which the sanitizer is not for.
LD_PRELOAD="$(c++ -print-file-name=libasan.so) $(c++ -print-file-name=libstdc++.so)" MPLBACKEND=agg \
  ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=1:handle_segv=0 PYTHONPATH="$folder" \
  "$python" -B -m pytest -q -p no:cacheprovider --ignore python/tests/test_study.py
