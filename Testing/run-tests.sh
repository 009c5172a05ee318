#!/usr/bin/env bash
# All tests: installs what they need, builds flavours from this tree, runs their tests.
#
#   Testing/run-tests.sh [FLAVOUR...]
#
# paraview  the core, the module, its Python wrapping and the plugin with Debian's ParaView
# vtk       the module and its Python wrapping with Debian's plain VTK; where that cannot be
#           installed beside ParaView, it is unpacked below build
#
# These two are all, and the default. Three more take longer than what they test; a part of that is run:
#
# vtk-asan   random inputs, under the address and undefined-behaviour sanitizers
# core-tsan  whole solves in several threads, under the thread sanitizer
# core-debug meshes, drawing and quads without optimisation, with all assertions
set -euo pipefail
cd "$(dirname "$0")/.."

step() { printf '\n== %s\n' "$*"; }

# Runs a command, and notes its minutes under a name.
minutes=
timed() {
  local name=$1 begin=$SECONDS status=0
  shift
  "$@" || status=$?
  minutes+=$(printf '%-18s %5.1f' "$name" "$(((SECONDS - begin) * 10 / 60))e-1")$'\n'
  return $status
}

# Builds a preset; further arguments are those of cmake --build. Without a compiler cache that knows the sources, precompiled
# headers take half of the time away. One flavour goes without, since it notices where a source includes too little.
build() {
  step "$1: configure and build"
  local precompiled=ON
  [ "$1" = vtk-asan ] && precompiled=OFF
  cmake --preset "$1" "-DDMG_PRECOMPILED_HEADERS=$precompiled" > "build/$1.log" 2>&1 || { cat "build/$1.log"; exit 1; }
  timed "$1: build" cmake --build --preset "$@"
}

# Runs a preset's tests and counts them; further arguments are those of ctest.
run() {
  step "$1: test"
  local report=build/$1-tests.xml
  rm -f "$report"
  timed "$1: test" ctest --preset "$@" --parallel "$(nproc)" --output-junit "$PWD/$report" || {
    echo "$1: see the failures above"
    all_well=no # also where ctest finds no test
  }
  count() { sed -n "s/^\s*$1=\"\([0-9]*\)\".*/\1/p" "$report"; }
  failed=$((failed + $(count failures)))
  skipped=$((skipped + $(count skipped)))
  passed=$((passed + $(count tests) - $(count failures) - $(count skipped)))
}

mkdir -p build
# ccache leaves sources with precompiled headers alone unless it is told so. Paths are relative for it, so that a flavour takes
# what another one has compiled in the same way: the core, most of all.
export CCACHE_SLOPPINESS=pch_defines,time_macros CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1
passed=0 failed=0 skipped=0 all_well=yes
before=$(git status --porcelain 2>/dev/null) || before="no working tree of git"
step "Packages"
.ci/install-packages test

if [ $# -eq 0 ]; then
  set -- paraview vtk
fi
for flavour; do
  case $flavour in
    vtk-asan) build vtk-asan --target FuzzFilters ;;
    core-tsan) build core-tsan --target TestCore ;;
    core-debug) build core-debug --target TestMesh TestDrawing TestQuads ;;
    *) build "$flavour" ;;
  esac
done
for flavour; do
  case $flavour in
    vtk-asan) run vtk-asan --tests-regex '^Fuzz[.]' ;;
    core-tsan) run core-tsan --tests-regex '^(Harmonic|Smoothest)Field[.].*ForAnyNumberOfThreads$' ;;
    core-debug) run core-debug --tests-regex '^[A-Za-z]+[.]' --exclude-regex '^(QuadMesh|QuadReport|QuadProgress|QuadSizes|SymmetricQuads|MirrorPlane|Checks|Examples|Benchmarks|Documentation)[.]' ;;
    *) run "$flavour" ;;
  esac
done

step "Working tree"
after=$(git status --porcelain 2>/dev/null) || after="no working tree of git"
if [ "$before" = "no working tree of git" ]; then
  echo "$before: not looked at"
  skipped=$((skipped + 1))
elif [ "$after" = "$before" ]; then
  echo "clean"
  passed=$((passed + 1))
else
  echo "tests have left something that git sees:"
  diff <(echo "$before") <(echo "$after") || all_well=no
  failed=$((failed + 1))
fi

step "Minutes"
printf '%s' "$minutes"
printf '\n%d passed, %d failed, %d skipped\n' "$passed" "$failed" "$skipped"
[ "$all_well" = yes ]
