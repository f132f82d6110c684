"""The numerical movies of the paper's supplement, and movies.html, which plays them."""

import os
import subprocess
from types import SimpleNamespace

import numpy as np

from paper import atomic_file, optional_file
from paper.console import INTERRUPTED, Problem, Progress
from paper.engine import swirl
from paper.html_page import rendered
from paper.paper_parameters import COUNTERROTATING_N, ROTATING_N

WARMUP = 20  # periods before the first frame
SAMPLES = 64  # per period, of the rotation


def system(title, options, lab_color, m_color, explanation, rotating, counterrotating):
    return SimpleNamespace(
        title=title,
        options=options,
        colors={"lab": lab_color, "m": m_color},
        explanation=explanation,
        lines=(rotating, counterrotating),
    )


# Friction coefficients, colours in the lab frame and the M-frame, and the texts: of the few discs
# and the many, each in both frames.
SYSTEMS = (
    system(
        "All friction",
        {"mu_disc": 1, "mu_wall": 1},
        "id",
        "pinned",
        "The transition from rotation to counterrotation. The arc shows the total rotation of the "
        "cluster.",
        (
            "28 discs slosh round the container and drift with the swirl: the arc grows to the "
            "left.",
            "Discs that reach the wall move up with it on the left, depin at the top and cross the "
            "container.",
        ),
        (
            "48 discs drift against the swirl: the arc grows to the right.",
            "Most discs are pinned (green), in layers against the wall that carries them "
            "clockwise.",
        ),
    ),
    system(
        "No disc friction",
        {"mu_disc": 0, "mu_wall": 1},
        "spin",
        "spin",
        "The wall accelerates the spin of the discs that touch it. No friction passes the spin on.",
        (
            "Colours show the spin: all discs have touched the wall and spin independently.",
            "They fill the container like a gas that is pushed down towards M.",
        ),
        (
            "The number that counterrotates with all friction: here it rotates with the swirl.",
            "Discs at the wall spin, those inside hardly do: no friction passes the spin on.",
        ),
    ),
    system(
        "No wall friction",
        {"mu_disc": 1, "mu_wall": 0},
        "id",
        "speed",
        "Nothing drags the discs along the wall, so the cluster rotates with the frequency of the "
        "swirl.",
        (
            "The cluster sloshes as one body and rotates once per period.",
            "In the M-frame it rests on the wall, like settled sand.",
        ),
        (
            "With more discs it is the same: one rotation per period.",
            "Almost at rest: the colour scale ends at the speed of the wall.",
        ),
    ),
    system(
        "Minimal model",
        None,
        "none",
        "none",
        "One rigid ball of half the size of the container, pressed against the wall.",
        (
            "It rolls without slip, like a gear inside a ring, and rotates against the swirl.",
            "The wall turns clockwise and carries the ball along.",
        ),
        (
            "It slips freely and keeps one side at M, so it rotates once per period.",
            "The wall slides past, and the ball is at rest.",
        ),
    ),
)


def movie_of(system, version, frame, call):
    model = system.options is None
    caption = (
        ("No slip, s = 1", "Slip, s = 0")[version]
        if model
        else f"N = {(ROTATING_N, COUNTERROTATING_N)[version]}"
    )
    ending = ("no-slip", "slip")[version] if model else ("rotating", "counterrotating")[version]
    title = system.title.lower().replace(" ", "-")
    name = (
        f"minimal-model-{frame}-frame-{ending}"
        if model
        else f"numerical-{frame}-frame-{title}-{ending}"
    )
    run = (
        {}
        if model
        else {
            **system.options,
            "discs": (ROTATING_N, COUNTERROTATING_N)[version],
            "seed": call["seed"],
        }
    )
    fps, seconds, side = (30, 3, 360) if call["quick"] else (60, 15, 900)
    options = {
        "fps": fps,
        "pace": 1,
        "size": f"{side}x{side}",
        "view": "laboratory" if frame == "lab" else frame,
        "color": system.colors[frame],
        "start": 0 if model else WARMUP,
        "seconds": seconds,
        "title": f"{system.title}, {caption}",
        **(
            {"rolling-ball": 1 - version}
            if model
            else {k.replace("_", "-"): v for k, v in run.items()}
        ),
    }
    return SimpleNamespace(
        name=name,
        caption=caption,
        explanation=system.lines[version][frame != "lab"],
        frame="lab frame" if frame == "lab" else "M-frame",
        options=options,
        run=run,
        slip=1 - version if model else None,
        periods=seconds,
    )


def rotation_in(movie):
    """ϖ/Ω over the periods shown, by time. The model rotates with 1 − γ = 1 − s R/r."""
    if movie.slip is not None:
        return 1 - 2 * movie.slip
    simulation = swirl.Simulation(**movie.run)
    simulation.advance(periods=WARMUP + 0.5 / SAMPLES)
    frames = simulation.sample(movie.periods, per_period=SAMPLES)
    return float(np.mean([frames[k].rotation()[0] for k in range(len(frames))]))


def note_of(movie, folder):
    return os.path.join(folder, "parts", f"movie-{movie.name}.json")


def finished(movie, folder):
    """The rotation in this movie, if an earlier call has made the same one."""
    stored, file = atomic_file.stored(note_of(movie, folder)), os.path.join(
        folder, f"{movie.name}.mp4"
    )
    same = (
        stored
        and stored["movie"] == movie.options
        and optional_file.exists(file)
        and stored["bytes"] == os.path.getsize(file)
    )
    return stored["rotation"] if same else None


def make_movie(movie, call):
    file = os.path.join(call["out"], f"{movie.name}.mp4")
    words = [
        call["program"],
        "movie",
        "--out",
        file,
        "--quiet",
        *(["--turned-angle"] if movie.options["view"] == "laboratory" else []),
    ]
    for name, value in movie.options.items():
        words += [f"--{name}", str(value)]
    done = subprocess.run(words, capture_output=True, encoding="utf-8")
    if done.returncode:
        raise Problem(done.stderr.removeprefix("error: ").strip())
    rotation = rotation_in(movie)
    atomic_file.store(
        note_of(movie, call["out"]),
        {"movie": movie.options, "bytes": os.path.getsize(file), "rotation": rotation},
    )
    return rotation


def make(call):
    folder, reused, done = call["out"], 0, 0
    os.makedirs(os.path.join(folder, "parts"), exist_ok=True)
    for here in SYSTEMS:
        here.movies = [
            movie_of(here, version, frame, call) for version in (0, 1) for frame in ("lab", "m")
        ]
    movies = [movie for here in SYSTEMS for movie in here.movies]
    try:
        with Progress("movies", call["quiet"]) as progress:
            for movie in movies:
                rotation = finished(movie, folder)
                reused += rotation is not None
                rotation = make_movie(movie, call) if rotation is None else rotation
                movie.rotation = f"{rotation:+.3f}".replace("-", "−")
                done += 1
                progress(done / len(movies))
    except KeyboardInterrupt:
        raise Problem(
            f"stopped after {done} of {len(movies)} movies.\nhint: the same call makes the others.",
            INTERRUPTED,
        ) from None
    atomic_file.write(
        os.path.join(folder, "movies.html"), rendered("movies.html.j2", systems=SYSTEMS)
    )
    if reused:
        print(f"{reused} of {len(movies)} movies are from an earlier call.")
    print(
        f"wrote {os.path.join(folder, 'movies.html')} and {len(movies)} movies in the same folder",
        flush=True,
    )
