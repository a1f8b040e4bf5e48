#!/bin/sh
# Pictures of the examples of the course: examples/NAME/NAME.webp, from the 3-D view of a report (viewer/test/picture.ts).
#   scripts/example_pictures.sh [PROGRAM]       PROGRAM: build/floatframe by default
set -e
cd "$(dirname "$0")/.."
root=$PWD
program=$(realpath "${1:-build/floatframe}")
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
picture() {  # name, time [s], scale of the deformation
  "$program" run "examples/$1/$1.yaml" --out "$out/$1" --quiet
  (cd viewer && node test/picture.mjs "$out/$1/report.html" "$root/examples/$1/$1.webp" "$2" "$3")
}
picture four_bar 0.1 1
picture gear_train 0.3 1
picture cam 0.002 1
picture robot_arm 0 10
picture scissor_lift 3 1
picture crane_with_trolley 12 100
