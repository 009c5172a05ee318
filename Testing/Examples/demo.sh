#!/usr/bin/env bash
# From nothing to a picture: a smooth cross field on a scanned surface, in ParaView.
#
#   Testing/Examples/demo.sh [SURFACE]
#
# Installs the packages it needs (Debian 12 or later; as root or with sudo), builds the filters below build,
# and leaves demo.vtp, demo.pvsm and demo.png in the current folder. SURFACE is a PLY, OBJ, STL, OFF, VTK or VTP
# file; without it, the Stanford bunny from Debian's package libcgal-demo.
set -euo pipefail

here=$(pwd)
surface=${1:+$(realpath "$1")}
cd "$(dirname "$0")/../.."

step() { printf '\n== %s\n' "$*"; }

step "1/4 Packages"
.ci/install-packages

step "2/4 Build"
mkdir -p build
cmake --preset default > build/default.log 2>&1 || { cat build/default.log; exit 1; }
cmake --build --preset default

step "3/4 Surface"
if [ -z "$surface" ]; then
  .ci/unpack-packages build/data libcgal-demo
  surface=$PWD/build/data/bunny00.off
  tar --extract --gzip --to-stdout \
    --file build/data/usr/share/doc/libcgal-dev/data.tar.gz data/meshes/bunny00.off > "$surface"
fi
if [[ ${surface,,} == *.off ]]; then # ParaView has no reader for it
  ply=$PWD/build/$(basename "${surface%.*}").ply
  /usr/bin/python3 Testing/Examples/off_to_ply.py "$surface" "$ply"
  surface=$ply
fi
echo "$surface"

step "4/4 Field and picture"
plugins=$(dirname "$PWD"/build/default/lib*/paraview-*/plugins/*.plugins.xml)
runtime=$(mktemp -d)
trap 'rm -rf "$runtime"' EXIT
demo=$PWD/Testing/Examples/demo.py
cd "$here"
# ParaView needs a display to draw, even one without a screen.
XDG_RUNTIME_DIR=$runtime PV_PLUGIN_PATH=$plugins PYTHONDONTWRITEBYTECODE=1 \
  xvfb-run --auto-servernum --server-args="-screen 0 1280x1024x24 -noreset" \
  pvbatch "$demo" "$surface"
ls -l "$here/demo.vtp" "$here/demo.pvsm" "$here/demo.png"

step "To open the result in ParaView's window"
printf 'PV_PLUGIN_PATH=%q paraview --state=%q\n' "$plugins" "$here/demo.pvsm"
