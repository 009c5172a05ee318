#!/usr/bin/env bash
# All tests: installs what they need, builds both flavours from this tree, runs them.
#
#   Testing/run-tests.sh
#
# paraview  the core, the module, its Python wrapping and the plugin with Debian's ParaView
# vtk       the module and its Python wrapping with Debian's plain VTK; where that cannot be
#           installed beside ParaView, it is unpacked below build
set -euo pipefail
cd "$(dirname "$0")/.."

step() { printf '\n== %s\n' "$*"; }

mkdir -p build
step "Packages"
.ci/install-packages test

for flavour in paraview vtk; do
  step "$flavour: configure and build"
  cmake --preset "$flavour" > "build/$flavour.log" 2>&1 || { cat "build/$flavour.log"; exit 1; }
  cmake --build --preset "$flavour"
done

passed=0 failed=0
for flavour in paraview vtk; do
  step "$flavour: test"
  report=build/$flavour-tests.xml
  rm -f "$report"
  ctest --preset "$flavour" --output-junit "$PWD/$report" || echo "$flavour: see the failures above"
  count() { sed -n "s/^\s*$1=\"\([0-9]*\)\".*/\1/p" "$report"; }
  failed=$((failed + $(count failures)))
  passed=$((passed + $(count tests) - $(count failures) - $(count skipped)))
done

printf '\n%d passed, %d failed\n' "$passed" "$failed"
[ "$failed" -eq 0 ]
