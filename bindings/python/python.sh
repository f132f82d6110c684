#!/bin/sh
# Python with the module `swirl` on its path: builds it when it is out of date, then becomes Debian's
# python3 with the arguments that are left.
set -eu
home=$(dirname "$(dirname "$(dirname "$(readlink -f "$0")")")")
me=swirl
long="three minutes or so"
. "$home/cmake/launcher.sh"

build release "build python" bindings/python swirl_python
# An empty entry would be the current folder, and what lies there would replace modules.
others=$(printf %s "${PYTHONPATH-}" | sed -e 's/::*/:/g' -e 's/^://' -e 's/:$//')
PYTHONPATH=$home/build/release/python${others:+:$others} exec /usr/bin/python3 "$@"
