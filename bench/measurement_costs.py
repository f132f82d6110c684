"""bench/measurement_costs.py PROGRAM: prints the cost of each measurement as a Markdown table.

A cost is the processor time of a run that makes one measurement, relative to that of the same run
without. Each run is repeated, and its shortest time counts.
"""

import argparse
import resource
import shutil
import subprocess

RUN = ["run", "--discs", "48", "--periods", "120", "--warmup", "0", "--quiet"]


def seconds(program, measurements, repeats):
    shortest = float("inf")
    for _ in range(repeats):
        begin = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        subprocess.run(
            [program, *RUN, *measurements],
            check=True,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        shortest = min(shortest, resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - begin)
    return shortest


def names_of(program):
    """The measurements of --measure help: lines "name: what it is" without indent."""
    listed = subprocess.run(
        [program, "run", "--measure", "help"], check=True, capture_output=True, encoding="utf-8"
    ).stdout
    return [
        line.partition(":")[0]
        for line in listed.splitlines()
        if line and line[0].isalpha() and line[0].islower() and " " not in line.partition(":")[0]
    ]


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("program")
    parser.add_argument("--repeats", type=int, default=3)
    call = parser.parse_args()
    if not shutil.which(call.program):
        parser.error(f"there is no program '{call.program}'.")
    names = names_of(call.program)
    plain = seconds(call.program, [], call.repeats)
    lists = {name: name for name in names}
    lists["all but `fields`"] = ",".join(name for name in names if name != "fields")
    lists["all"] = "all"
    costs = {
        name: seconds(call.program, ["--measure", listed], call.repeats) / plain
        for name, listed in lists.items()
    }
    print("| measurement | cost |\n|---|---|")
    for name, cost in sorted(costs.items(), key=lambda item: item[1]):
        print(f"| {name if ' ' in name else f'`{name}`'} | {cost:.1f} |")


if __name__ == "__main__":
    main()
