#!/bin/bash
# bench/compare.sh COMMIT [ROUNDS] [SECONDS] [OPTION...]
#
# Is the working tree faster than COMMIT? Builds both, COMMIT's engine with the benchmark of the
# working tree if it can be had so (or some scenes would be missing), else with its own; runs their
# `swirl bench` in turns (so that a machine that is busy now and idle later treats both alike), on
# one processor (for two may differ); and prints for every scene that both have the median of the
# ratios of their rates, working tree over COMMIT. Above 1: faster. What is measured besides rates
# comes after that, new over old, and at the end the names of what only one of them has. OPTIONs go
# to both, as --full or --width all.
set -eu
if [ $# -lt 1 ] || [ "$1" = -h ] || [ "$1" = --help ]; then
    sed -n '2,/^set/p' "$0" | sed -e '$d' -e 's/^# \{0,1\}//'
    [ $# -ge 1 ] && exit 0 || exit 2
fi
home=$(dirname "$(dirname "$(readlink -f "$0")")")
rounds=${2:-5} seconds=${3:-0.5}
options=("${@:4}")
commit=$(git -C "$home" rev-parse --verify --quiet "$1^{commit}") ||
    { echo "compare.sh: there is no commit '$1'." >&2; exit 2; }
work=$home/build/compare
mkdir -p "$work"
trap 'git -C "$home" worktree prune' EXIT
if [ ! -d "$work/source-$commit" ]; then
    git -C "$home" worktree add --quiet --detach "$work/source-$commit" "$commit"
fi

build() { # source, build folder
    cmake -S "$1" -B "$2" -G Ninja -DCMAKE_BUILD_TYPE=Release -DSWIRL_TESTS=OFF >"$2.log" &&
        ninja -C "$2" swirl >>"$2.log"
}
give_todays_benchmark() { # source
    rm -rf "$1"/src/swirl/study/bench* "$1/src/swirl/study/rival"
    cp -r "$home"/src/swirl/study/bench* "$home/src/swirl/study/rival" "$1/src/swirl/study"
    cp "$home/src/swirl/cli/command_bench.cpp" "$1/src/swirl/cli"
}
echo "building the working tree and $commit" >&2
build "$home" "$work/new" || { tail -20 "$work/new.log" >&2; exit 1; }
old=$work/source-$commit
give_todays_benchmark "$old"
if ! build "$old" "$work/old-$commit"; then
    echo "compare.sh: with its own benchmark; see $work/old-$commit.log" >&2
    git -C "$old" checkout --quiet -- src
    git -C "$old" clean --quiet -fd src
    build "$old" "$work/old-$commit" || { tail -20 "$work/old-$commit.log" >&2; exit 1; }
fi

processor=$(taskset -cp $$ | sed 's/.*[^0-9]//') # the last that we may use
for round in $(seq "$rounds"); do
    echo "round $round of $rounds" >&2
    for which in "old-$commit" new; do
        taskset -c "$processor" "$work/$which/swirl" bench --quiet --seconds "$seconds" "${options[@]}" \
            --json "$work/${which%%-*}-$round.json" >/dev/null
    done
done
/usr/bin/python3 "$home/bench/ratios.py" "$work" "$rounds"
