"""The runs of the figures are sweeps, one for each list of measurements: OUT/runs/rotation,
OUT/runs/frustration+slip, and so on. `swirl collect OUT/runs/rotation` makes the table of one, and
Python and the command line can continue it."""

import fcntl
import json
import os
import time

from paper import atomic_file, optional_file, other_versions
from paper.engine import swirl


def folder_of(out, measure):
    return os.path.join(out, "runs", "+".join(measure) or "rotation")


def by_measurements(tasks):
    """[(measurements, the tasks that need them)]"""
    return [
        (measure, [task for task in tasks if task.measure == measure])
        for measure in dict.fromkeys(task.measure for task in tasks)
    ]


def files_of(folder, tasks):
    """[[(file of the result, file of the error message)]] for each task; [] if the sweep does not
    have its run."""
    points = [task.parameters for task in tasks]
    return swirl.SweepFolder(folder).files(points) if points else []


def plan(out, tasks):
    """Adds the runs to their sweeps. All parts of a call plan all of its runs, in turn."""
    os.makedirs(os.path.join(out, "runs"), exist_ok=True)
    with open(os.path.join(out, "runs", "lock"), "w", encoding="utf-8") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        for measure, here in by_measurements(tasks):
            folder = swirl.SweepFolder(folder_of(out, measure))
            if not folder.is_planned:
                folder.plan(points=[task.parameters for task in here], measure=measure)
            elif new := [
                task.parameters
                for task, files in zip(here, files_of(folder.path, here))
                if not files
            ]:
                folder.grow(points=new)


def take(folder, tasks):
    """Takes the results of these tasks that are whole, of this version, and unchanged since they
    were first read. Any other result is removed, so that its run is made again; those of another
    version are kept elsewhere."""
    list_of_checksums = os.path.join(folder, "checksums.json")
    known = atomic_file.stored(list_of_checksums) or {}
    before = dict(known)
    for task, files in zip(tasks, files_of(folder, tasks)):
        for file, _ in files:
            name, text = os.path.basename(file), optional_file.read(file)
            if text is None:
                continue
            try:
                stored, checksum = json.loads(text), swirl.checksum(text)
                if stored["version"] != swirl.version():
                    known.pop(name, None)
                    other_versions.keep(file, stored["version"])
                    continue
                is_of_task = (stored["point"], stored["config"]["seed"]) == (
                    int(name.removesuffix(".json")),
                    task.parameters["seed"],
                )
                if is_of_task and known.setdefault(name, checksum) == checksum:
                    task.result, task.seconds = stored, stored["seconds"]
                    continue
            except (ValueError, KeyError, TypeError):
                pass
            known.pop(name, None)
            os.remove(file)
    if known != before:
        atomic_file.store(list_of_checksums, known)


def find(out, tasks):
    """Takes the results that exist. A sweep with further measurements serves a task without
    them."""
    for name in optional_file.names_in(os.path.join(out, "runs")):
        folder, has = os.path.join(out, "runs", name), set(name.split("+"))
        if swirl.SweepFolder(folder).is_planned:
            left = [task for task in tasks if task.result is None and set(task.measure) <= has]
            take(folder, left)


def make(out, measure, tasks, threads, progress):
    """Makes the runs of one sweep, in the order of the tasks. Waits for those that another process
    makes."""
    folder, left = folder_of(out, measure), tasks
    while left:
        swirl.SweepFolder(folder).run(
            points=[task.parameters for task in left],
            threads=threads,
            progress=lambda done, runs, _: progress(done / runs if runs else 1.0),
        )
        take(folder, left)
        for task, [(_, failure)] in zip(left, files_of(folder, left)):
            if task.result is None and (message := optional_file.read(failure)):
                task.result = {"failed": message.strip()}
        left = [task for task in left if task.result is None]
        if left:
            time.sleep(1)
