#!/bin/sh
# make.sh SWIRL FOLDER: the files of tests/io/version_1/files.tar.xz, with the program SWIRL.
# They were made once, by swirl 0.1.0 (1ee2817), and must not be made again: tests/cli/versions_test.py
# checks that every later program reads them. A new format gets its own folder.
set -eu
swirl=$(readlink -f "$1")
mkdir -p "$2"
cd "$2"

cat > run.toml <<'END'
discs = 8
periods = 20
warmup = 5
seed = 3
END
for body in discs spheres; do
    bodies=
    [ $body = discs ] || bodies="--preset experiment"
    run="$swirl run run.toml $bodies --quiet"
    $run --measure slip,pinned --json $body.json --trajectory $body.h5 --frames 1
    $run --periods 6 --log-events ${body}_events.h5
    # The state after 20 periods, and the result of 40.
    $run --measure slip --json $body.20.json --checkpoint $body.checkpoint --keep-checkpoint
    $run --measure slip --periods 40 --json $body.40.json
    # A run that was stopped in the middle, with its unfinished recordings, and its result.
    long="$run --events 4e6 --frame-events 200000"
    $long --json ${body}_whole.json --trajectory ${body}_whole.h5
    timeout --signal INT 0.7 $long --json ${body}_stopped.json --trajectory ${body}_stopped.h5 \
        --checkpoint ${body}_stopped.checkpoint || [ $? -eq 124 ]
    ls ${body}_stopped.checkpoint ${body}_stopped.h5.partial >/dev/null
    rm ${body}_whole.h5
done

$swirl sweep --discs 5,8 --seeds 2 --periods 12 --warmup 2 --out sweep --quiet
$swirl collect sweep --csv sweep.csv

$swirl film-test --discs 12 --container-radius 5 --scale 12 --width 200 --height 200 --frames 45 \
    --frames-per-period 30 --out film.mp4 --quiet
$swirl track film.mp4 --out tracks.h5 --quiet
$swirl track film.mp4 --out tracks.csv --quiet
$swirl measure tracks.h5 --json tracks.json --quiet
rm film.* ./*_stopped.json
