#!/bin/bash
# bench/compare.sh COMMIT [ROUNDS] [SECONDS]
#
# Is the working tree faster than COMMIT? Builds both, runs their `swirl bench` in turns (so that a
# machine that is busy now and idle later treats both alike), and prints for every scene the median
# of the ratios of their rates, working tree over COMMIT. Above 1: faster.
set -eu
if [ $# -lt 1 ] || [ "$1" = -h ] || [ "$1" = --help ]; then
    sed -n '2,/^set/p' "$0" | sed -e '$d' -e 's/^# \{0,1\}//'
    [ $# -ge 1 ] && exit 0 || exit 2
fi
home=$(dirname "$(dirname "$(readlink -f "$0")")")
rounds=${2:-5} seconds=${3:-1}
commit=$(git -C "$home" rev-parse --verify --quiet "$1^{commit}") ||
    { echo "compare.sh: there is no commit '$1'." >&2; exit 2; }
work=$home/build/compare
mkdir -p "$work"
trap 'git -C "$home" worktree prune' EXIT
if [ ! -d "$work/source-$commit" ]; then
    git -C "$home" worktree add --quiet --detach "$work/source-$commit" "$commit"
fi

build() { # source, build folder
    cmake -S "$1" -B "$2" -G Ninja -DCMAKE_BUILD_TYPE=Release -DSWIRL_TESTS=OFF >"$2.log"
    ninja -C "$2" swirl >>"$2.log" || { tail -20 "$2.log" >&2; exit 1; }
}
echo "building the working tree and $commit" >&2
build "$home" "$work/new"
build "$work/source-$commit" "$work/old-$commit"

for round in $(seq "$rounds"); do
    echo "round $round of $rounds" >&2
    "$work/old-$commit/swirl" bench --quiet --seconds "$seconds" --json "$work/old-$round.json" >/dev/null
    "$work/new/swirl" bench --quiet --seconds "$seconds" --json "$work/new-$round.json" >/dev/null
done
/usr/bin/python3 - "$work" "$rounds" <<'END'
import json, statistics, sys
work, rounds = sys.argv[1], int(sys.argv[2])
ratios = {}
for k in range(1, rounds + 1):
    old, new = (json.load(open(f"{work}/{which}-{k}.json")) for which in ("old", "new"))
    for a, b in zip(old["rows"], new["rows"]):
        ratios.setdefault((b["scene"], b["discs"]), []).append(b["rate"] / a["rate"])
for (scene, discs), r in ratios.items():
    print(f"{scene:<20}{discs:>8}  {statistics.median(r):6.3f}   ({min(r):.3f} to {max(r):.3f})")
END
