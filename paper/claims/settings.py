"""The settings of the runs (column `setting`), and claims about the experiment: judged on its
smooth spheres, and reported for the other settings."""

import math

from paper.paper_parameters import AMPLITUDE, CONTAINER_RADIUS, EXPERIMENT_DISH, EXPERIMENT_N

from paper.claims.wording import ALSO, known

WORDS = {
    "smooth": "smooth spheres",
    "rough": "roughened spheres",
    "half": "smooth spheres at A = 5.75 mm",
    "high": "discs with μ = 1",
    "low": "discs with μ = 0.1",
}
ROUGHER_THAN = {
    "smooth": ("rough", "smooth"),
    "high": ("high", "low"),
}  # (rougher, smoother) settings
SPHERES = ("smooth", "rough", "half")
# Container radius and amplitude, in particle radii. In the tables, Ω of the spheres is 1/A.
DISHES = {
    "smooth": EXPERIMENT_DISH,
    "rough": EXPERIMENT_DISH,
    "half": (EXPERIMENT_DISH[0], EXPERIMENT_DISH[1] / 2),
    "high": (CONTAINER_RADIUS, AMPLITUDE),
    "low": (CONTAINER_RADIUS, AMPLITUDE),
}

# N that a claim about the experiment needs.
GRID = tuple(range(EXPERIMENT_N[0], EXPERIMENT_N[1] + 1, 4))


def capital(text):
    return text[:1].upper() + text[1:]


def on_spheres(judge, note="", also=("half", "high")):
    """`judge(study, setting)` returns (Judgement, what was found)."""

    def judge_study(study):
        judgement, text = judge(study, "smooth")
        return (
            judgement,
            f"{capital(WORDS['smooth'])}: "
            f"{text}{note and f' ({note})'}.{compared(judge, study, also)}",
        )

    return judge_study


def compared(judge, study, settings):
    """What is found for other settings, as far as their tables have it."""
    found = []
    for setting in settings:
        try:
            judgement, text = judge(study, setting)
        except (FileNotFoundError, IndexError, KeyError, ValueError, ZeroDivisionError):
            continue
        found.append(f"{WORDS[setting]}, {text}: {judgement.verdict}")
    return f"{ALSO}{'; '.join(found)}." if found else ""


def rotation_rows(study, setting, last=math.inf):
    """(rows, the judged rate): the paper's simulation is averaged by event, its experiment by
    time."""
    table, rate = ("spheres", "mean_by_time") if setting in SPHERES else ("5b", "mean_by_event")
    return known(study.curve(table, last, setting=setting), rate), rate
