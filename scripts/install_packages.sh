#!/usr/bin/env bash
# Installs what Floatframe needs to be built and tested on Debian 12 or Ubuntu 24.04 (and their relatives).
#
#   scripts/install_packages.sh [--check | --docs | --viewer | --decks | --figures | --fmu]
#
# Runs nothing when everything is there. Otherwise prints what is missing and installs it, through sudo when not
# root. Exit code 1, with the command to run, when it cannot install. --check only looks; --docs: with what the reference
# of the C++ interface is made with; --viewer: with the browser that the page of a run is tested in;
# --decks: with CalculiX and its decks, which readers are tested with; --figures: with what counts instructions;
# --fmu: with the compiler for Windows and Wine, for FMUs that run there too.
#
# Node builds that page. It is looked for as commands, since a Node from elsewhere conflicts with the packages of the
# system; without it there is a note and the program writes reports with static curves.
set -euo pipefail

packages=(
  g++ cmake ninja-build make pkg-config python3
  libeigen3-dev libyaml-cpp-dev libfmt-dev libcli11-dev nlohmann-json3-dev
  libgtest-dev libbenchmark-dev
  libopenmpi-dev openmpi-bin
  libspectra-dev libmetis-dev libmumps-seq-dev libopenblas0-pthread zlib1g-dev
)

check_only=no
if [[ "${1:-}" == "--check" ]]; then
  check_only=yes
elif [[ "${1:-}" == "--docs" ]]; then
  packages+=(doxygen)
elif [[ "${1:-}" == "--viewer" ]]; then
  command -v chromium >/dev/null || command -v chromium-browser >/dev/null || command -v google-chrome >/dev/null ||
    packages+=(chromium)
elif [[ "${1:-}" == "--decks" ]]; then
  packages+=(calculix-ccx calculix-ccx-test)
elif [[ "${1:-}" == "--figures" ]]; then
  packages+=(valgrind)
elif [[ "${1:-}" == "--fmu" ]]; then
  packages+=(g++-mingw-w64-x86-64-posix wine64 valgrind)
elif [[ $# -gt 0 ]]; then
  echo "usage: $0 [--check | --docs | --viewer | --decks | --figures | --fmu]" >&2
  exit 2
fi

# Not a Debian system: the compiler's tools can be looked for, the libraries are left to CMake to find.
if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  missing_tools=()
  for tool in g++ cmake ninja make python3; do
    command -v "$tool" >/dev/null || missing_tools+=("$tool")
  done
  if [[ ${#missing_tools[@]} -eq 0 ]]; then
    echo "This is not a Debian or Ubuntu system: the tools are there, libraries are looked for by CMake."
    exit 0
  fi
  {
    echo "This is not a Debian or Ubuntu system and these tools are missing: ${missing_tools[*]}"
    echo "Install them and the libraries Eigen 3.4, yaml-cpp, fmt, CLI11, nlohmann-json, zlib, Spectra, METIS,"
    echo "GoogleTest and Google Benchmark (and, for sweeps on several processes, MPI; for large parts, the"
    echo "sequential MUMPS with OpenBLAS) with the system's package manager. On Debian the packages are called:"
    echo "  ${packages[*]}"
  } >&2
  exit 1
fi

find_missing() {
  missing=()
  local package state
  for package in "${packages[@]}"; do
    state=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
    [[ "$state" == "installed" ]] || missing+=("$package")
  done
}

# Node and npm, wanted but not needed. A Node from elsewhere brings its npm; Debian's would be in its way.
install_node() {
  command -v node >/dev/null && return
  local root=(env)
  [[ $(id -u) -eq 0 ]] || root=(sudo -n env)
  echo "Installing what builds the page of a run: nodejs npm"
  node_packages() {
    "${root[@]}" DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=300 "$@" >/dev/null 2>&1
  }
  if ! node_packages install -y --no-install-recommends nodejs npm &&
    ! { node_packages update && node_packages install -y --no-install-recommends nodejs npm; }; then
    echo "Note: nodejs and npm could not be installed, so runs will have no report.html."
    echo "With Node 18 or later and npm (from anywhere) the next build has it."
  fi
}

find_missing
if [[ ${#missing[@]} -eq 0 ]]; then
  [[ "$check_only" == yes ]] || install_node
  exit 0
fi

echo "Missing packages: ${missing[*]}"
if [[ "$check_only" == yes ]]; then
  exit 1
fi

give_up() {
  {
    echo "$1"
    echo "Please run this, then try again:"
    echo "  sudo apt-get update && sudo apt-get install -y --no-install-recommends ${missing[*]}"
  } >&2
  exit 1
}

if [[ $(id -u) -eq 0 ]]; then
  as_root=(env)
elif command -v sudo >/dev/null; then
  # A person at a terminal may type a password; a script must not hang on the question.
  if [[ -t 0 && -t 2 ]] || sudo -n true 2>/dev/null; then
    as_root=(sudo env)
  else
    give_up "Not root, and sudo needs a password that nobody is here to type."
  fi
else
  give_up "Not root, and there is no sudo."
fi

apt() {
  "${as_root[@]}" DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=300 "$@"
}
# The package lists of a fresh machine or container are empty or old: refresh them only if something is not in them.
have_candidates() {
  apt-get install --simulate --no-install-recommends -y "${missing[@]}" >/dev/null 2>&1
}

if ! have_candidates; then
  echo "Refreshing the package lists: apt-get update"
  apt update || give_up "The package lists could not be refreshed."
fi
echo "Installing: apt-get install -y --no-install-recommends ${missing[*]}"
if ! apt install -y --no-install-recommends "${missing[@]}"; then
  # Lists that name versions no longer on the mirror.
  apt update && apt install -y --no-install-recommends "${missing[@]}" ||
    give_up "The packages could not be installed."
fi

find_missing
[[ ${#missing[@]} -eq 0 ]] || give_up "Still missing after the installation: ${missing[*]}"
install_node
