"""The folders that can be continued, for folders_test.py: which calls make and continue each of
them, and how its files are compared."""

import json
import os

RUN = ["--discs", "5", "--periods", "4", "--warmup", "1"]

POINTS = "discs,seeds\n4,2\n5,1\n"
FURTHER_POINTS = "discs,mu\n6,0.5\n"

# Each call has FOLDER for the folder, and INPUT for the folder of its input files.
SWEEP = [
    [
        "sweep",
        "--discs",
        "4:6",
        "--mu",
        "0.1,1",
        "--periods",
        "3",
        "--warmup",
        "1",
        "--frames-per-period",
        "4",
        "--series",
        "--out",
        "FOLDER",
    ],
    ["collect", "FOLDER"],
]
GROWN = [
    ["sweep", "--discs", "4:6", "--periods", "3", "--warmup", "1", "--out", "FOLDER"],
    ["sweep", "--out", "FOLDER", "--grow", "--discs", "7", "--measure", "slip"],
    ["collect", "FOLDER"],
]
CHAIN = [
    ["sweep", "--mu", "0.1,0.5,1", *RUN, "--series", "--chain", "mu", "--out", "FOLDER"],
    ["collect", "FOLDER", "--loops", "FOLDER/loops.csv"],
]
TABLE = [
    [
        "sweep",
        "--points",
        "INPUT/points.csv",
        "--periods",
        "3",
        "--warmup",
        "1",
        "--mu",
        "0.5",
        "--out",
        "FOLDER",
    ],
    ["sweep", "--points", "INPUT/further.csv", "--grow", "--out", "FOLDER"],
    ["collect", "FOLDER"],
]
MAP = [
    [
        "map",
        "--x",
        "mu=0:1",
        "--steps",
        "5",
        "--discs",
        "5",
        "--periods",
        "4",
        "--warmup",
        "1",
        "--replicates",
        "2",
        "--no-figure",
        "--out",
        "FOLDER",
    ]
]
MAP_OF_N_C = [
    [
        "map",
        "--x",
        "mu=0.5,1",
        "--quantity",
        "N_c",
        "--from",
        "4",
        "--to",
        "8",
        "--periods",
        "3",
        "--warmup",
        "1",
        "--replicates",
        "2",
        "--no-figure",
        "--out",
        "FOLDER",
    ]
]
CROSSING = [
    [
        "crossing",
        "--mu",
        "1",
        "--from",
        "4",
        "--to",
        "7",
        "--events",
        "300",
        "--tolerance",
        "2",
        "--json",
        "FOLDER/N_c.json",
        "--csv",
        "FOLDER/N_c.csv",
        "--out",
        "FOLDER",
    ]
]
# Stopped in the middle of a run, so that the folder has a checkpoint and an unfinished recording.
LONG = ["--discs", "8", "--periods", "40", "--warmup", "1", "--frames-per-period", "8"]
STOPPED_SWEEP = [
    ["sweep", *LONG, "--mu", "0.1,0.5,1", "--series", "--out", "FOLDER"],
    ["collect", "FOLDER"],
]
STOPPED_RUN = [
    [
        "run",
        *LONG,
        "--trajectory",
        "FOLDER/t.h5",
        "--log-events",
        "FOLDER/e.h5",
        "--series",
        "FOLDER/s.csv",
        "--json",
        "FOLDER/r.json",
        "--resume",
    ]
]
PAPER = [["paper", "FOLDER"]]  # study.make() of a few points (folders_test.py), without drawings

KINDS = {
    "sweep": SWEEP,
    "grown": GROWN,
    "chain": CHAIN,
    "points": TABLE,
    "map": MAP,
    "N_c map": MAP_OF_N_C,
    "crossing": CROSSING,
    "stopped sweep": STOPPED_SWEEP,
    "stopped run": STOPPED_RUN,
    "paper": PAPER,
}
# The first call is stopped when it writes this line of its series: a line is written after each
# period.
STOPPED = {"stopped sweep": 65, "stopped run": 25}


def continuing(kind, folder):
    """The calls that complete a folder: those that made it, if the plan is lost or the call is only
    repeated."""
    calls = KINDS[kind]
    command = calls[0][0]
    if command in ("run", "crossing", "paper") or not os.path.exists(
        os.path.join(folder, "plan.json")
    ):
        return calls
    if command == "map":
        return [["map", "--no-figure", "--out", "FOLDER"]]
    return [["sweep", "--out", "FOLDER"], calls[-1]]


def is_superseded(kind, name):
    """Results from before a sweep got further measurements are kept, but not used."""
    return kind == "grown" and name.startswith("results/")


# What differs between two equal calls.
TIMES = ("seconds", "events_per_second", "checksum")


def write_inputs(folder):
    for name, text in (("points.csv", POINTS), ("further.csv", FURTHER_POINTS)):
        with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
            file.write(text)


def without_times(value):
    if isinstance(value, dict):
        return {name: without_times(part) for name, part in value.items() if name not in TIMES}
    if isinstance(value, str):
        return value.replace("--overwrite", "--resume")  # in the command of a result
    return [without_times(part) for part in value] if isinstance(value, list) else value


def content_of(path):
    with open(path, "rb") as file:
        content = file.read()
    if not path.endswith(".json"):
        return content
    try:
        found = json.loads(content)
    except ValueError:
        return content
    if os.path.basename(path) == "checksums.json":  # of results, which contain times
        return sorted(found["content"])
    return without_times(found)


def files_of(folder):
    """The content of every file, by its name in the folder. Locks have none, and --overwrite keeps
    a copy of the checkpoint of the run that it replaces."""
    found = {}
    for where, _, names in os.walk(folder):
        for name in names:
            if name not in ("locks", "lock") and ".checkpoint.backup" not in name:
                path = os.path.join(where, name)
                found[os.path.relpath(path, folder)] = content_of(path)
    return found
