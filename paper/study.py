"""The points of the figures, and the runs that they need: in parallel, stored when done, and
reused.

A point is a set of parameters with several seeds. Its runs are those of a sweep (run_folder.py). A
figure that computes in Python during or after a run has a function `work`; its results are
OUT/parts/KEY.json. So an interrupted study continues, and two figures that need the same point
share its runs.
"""

import dataclasses
import json
import multiprocessing
import os
import signal
import threading
import time

from paper import atomic_file, combine, other_versions, run_folder
from paper.combine import at, failed
from paper.console import Problem
from paper.engine import swirl

DEFAULT_EVENTS = 1_000_000  # SI: "10^6 iterations"


@dataclasses.dataclass
class Settings:
    quick: bool = False  # fewer points and seeds; all runs are those of the full study
    events: float = None  # of a run; scales all lengths in periods likewise
    out: str = "out"
    seed: int = 1
    first_seeds: int = None  # runs of a point
    threads: int = 0  # 0: all cores
    seeds_of_point: dict = dataclasses.field(
        default_factory=dict
    )  # more seeds, until a claim is decided

    def __post_init__(self):
        if self.first_seeds is not None and not 2 <= self.first_seeds <= self.max_seeds:
            raise Problem(
                f"--replicates is {self.first_seeds}, but it must be from 2 to {self.max_seeds}.", 2
            )

    @property
    def workers(self):
        return self.threads or len(os.sched_getaffinity(0))

    @property
    def default_seeds(self):
        """Enough for the claims that are decided by far; the others get more."""
        return 3 if self.quick else 4

    @property
    def seeds(self):
        """Runs at a point of the paper's figures."""
        return self.first_seeds or self.default_seeds

    @property
    def seeds_beyond(self):
        """Runs at a point of the figures beyond the paper."""
        return 2 if self.quick else 3

    @property
    def chapter_seeds(self):
        return 2 if self.quick else 8

    @property
    def max_seeds(self):
        """The budget of a point on which an undecided claim rests."""
        return 12 if self.quick else 32

    @property
    def events_of_a_run(self):
        return int(self.events or DEFAULT_EVENTS)

    def periods(self, by_default, minimum):
        """A length in periods, scaled as `events` scales the other runs."""
        return max(minimum, int(by_default * self.events_of_a_run / DEFAULT_EVENTS + 0.5))


class Point:
    """The runs of a set of parameters with consecutive seeds.

    `name` identifies it in tables and verdicts. `cells` are the first columns of its row.
    `work(parameters)` makes the result of one seed, a dictionary; without it, this is that of
    swirl.run() with the measurements `measure`."""

    def __init__(self, settings, name, seeds, parameters, measure=(), work=None, cells=None):
        self.name, self.cells = name, dict(cells or {})
        seeds = max(seeds, settings.seeds_of_point.get(name, 0))
        self.tasks = [
            Task(name, {**parameters, "seed": settings.seed + k}, measure, work)
            for k in range(seeds)
        ]
        self.result = None  # over the seeds, once they are done

    @property
    def runs(self):
        """The results of the single seeds, without failed ones."""
        return [task.result for task in self.tasks if not failed(task.result)]


def stored_name(work):
    """The name of a function `work` in the identity of its stored results. `work.stored_as` keeps
    that of a module which has another name now."""
    module = work.__module__.removeprefix("paper.")
    return getattr(work, "stored_as", f"{module}.{work.__name__}")


class Task:
    """One seed of a point: a run, or a call of `work`. Equal tasks have equal keys."""

    def __init__(self, name, parameters, measure, work):
        self.parameters, self.measure, self.work = parameters, tuple(sorted(measure)), work
        self.figures = set()  # that need it
        self.result, self.seconds = None, 0.0
        if work:
            self.identity = repr((sorted(parameters.items()), stored_name(work)))
            self.key = f"{name}_seed{parameters['seed']}_{swirl.checksum(self.identity)[:8]}"
        else:
            self.key = swirl.run_identity(**parameters)

    def file(self, out):
        return os.path.join(out, "parts", f"{self.key}.json")

    def cost(self):
        """An estimate, in events."""
        p = self.parameters
        return (
            p["periods"] * events_per_period(p)
            if "periods" in p
            else float(p.get("events", DEFAULT_EVENTS))
        )

    def find(self, out):
        """Takes the stored result of `work`, if it is of this version."""
        stored = atomic_file.stored(self.file(out))
        if stored and stored["version"] != swirl.version():
            other_versions.keep(self.file(out), stored["version"])
        elif stored and stored["identity"] == self.identity:
            self.result, self.seconds = stored["result"], stored["seconds"]


def events_per_period(p):
    """For lengths, the progress and the order of the runs. In the paper's container 480 at N = 28
    and 3400 at N = 48. For small N the vertices of the path dominate."""
    discs, radius, container = (
        p.get("discs", 48),
        p.get("radius", 1.0),
        p.get("container_radius", 8.6),
    )
    mu = p.get("mu", 1.0)
    mu_disc, mu_wall = p.get("mu_disc", mu), p.get("mu_wall", mu)
    packing_fraction = discs * radius * radius / (container * container)
    # A sphere begins to roll after most collisions. Discs with only one of disc and wall friction
    # end up rolling on their partners, and collide gently and often (measured at N = 11 … 48: 11 to
    # 30 times as often without wall friction, 2.5 to 15 without disc friction).
    factor = (
        3.0
        if "preset" in p
        else 20.0
        if mu_disc and not mu_wall
        else 8.0
        if mu_wall and not mu_disc
        else 1.0
    )
    return p.get("sides", 30) + factor * discs * (5.0 + 275.0 * packing_fraction**3.3)


# --- Running ------------------------------------------------------------------------------------


def worker(parent):
    """Ctrl-C reaches the parent alone, which ends its workers; they also end if it is killed."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)

    def watch():
        while os.getppid() == parent:
            time.sleep(1)
        os._exit(1)

    threading.Thread(target=watch, daemon=True).start()


def do(job):
    """Calls the `work` of a task and stores the result. A failed run is a result, too, but it is
    not stored."""
    k, task, out = job
    begin = time.monotonic()
    try:
        result = json.loads(json.dumps(task.work(task.parameters)))  # as it will be read
    except Exception as error:  # the other runs are made
        failure = {"failed": reason_of(error)} | (
            {} if isinstance(error, swirl.Failure) else {"broken": True}
        )
        return k, {"result": failure, "seconds": time.monotonic() - begin}
    stored = {
        "identity": task.identity,
        "version": swirl.version(),
        "seconds": time.monotonic() - begin,
        "result": result,
    }
    atomic_file.store(task.file(out), stored)
    return k, stored


def reason_of(error):
    return f"{type(error).__name__}: {error}".removeprefix("Failure: ")


def broken(points):
    """The reason of the first run that ended with an error in the code of its figure, not with a
    failed simulation."""
    return next(
        (
            task.result["failed"]
            for point in points
            for task in point.tasks
            if (task.result or {}).get("broken")
        ),
        "",
    )


def distinct(points):
    """The tasks of all points, each once, with all measurements that the points need; by falling
    cost."""
    tasks = {}
    for point in points:
        for task in point.tasks:
            known = tasks.setdefault(task.key, task)
            known.measure = tuple(sorted({*known.measure, *task.measure}))
            known.figures |= task.figures
    return sorted(tasks.values(), key=lambda task: -task.cost())


def part_in_words(tasks):
    """ "figures 3a and 4b" that need these tasks, or how many."""
    names = sorted(set().union(*(task.figures for task in tasks)))
    if not names:
        return ""
    return (
        f"figure{'s' if len(names) > 1 else ''} {' and '.join(names)}"
        if len(names) <= 2
        else f"{len(names)} figures"
    )


def make(points, settings, progress=lambda fraction, part="": None, part=(1, 1)):
    """Makes the missing runs of the points, or those of a part, and combines those of every point.
    Returns the counts of all runs, those reused and those failed, and the seconds of all of
    them."""
    out, tasks = settings.out, distinct(points)
    os.makedirs(os.path.join(out, "parts"), exist_ok=True)
    run_folder.plan(out, [task for task in tasks if not task.work])
    tasks = tasks[part[0] - 1 :: part[1]]
    run_folder.find(out, [task for task in tasks if not task.work])
    for task in tasks:
        if task.work:
            task.find(out)
    left = [task for task in tasks if task.result is None]
    reused, total, done = len(tasks) - len(left), sum(task.cost() for task in left) or 1.0, 0.0
    for measure, here in run_folder.by_measurements([task for task in left if not task.work]):
        cost = sum(task.cost() for task in here)
        run_folder.make(
            out,
            measure,
            here,
            settings.threads,
            lambda share: progress((done + share * cost) / total, part_in_words(here)),
        )
        done += cost
    jobs = [(k, task, out) for k, task in enumerate(left) if task.work]
    if jobs:
        with multiprocessing.Pool(min(settings.workers, len(jobs)), worker, (os.getpid(),)) as pool:
            for k, stored in pool.imap_unordered(do, jobs):
                left[k].result, left[k].seconds = stored["result"], stored["seconds"]
                done += left[k].cost()
                progress(done / total, part_in_words([left[k]]))
    if part == (1, 1):
        results = {task.key: task for task in tasks}
        for point in points:
            for task in point.tasks:
                task.result = results[task.key].result
            point.result = {
                **combine.combined([task.result for task in point.tasks]),
                "point": point.name,
            }
    return {
        "tasks": len(tasks),
        "reused": reused,
        "failed": sum(failed(task.result) for task in left),
        "task_seconds": sum(task.seconds for task in tasks),
    }


# --- Remarks ------------------------------------------------------------------------------------


def first_few(names, few=5):
    """The first names of a list, and the number of the others."""
    if len(names) <= few + 1:
        return ", ".join(names)
    return f"{', '.join(names[:few])}, and {len(names) - few} more"


def failures(points):
    """The failed runs, with the reason of the first."""
    words, reasons = [], []
    for point in points:
        here = [task.result["failed"] for task in point.tasks if failed(task.result)]
        reasons += here
        if here:
            words.append(
                f"{len(here)} of {len(point.tasks)} at {point.name}"
                + (" (no result)" if len(here) == len(point.tasks) else "")
            )
    if not reasons:
        return []
    one = len(reasons) == 1
    return [
        f"{len(reasons)} run{'' if one else 's'} failed and {'is' if one else 'are'} omitted: "
        f"{first_few(words)}. {'Reason' if one else 'Reason of the first'}: {reasons[0]}"
    ]


def remarks(points):
    """Remarks on the runs of a figure: failures, drifting runs, points where the seeds disagree."""
    found = failures(points)
    seeds = [at(point.result, "seeds") for point in points if at(point.result, "seeds")]

    def count(name):
        return sum(s[name] for s in seeds)

    kinds = [count(name) for name in ("drifting", "jumping", "switching", "too_short")]
    if sum(kinds):
        found.append(
            f"Steady state not verified after the warm-up: {sum(kinds)} of {count('runs')} runs "
            f"({kinds[0]} "
            f"drifting, {kinds[1]} jumping, {kinds[2]} switching between two states, {kinds[3]} "
            "too short for the test). They are marked in the figure and in its table."
        )
    if count("too_short_to_average"):
        found.append(
            f"{count('too_short_to_average')} of them have fewer than {combine.min_periods():g} "
            "periods after their warm-up. They count only at points where no run is longer."
        )
    disagreeing = [point.name for point in points if at(point.result, "seeds", "disagree")]
    if disagreeing:
        found.append(
            f"At {len(disagreeing)} of {len(points)} points the seeds scatter more than the errors "
            "within the "
            f"runs explain: {first_few(disagreeing)}. The errors given there are those between the "
            "seeds; if "
            "the runs are steady, these points are mixtures of states that last longer than a run."
        )
    return found
