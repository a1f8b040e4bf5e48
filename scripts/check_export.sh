#!/usr/bin/env bash
# What other programs find in the files of `floatframe export`: VTK (PyPI) and Khronos' validator of glTF (npm), fetched into
# build/export_tools the first time. Needs a network then, python3 with venv, node and npm.
#
#   scripts/check_export.sh [--blender] [path to floatframe]
#
# --blender: also in Blender 4.2 (bpy from PyPI, 350 MB, for Python 3.11).
set -euo pipefail
cd "$(dirname "$0")/.."
blender=no
if [[ "${1:-}" == "--blender" ]]; then
  blender=yes
  shift
fi
program=${1:-build/floatframe}
tools=build/export_tools
vtk=9.7.2
validator=2.0.0-dev.3.10

# A machine without them, or without a network, has nothing to compare with: that is said, and no error.
skip() {
  echo "SKIPPED: exported files were not opened in other programs: $1" >&2
  exit 0
}
if [[ ! -f "$tools/vtk-$vtk" ]]; then
  python3 -m venv "$tools/python" || skip "python3 has no venv (Debian: python3-venv)"
  "$tools/python/bin/pip" install --quiet --disable-pip-version-check "vtk==$vtk" || skip "vtk $vtk could not be fetched"
  touch "$tools/vtk-$vtk"
fi
if [[ ! -f "$tools/validator-$validator" ]]; then
  npm install --silent --no-audit --no-fund --prefix "$tools" "gltf-validator@$validator" || skip "gltf-validator could not be fetched"
  touch "$tools/validator-$validator"
fi
"$tools/python/bin/python" -c "import vtkmodules.vtkIOXML" || skip "vtk $vtk does not load here"
"$tools/python/bin/python" -B tests/export/outside_programs.py "$program" examples "$tools"

if [[ "$blender" == yes ]]; then
  bpy=4.2.0
  if [[ ! -f "$tools/bpy-$bpy" ]]; then
    python3.11 -m venv "$tools/blender"
    "$tools/blender/bin/pip" install --quiet --disable-pip-version-check "bpy==$bpy"
    touch "$tools/bpy-$bpy"
  fi
  scenes=()
  for example in slider_crank spin_up rotor iltis iltis_solid; do
    "$program" run "examples/$example/$example.yaml" --out "$tools/runs/$example" --quiet --no-report
    "$program" export "$tools/runs/$example" --glb "$tools/runs/$example.glb" --every 10
    scenes+=("$tools/runs/$example.glb")
  done
  "$tools/blender/bin/python" -B tests/export/in_blender.py "${scenes[@]}"
fi
