#!/bin/sh
# Runs the system's python3 with the module `swirl` on its path. Builds the module first if it is out
# of date.
set -eu
home=$(dirname "$(dirname "$(dirname "$(readlink -f "$0")")")")
me=swirl
long="about three minutes"
. "$home/cmake/launcher.sh"

build release "build python" bindings/python swirl_python
# An empty entry would be the current folder, whose files could replace modules.
others=$(printf %s "${PYTHONPATH-}" | sed -e 's/::*/:/g' -e 's/^://' -e 's/:$//')
PYTHONPATH=$home/build/release/python${others:+:$others} exec "$(system_python)" "$@"
