"""bench/ratios.py FOLDER ROUNDS: prints the median ratios for compare.sh, from old-K.json and new-K.json."""

import json
import statistics
import sys


def measured(file):
    """Rates by scene, discs and width; and all named values except rates and ratios to a baseline."""
    with open(file) as f:
        result = json.load(f)
    rates = {(row["scene"], row["discs"], row["width"]): row["rate"] for row in result["rows"]}
    others = {target["name"]: target["value"] for target in result["targets"]
               if "per second" not in target["name"] and not target["name"].startswith("rate over the")}
    return rates, others


def ratios(pairs):
    """The ratios new / old in every round, for all keys that both versions have."""
    found = {}
    for old, new in pairs:
        for key, value in new.items():
            if key in old:
                found.setdefault(key, []).append(value / old[key])
    return found


def words(key):
    return key if isinstance(key, str) else f"{key[0]}, N = {key[1]}, {key[2]}"


def main(folder, rounds):
    runs = [[measured(f"{folder}/{which}-{k}.json") for which in ("old", "new")]
            for k in range(1, rounds + 1)]
    for title, part in (("rates, new / old", 0), ("other values, new / old", 1)):
        found = ratios([(old[part], new[part]) for old, new in runs])
        if found:
            print(title)
        for key, r in found.items():
            print(f"  {words(key):<64}{statistics.median(r):7.3f}   ({min(r):.3f} to {max(r):.3f})")
    (old, _), (new, _) = runs[0]
    for title, keys in (("only new", new.keys() - old.keys()), ("only old", old.keys() - new.keys())):
        if keys:
            print(f"{title}: " + "; ".join(sorted(map(words, keys))))


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]))
