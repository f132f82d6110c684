#!/bin/bash
# bench/compare.sh COMMIT [ROUNDS] [SECONDS] [OPTION...]
#
# Compares the speed of the working tree with that of COMMIT. Builds the benchmark of both: COMMIT's
# engine with the benchmark of the working tree, or with its own if that does not compile. Runs the two
# alternately on one processor, and prints the median ratio of the rates, working tree / COMMIT, for
# every scene that both have (above 1: faster), then the ratios of the other measured values, then the
# scenes that only one of them has. OPTIONs, such as --full or --width all, go to both.
set -eu
if [ $# -lt 1 ] || [ "$1" = -h ] || [ "$1" = --help ]; then
    sed -n '2,/^set/p' "$0" | sed -e '$d' -e 's/^# \{0,1\}//'
    [ $# -ge 1 ] && exit 0 || exit 2
fi
home=$(dirname "$(dirname "$(readlink -f "$0")")")
rounds=${2:-5} seconds=${3:-0.5}
options=("${@:4}")
commit=$(git -C "$home" rev-parse --verify --quiet "$1^{commit}") ||
    { echo "compare.sh: error: there is no commit '$1'." >&2; exit 2; }
work=$home/build/compare
mkdir -p "$work"
trap 'git -C "$home" worktree prune' EXIT
if [ ! -d "$work/source-$commit" ]; then
    git -C "$home" worktree add --quiet --detach "$work/source-$commit" "$commit"
fi

build() { # source, build folder
    cmake -S "$1" -B "$2" -G Ninja -DCMAKE_BUILD_TYPE=Release -DSWIRL_TESTS=OFF >"$2.log" &&
        ninja -C "$2" swirl_bench >>"$2.log"
}
copy_benchmark() { # source
    rm -rf "$1/bench"
    cp -r "$home/bench" "$1/bench"
}
echo "building the working tree and $commit" >&2
build "$home" "$work/new" || { tail -20 "$work/new.log" >&2; exit 1; }
old=$work/source-$commit
copy_benchmark "$old"
if ! build "$old" "$work/old-$commit"; then
    echo "compare.sh: with its own benchmark; see $work/old-$commit.log" >&2
    git -C "$old" checkout --quiet -- bench
    git -C "$old" clean --quiet -fd bench
    build "$old" "$work/old-$commit" || { tail -20 "$work/old-$commit.log" >&2; exit 1; }
fi

processor=$(taskset -cp $$ | sed 's/.*[^0-9]//') # the last that we may use
for round in $(seq "$rounds"); do
    echo "round $round of $rounds" >&2
    for which in "old-$commit" new; do
        taskset -c "$processor" "$work/$which/bench/swirl_bench" --quiet --seconds "$seconds" "${options[@]}" \
            --json "$work/${which%%-*}-$round.json" >/dev/null
    done
done
/usr/bin/python3 "$home/bench/ratios.py" "$work" "$rounds"
