"""bench/ratios.py FOLDER ROUNDS: prints the median ratios for compare.sh, from old-K.json and
new-K.json."""

import argparse
import csv
import json
import statistics
import sys


def measured(file):
    """Rates by scene, discs and width; and all named values except rates and ratios to a
    baseline."""
    with open(file, encoding="utf-8") as f:
        result = json.load(f)
    rates = {(row["scene"], row["discs"], row["width"]): row["rate"] for row in result["rows"]}
    others = {
        target["name"]: target["value"]
        for target in result["targets"]
        if "per second" not in target["name"] and not target["name"].startswith("rate over the")
    }
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


def instruction_ratios(folder):
    """Instructions per event, new / old, of the scenes of instructions_test.py."""
    counts = []
    for which in ("old", "new"):
        with open(f"{folder}/{which}-instructions.json", encoding="utf-8") as f:
            counts.append(json.load(f))
    return {
        scene: [counts[1][scene] / old] for scene, old in counts[0].items() if scene in counts[1]
    }


def write_csv(file, tables):
    with open(file, "w", newline="", encoding="utf-8") as f:
        lines = csv.writer(f)
        lines.writerow(["what", "scene", "ratio", "lowest", "highest", "pairs"])
        for title, found in tables.items():
            for key, r in found.items():
                lines.writerow(
                    [
                        title.split(",")[0],
                        words(key),
                        f"{statistics.median(r):.4f}",
                        f"{min(r):.4f}",
                        f"{max(r):.4f}",
                        len(r),
                    ]
                )


def main(folder, rounds, csv_file, with_instructions):
    runs = [
        [measured(f"{folder}/{which}-{k}.json") for which in ("old", "new")]
        for k in range(1, rounds + 1)
    ]
    tables = {
        title: ratios([(old[part], new[part]) for old, new in runs])
        for title, part in (("rates, new / old", 0), ("other values, new / old", 1))
    }
    if with_instructions:
        tables["instructions per event, new / old"] = instruction_ratios(folder)
    for title, found in tables.items():
        if found:
            print(title)
        for key, r in found.items():
            print(f"  {words(key):<64}{statistics.median(r):7.3f}   ({min(r):.3f} to {max(r):.3f})")
    (old, _), (new, _) = runs[0]
    for title, keys in (
        ("only new", new.keys() - old.keys()),
        ("only old", old.keys() - new.keys()),
    ):
        if keys:
            print(f"{title}: " + "; ".join(sorted(map(words, keys))))
    if csv_file:
        write_csv(csv_file, tables)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder")
    parser.add_argument("rounds", type=int)
    parser.add_argument("--csv", help="file for all ratios")
    parser.add_argument(
        "--instructions",
        action="store_true",
        help="also compare old-instructions.json and new-instructions.json",
    )
    given = parser.parse_args()
    main(given.folder, given.rounds, given.csv, given.instructions)
