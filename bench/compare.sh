#!/bin/bash
# bench/run --compare COMMIT [ROUNDS] [SECONDS] [OPTION...]
#
# Compares the speed of the working tree with that of COMMIT. Builds the benchmark of both: COMMIT's
# engine with the benchmark of the working tree, or with its own if that does not compile. Runs the two
# alternately on one processor, and prints the median ratio of the rates, working tree / COMMIT, for
# every scene that both have (above 1: faster), then the ratios of the other measured values, then the
# scenes that only one of them has. With valgrind it also counts the instructions per event of both.
# All ratios are written to build/compare/DATE_PROCESSOR_NEW_OLD.csv (bench/results/README.md).
# ROUNDS is 5, SECONDS for each rate is 0.5. OPTIONs, such as --full or --width all, go to both.
set -eu
if [ $# -lt 1 ] || [ "$1" = -h ] || [ "$1" = --help ]; then
    sed -n '2,/^set/p' "$0" | sed -e '$d' -e 's/^# \{0,1\}//'
    [ $# -ge 1 ] && exit 0 || exit 2
fi
home=$(dirname "$(dirname "$(readlink -f "$0")")")
rounds=${2:-5} seconds=${3:-0.5}
options=("${@:4}")
commit=$(git -C "$home" rev-parse --verify --quiet "$1^{commit}") ||
    { echo "bench/run: error: there is no commit '$1'." >&2; exit 2; }
work=$home/build/compare
mkdir -p "$work"
trap 'git -C "$home" worktree prune' EXIT
if [ ! -d "$work/source-$commit" ]; then
    git -C "$home" worktree add --quiet --detach "$work/source-$commit" "$commit"
fi

build() { # source, build folder
    cmake -S "$1" -B "$2" -G Ninja -DCMAKE_BUILD_TYPE=Release -DSWIRL_TESTS=OFF >"$2.log" &&
        ninja -C "$2" swirl_bench count_instructions >>"$2.log"
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
    echo "bench/run: with its own benchmark; see $work/old-$commit.log" >&2
    git -C "$old" checkout --quiet -- bench
    git -C "$old" clean --quiet -fd bench
    build "$old" "$work/old-$commit" || { tail -20 "$work/old-$commit.log" >&2; exit 1; }
fi

processor=$(taskset -cp $$ | sed 's/.*[^0-9]//') # the last one that this process may use
for round in $(seq "$rounds"); do
    echo "round $round of $rounds" >&2
    for which in "old-$commit" new; do
        taskset -c "$processor" "$work/$which/bench/swirl_bench" --quiet --seconds "$seconds" "${options[@]}" \
            --json "$work/${which%%-*}-$round.json" >/dev/null
    done
done
counts=()
if command -v valgrind >/dev/null; then
    echo "counting instructions" >&2
    for which in "old-$commit" new; do
        SWIRL_COUNT_INSTRUCTIONS=$work/$which/bench/count_instructions \
            /usr/bin/python3 -B "$home/bench/instructions_test.py" --json >"$work/${which%%-*}-instructions.json"
    done
    counts=(--instructions)
fi
machine=$(sed -n 's/^model name[^:]*: *//p' /proc/cpuinfo | head -1 | tr 'A-Z ' 'a-z-')
name=$(date +%F)_${machine:-unknown}_$(git -C "$home" describe --always --dirty --exclude '*')_${commit:0:7}.csv
/usr/bin/python3 -B "$home/bench/ratios.py" "$work" "$rounds" --csv "$work/$name" "${counts[@]}"
echo "written: $work/$name" >&2
