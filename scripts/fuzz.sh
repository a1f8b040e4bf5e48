#!/usr/bin/env bash
# Fuzzes the readers of finite-element files, one after the other.
#
#   scripts/fuzz.sh [reader...]        all readers of fuzz/corpus by default
#
# FUZZ_SECONDS is the time for each (default 600), JOBS the number of compilers. What is found in new inputs stays in
# build-fuzz/corpus; an input that breaks a reader is in build-fuzz/broken: put it into fuzz/corpus/READER with the
# mended reader, then `make test` replays it for ever. Exit code 1 if a reader broke.
set -euo pipefail
cd "$(dirname "$0")/.."

clang=$(command -v clang++ || true)
if [[ -z "$clang" ]]; then
  if [[ $EUID -eq 0 ]] && command -v apt-get >/dev/null; then
    apt-get update && apt-get install --yes --no-install-recommends clang libclang-rt-dev
    clang=$(command -v clang++)
  else
    echo "clang++ with libFuzzer is missing; on Debian: sudo apt-get install clang libclang-rt-dev" >&2
    exit 2
  fi
fi

readers=("$@")
if [[ ${#readers[@]} -eq 0 ]]; then
  mapfile -t readers < <(find fuzz/corpus -mindepth 1 -maxdepth 1 -type d -printf '%f\n' | sort)
fi
cmake -S fuzz -B build-fuzz -G Ninja -DCMAKE_CXX_COMPILER="$clang" >/dev/null
cmake --build build-fuzz --parallel "${JOBS:-$(nproc)}" --target "${readers[@]/#/fuzz_}"

seconds=${FUZZ_SECONDS:-600}
broken=()
for reader in "${readers[@]}"; do
  mkdir -p "build-fuzz/corpus/$reader" "build-fuzz/broken/$reader"
  words=()
  [[ -f "fuzz/words/$reader.txt" ]] && words=("-dict=fuzz/words/$reader.txt")
  echo "fuzzing $reader for $seconds s"
  if ! "build-fuzz/fuzz_$reader" -max_total_time="$seconds" -timeout=20 -rss_limit_mb=2048 -max_len=20000 \
      -print_final_stats=1 -verbosity=0 "${words[@]}" -artifact_prefix="build-fuzz/broken/$reader/" \
      "build-fuzz/corpus/$reader" "fuzz/corpus/$reader"; then
    broken+=("$reader")
  fi
done
if [[ ${#broken[@]} -gt 0 ]]; then
  echo "broken: ${broken[*]}; the inputs are in build-fuzz/broken" >&2
  exit 1
fi
echo "no reader broke: ${readers[*]}, $seconds s each"
