#!/usr/bin/env bash
# Formats the C++ sources with clang-format and the repository's .clang-format.
#   scripts/format.sh           writes the files
#   scripts/format.sh --check   only looks; exit code 1 and the places if something would change
set -euo pipefail
cd "$(dirname "$0")/.."
if ! command -v clang-format >/dev/null; then
  echo "clang-format is not installed (package clang-format)" >&2
  exit 2
fi
mapfile -t files < <(find src tests bench python -name '*.hpp' -o -name '*.cpp' | sort)
if [[ "${1:-}" == "--check" ]]; then
  clang-format --dry-run --Werror "${files[@]}"
else
  clang-format -i "${files[@]}"
fi
