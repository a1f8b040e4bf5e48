#!/usr/bin/env bash
# What other programs find in the files of `floatframe export`: VTK (PyPI) and Khronos' validator of glTF (npm), fetched into
# build/export_tools the first time. Needs a network then, python3 with venv, node and npm.
#
#   scripts/check_export.sh [path to floatframe]
set -euo pipefail
cd "$(dirname "$0")/.."
tools=build/export_tools
vtk=9.7.2
validator=2.0.0-dev.3.10

if [[ ! -f "$tools/vtk-$vtk" ]]; then
  python3 -m venv "$tools/python"
  "$tools/python/bin/pip" install --quiet --disable-pip-version-check "vtk==$vtk"
  touch "$tools/vtk-$vtk"
fi
if [[ ! -f "$tools/validator-$validator" ]]; then
  npm install --silent --no-audit --no-fund --prefix "$tools" "gltf-validator@$validator"
  touch "$tools/validator-$validator"
fi
"$tools/python/bin/python" -B tests/export/outside_programs.py "${1:-build/floatframe}" examples "$tools"
