"""bench/table.py RUN.csv...: prints the files of `bench/run --csv` as Markdown tables.

For several runs it prints the median and the range. bench/results/README.md explains the columns.
"""

import csv
import statistics
import sys


def read(files):
    """The rows of all runs by scene, discs and width, in the order of the first run."""
    found = {}
    for name in files:
        with open(name, newline="", encoding="utf-8") as f:
            for row in csv.DictReader(f):
                found.setdefault((row["scene"], int(row["discs"]), row["width"]), []).append(row)
    return found


def number(x):
    """Three significant digits."""
    for digits in (0, 1, 2, 3):
        if x >= 100 / 10**digits:
            return f"{x:.{digits}f}"
    return f"{x:.2g}"


def middle(values, unit=1.0):
    values = sorted(v / unit for v in values)
    ends = [number(values[0]), number(values[-1])]
    text = number(statistics.median(values))
    return text if ends[0] == ends[1] else f"{text} ({ends[0]} to {ends[1]})"


def discs(n):
    powers = {1000: "10³", 10000: "10⁴", 100000: "10⁵", 1000000: "10⁶"}
    return powers.get(n, str(n))


def numbers(rows, column):
    return [float(row[column]) for row in rows if row[column]]


def tables(found):
    lines = [
        "| scene | N | engine | baseline | baseline rate | ratio | invalidated | rebuilt |",
        "|---|---|---|---|---|---|---|---|",
    ]
    several = len({width for _, _, width in found}) > 1
    for (scene, n, width), rows in found.items():
        rates, baselines = numbers(rows, "rate"), numbers(rows, "baseline_rate")
        ratios = [rate / baseline for rate, baseline in zip(rates, baselines)]
        lines.append(
            f"| {scene}{', ' + width if several else ''} | {discs(n)} | {middle(rates, 1e6)} "
            f"| {' or '.join(sorted({row['baseline'] for row in rows if row['baseline']}))} "
            f"| {middle(baselines, 1e6) if baselines else ''} | {middle(ratios) if ratios else ''} "
            f"| {number(statistics.median(numbers(rows, 'invalidated_per_event')))} "
            f"| {number(statistics.median(numbers(rows, 'list_rebuilds_per_event')))} |"
        )
    lines += ["", "| compared | N | by | value |", "|---|---|---|---|"]
    for (scene, n, width), rows in found.items():
        values = numbers(rows, "compared")
        if values:
            lines.append(
                f"| {scene}{', ' + width if several else ''} | {discs(n)} "
                f"| {rows[0]['comparison']} | {middle(values)} |"
            )
    return lines


def main(files):
    if not files or files[0] in ("-h", "--help"):
        print(__doc__.strip())
        return 0 if files else 2
    try:
        found = read(files)
    except OSError as error:
        print(f"error: '{error.filename}': {error.strerror}.", file=sys.stderr)
        return 2
    first = next(iter(found.values()))[0]
    print(
        f"{first['machine']}, swirl {first['version']}, `{first['command']}`"
        f"{f', {len(files)} runs' if len(files) > 1 else ''}\n"
    )
    print("\n".join(tables(found)))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
