"""`swirl paper`: makes figures, movies and the report. The program checks the options and passes
the call as JSON:

    /usr/bin/python3 paper command '{"figures": ["5b"], "out": "out", "module": "build/release/python"}'
"""

import json
import multiprocessing
import os
import sys
import time

from paper import atomic_file, catalogue, study
from paper.console import INTERRUPTED, Problem, Progress, duration, stop_on_signals

SETTINGS = ("quick", "events", "out", "seed", "first_seeds", "threads")


def draw(job):
    """Draws the table of a figure; returns the reason why it cannot."""
    name, table = job
    try:
        catalogue.named([name])[0].draw(table)
        from paper import style

        style.plt.close("all")  # this process draws several figures
    except ModuleNotFoundError as missing:
        if missing.name != "matplotlib":
            raise
        return (
            "the figures need matplotlib; the tables are written.\n"
            "hint: install the Debian package python3-matplotlib."
        )
    except (Exception, SystemExit) as error:  # the other figures are made
        return f"its table is written, but it cannot be drawn: {study.reason_of(error)}"
    return ""


def add_seeds_to_undecided(settings, plans):
    """Doubles the seeds of the points on which undecided claims rest. Returns (True if there are
    any, the number of those whose budget is used)."""
    from paper.claims import all_judged, points_to_decide

    seeds = {point.name: len(point.tasks) for plan in plans for point in plan}
    undecided = [name for name in points_to_decide(all_judged(settings.out)) if name in seeds]
    more = [name for name in undecided if 2 * seeds[name] <= settings.max_seeds]
    settings.seeds_of_point.update({name: 2 * seeds[name] for name in more})
    return bool(more), len(undecided) - len(more)


class Paper:
    """The figures of a call."""

    def __init__(self, call):
        self.call, self.begin = call, time.monotonic()
        self.settings = study.Settings(
            **{name: call[name] for name in SETTINGS if call.get(name) is not None}
        )
        self.figures = catalogue.named(call["figures"] or ["all"])
        self.is_all = not call["figures"] or "all" in call["figures"]
        self.made, self.counts, self.undecided, self.problems = [], {}, 0, {}

    def run(self, progress):
        """Makes the runs and the tables, and more seeds until the claims that rest on them are
        decided."""
        first = None
        while True:
            plans = self.plans()
            counts = study.make(
                [point for plan in plans for point in plan], self.settings, progress
            )
            first = first or counts
            self.counts = {**counts, "reused": first["reused"]}
            self.made = [self.finished(figure, plan) for figure, plan in zip(self.figures, plans)]
            more, self.undecided = add_seeds_to_undecided(self.settings, plans)
            if not more:
                return

    def plans(self):
        """The points of each figure. One that cannot list them fails alone."""
        plans = []
        for figure in self.figures:
            try:
                plans.append(figure.points(self.settings))
                for point in plans[-1]:
                    for task in point.tasks:
                        task.figures.add(figure.name)
            except Exception as error:
                plans.append([])
                self.problems[figure.name] = study.reason_of(error)
        return plans

    def finished(self, figure, plan):
        problem, findings, files = self.problems.get(figure.name) or study.broken(plan), [], []
        try:
            findings, files = ([], []) if problem else figure.write(plan, self.settings)
        except Exception as error:  # the other figures are made
            problem = study.reason_of(error)
        return {
            "name": figure.name,
            "description": figure.description,
            "caption": figure.caption,
            "findings": findings + study.remarks(plan),
            "files": files,
            "problem": problem,
        }

    def draw(self):
        """The drawings are independent, and take a second each."""
        drawn = {figure.name for figure in self.figures if figure.draw}
        jobs = [made for made in self.made if made["name"] in drawn and made["files"]]
        if not jobs:
            return
        with multiprocessing.Pool(
            min(self.settings.workers, len(jobs)), study.worker, (os.getpid(),)
        ) as pool:
            for made, problem in zip(
                jobs, pool.map(draw, [(made["name"], made["files"][0]) for made in jobs])
            ):
                if problem:
                    made["problem"] = problem
                else:
                    made["files"] += [
                        made["files"][0].removesuffix("csv") + kind for kind in ("png", "pdf")
                    ]

    def report(self):
        """Writes paper.json and the report; returns the file that a reader opens."""
        from paper import report
        from paper.claims import write_verdicts

        call, settings = self.call, self.settings
        figures = [
            {**made, "files": [os.path.basename(file) for file in made["files"]]}
            for made in self.made
        ]
        about = {
            "command": call["command"],
            "version": call["version"],
            "build": call["build"],
            "quick": settings.quick,
            "seed": settings.seed,
            "events_of_a_run": settings.events_of_a_run,
            "defaults": call["defaults"],
            "seeds_of_a_point": settings.seeds,
            "max_seeds_of_a_point": settings.max_seeds,
            "undecided_points": self.undecided,
            "runs": self.counts["tasks"],
            "runs_of_earlier_calls": self.counts["reused"],
            "runs_that_failed": self.counts["failed"],
            "seconds": time.monotonic() - self.begin,
            "seconds_on_one_core": self.counts["task_seconds"],
            "figures": figures,
        }
        atomic_file.write(
            os.path.join(settings.out, "paper.json"),
            json.dumps(about, indent=2, ensure_ascii=False) + "\n",
        )
        write_verdicts(settings.out)
        report.write_all(settings.out)
        return os.path.join(settings.out, "report.html")

    def text(self):
        """One line for each figure; everything about it if it is the only one."""
        counts, lines = self.counts, []
        for made in self.made:
            findings = made["findings"] + (
                [f"This figure could not be made: {made['problem']}"] if made["problem"] else []
            )
            if len(self.made) == 1:
                lines += findings
            else:
                lines.append(
                    f"{made['name']:<26}{findings[-1] if made['problem'] else made['description']}"
                )
        if counts["failed"] and len(self.made) > 1:
            lines.append(f"{counts['failed']} runs failed; the tables and paper.json name them.")
        earlier = f", {counts['reused']} of them from an earlier call," if counts["reused"] else ""
        lines.append(
            f"{counts['tasks']} runs{earlier} in {duration(time.monotonic() - self.begin)}."
        )
        return lines


def make_part(paper, part, progress):
    points = [point for plan in paper.plans() for point in plan]
    counts = study.make(points, paper.settings, progress, part)
    print(
        f"{counts['tasks'] - counts['reused']} runs of part {part[0]}/{part[1]} in "
        f"{duration(time.monotonic() - paper.begin)}; stored in '{paper.settings.out}'."
    )
    problems = [
        f"figure {name} cannot be made: {problem}" for name, problem in paper.problems.items()
    ]
    if counts["failed"] or problems:
        raise Problem("; ".join([f"{counts['failed']} runs failed", *problems]) + ".")


def make(call):
    """Makes what the call asks for."""
    if call.get("movies"):
        from paper import movies

        movies.make(call)
        if not call["figures"]:
            return
    paper = Paper(call)
    label = f"Figure {paper.figures[0].name}" if len(paper.figures) == 1 else "paper"
    try:
        with Progress(label, call.get("quiet", False)) as progress:
            if call.get("part"):
                make_part(paper, tuple(call["part"]), progress)
                return
            paper.run(progress)
        paper.draw()
        lines = paper.text()
        files = [file for made in paper.made for file in made["files"]]
        if paper.is_all:
            lines.append(
                f"wrote {paper.report()} and {len(files) + 4} more files in the same folder"
            )
        else:
            lines += [f"wrote {file}" for file in files]
    except KeyboardInterrupt:
        raise Problem(
            f"stopped before the end; finished runs are stored in '{paper.settings.out}'."
            "\nhint: the same call continues from there.",
            INTERRUPTED,
        ) from None
    print("\n".join(lines), flush=True)
    missing = [made["name"] for made in paper.made if made["problem"]]
    if missing:
        raise Problem(
            f"figures that could not be made: {', '.join(missing)}; the reasons are listed above."
        )


def main():
    stop_on_signals()
    try:
        call = json.loads(sys.argv[1])
    except (IndexError, ValueError):
        raise Problem(
            "the argument is not the call of `swirl paper`, as JSON.\nhint: call `swirl paper`.", 2
        ) from None
    if call.get("module"):
        sys.path.insert(0, call["module"])
    make(call)
