#!/usr/bin/env bash
# Makes all pictures of the gallery again, from the installed plugin or that of PV_PLUGIN_PATH.
#
#   Testing/Examples/Gallery/gallery.sh [SCENE...]
#
# Needs a display or xvfb-run, ImageMagick, and for nothing_said and quads the lion of Debian's package libcgal-demo.
set -euo pipefail

here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../../.." && pwd)
pictures=$root/ParaViewPlugin/Documentation
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

scenes=("$@")
if [ $# -eq 0 ]; then
  scenes=(nothing_said how_many strokes features principal_directions fibres singularities noisy_flow measured_fibres handles
    moving_guides levels ocean scales organ_flow offset_lines paths carried decal shell way_in quads quad_way quad_map symmetry unit_length three_fields hatching convergence)
fi
for scene in "${scenes[@]}"; do
  arguments=()
  case $scene in
    nothing_said | quads)
      "$root/.ci/unpack-packages" "$root/build/data" libcgal-demo
      tar -xzOf "$root/build/data/usr/share/doc/libcgal-dev/data.tar.gz" data/meshes/lion-head.off > lion.off
      /usr/bin/python3 "$here/../off_to_ply.py" lion.off lion.ply
      arguments=(lion.ply) ;;
    three_fields) arguments=("$root/Data/double_torus.vtp") ;;
  esac
  PYTHONDONTWRITEBYTECODE=1 XDG_RUNTIME_DIR=$work xvfb-run --auto-servernum --server-args="-screen 0 1280x1024x24 -noreset" \
    pvbatch "$here/$scene.py" "${arguments[@]}"
done
for picture in *.png; do # 1200 pixels wide, in true colour, at most 390 KB
  name=${picture%.png}
  case $name in
    convergence | spectrum) target=$pictures/$name.png ;; # lines and letters
    *) target=$pictures/$name.jpg ;;
  esac
  convert "$picture" -trim -resize 1200x -bordercolor white -border 12x12 +repage -strip -define jpeg:extent=390KB "$target"
done
# The help scales pictures roughly: its pages show smaller ones, NAME_WIDTH, as they are.
grep -oh 'src="[a-z_]*_[0-9]*\.[a-z]*" width="[0-9]*" height="[0-9]*"' "$pictures"/*.html | sort -u | tr -c 'a-z0-9_.\n' ' ' |
  while read -r _ small _ width _ height; do
    convert "$pictures/${small/_$width/}" -resize "${width}x${height}!" -strip -quality 88 "$pictures/$small"
  done
ls -l "$pictures"
