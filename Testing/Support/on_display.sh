#!/usr/bin/env bash
# Runs a command on a display of its own without a screen: on_display.sh SIZE COMMAND...
#
# The server chooses a free number by itself, so that any number of tests can start at once. (xvfb-run looks for a free number before
# its server takes it.)
set -euo pipefail
size=$1
shift
# Without -noreset the server may reset between two connections.
exec {numbers}< <(exec Xvfb -displayfd 3 -screen 0 "${size}x24" -noreset 3>&1 1>&2)
trap "kill $!" EXIT
read -r number <&"$numbers" || { echo "Xvfb has not started" >&2; exit 1; }
DISPLAY=:$number "$@"
