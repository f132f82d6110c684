"""The report of one video (report.html, one self-contained file) and figure_found.png and .pdf,
from the files that `swirl track --report` wrote to a folder.

    /usr/bin/python3 paper track FOLDER
"""

import math
import os

from paper import style
from paper.atomic_file import write_or_exit
from paper.claims.wording import number
from paper.html_page import described_folder, rendered

FEWEST = 0.99  # fraction of the frames: a disc that is seen in fewer is doubtful


def draw(folder, frames, number):
    """Draw the number of discs, errors and overlaps, and the rim's deviation over time."""
    drawing, axes = style.figure(height=4.2, nrows=3, sharex=True)
    time = style.column(frames, "time")
    seen, filled = (style.column(frames, name) for name in ("seen", "filled"))
    axes[0].plot(time, seen, color=style.RED, linewidth=0.8, label="seen")
    axes[0].plot(
        time,
        [s + f for s, f in zip(seen, filled)],
        color=style.SKY,
        linewidth=0.8,
        linestyle=":",
        label="including interpolated",
    )
    axes[0].axhline(number, color=style.BLACK, linewidth=0.5)
    axes[0].set_ylabel("discs")
    style.legend(axes[0])
    axes[1].plot(
        time, style.column(frames, "error"), color=style.RED, linewidth=0.8, label="position error"
    )
    axes[1].plot(
        time,
        style.column(frames, "deepest_overlap"),
        color=style.SKY,
        linewidth=0.6,
        label="deepest overlap",
    )
    axes[1].set_ylabel("pixels")
    style.legend(axes[1])
    rims = [row for row in frames if row["rim_off"] >= 0]
    axes[2].plot(
        style.column(rims, "time"), style.column(rims, "rim_off"), color=style.RED, linewidth=0.8
    )
    axes[2].set(ylabel="distance of rim\nfrom path, pixels", xlabel="time")
    style.save(drawing, os.path.join(folder, "figure_found.csv"))


def found_rows(found):
    """Rows for the results, with their errors."""
    path, container, lens = found["path"], found["container"], found["lens"]
    unit = "s" if found["fps"] else "frame"
    omega, omega_error = path["omega"], path["omega_error"]
    radius = found["camera"]["scale"]
    species = ", ".join(
        f"{one['number']} of radius {one['radius']:.2f} pixels (scatter of single fits "
        f"{one['radius_scatter']:.2f})"
        for one in found["species"]
    )
    rows = [
        (
            "video",
            f"{found['video']}, {found['frames']} frames of {found['size'][0]} × "
            f"{found['size'][1]} pixels",
        ),
        ("discs", f"{found['discs']}, {found['discs_are']}: {species}"),
        (
            "container",
            f"radius {found['camera']['container-radius'] * radius:.2f} pixels, "
            f"{found['camera']['container-radius']:.3f} disc radii; radius of the visible "
            f"rim {container['rim_radius']:.2f} pixels",
        ),
        (
            "centre of the path, pixels",
            " and ".join(number(c, path["centre_error"]) for c in path["centre"]),
        ),
        (
            "amplitude, pixels",
            f"{number(path['amplitude'], path['amplitude_error'])}; "
            f"{path['amplitude'] / radius:.3f} disc radii",
        ),
        (f"Ω, rad/{unit}", number(omega, omega_error)),
        (f"period, {unit}", number(2 * math.pi / omega, 2 * math.pi * omega_error / omega**2)),
        (
            "direction of rotation",
            "clockwise in the image" if path["clockwise"] else "counter-clockwise",
        ),
        ("lens distortion", number(lens["distortion"], lens["distortion_error"])),
        ("camera", lens["camera"]),
    ]
    if found["millimetres_per_pixel"]:
        rows.append(("scale", f"{found['millimetres_per_pixel']:.5f} mm per pixel"))
    return rows


def quality_rows(found, discs):
    quality = found["quality"]
    doubtful = [d for d in discs if d["seen"] < FEWEST * found["frames"]]
    names = "; ".join(
        f"{d['particle']:.0f} in {100 * d['seen'] / found['frames']:.1f} %" for d in doubtful
    )
    overlaps = quality["overlap_error"]
    return [
        ("frames with all discs", f"{100 * quality['complete_share']:.2f} %"),
        ("interpolated positions", str(quality["filled_positions"])),
        ("circles beyond the number of discs", str(quality["excess_discs"])),
        ("position error", f"{quality['position_error']:.3f} pixels"),
        (
            "position error from overlaps",
            f"{overlaps:.3f} pixels" if overlaps > 0 else "n/a: too few discs touch",
        ),
        (f"discs seen in fewer than {100 * FEWEST:.0f} % of the frames", names or "none"),
        (
            "distance of the rim from the path, median",
            f"{found['path']['residual']:.3f} pixels; "
            f"{100 * found['path']['agreeing_frames']:.1f} % of the frames agree with the path",
        ),
    ]


def contents(found, discs):
    return [
        ("bullets", found["warnings"]) if found["warnings"] else ("text", "No warnings."),
        ("section", "Results"),
        ("table", (["", ""], found_rows(found))),
        ("section", "Quality"),
        ("table", (["", ""], quality_rows(found, discs))),
        (
            "figures",
            [
                {
                    "title": "First frame",
                    "images": ["video.png"],
                    "caption": "With the detected discs drawn over it.",
                },
                {
                    "title": "Over time",
                    "images": ["figure_found.png"],
                    "command": "frames.csv, figure_found.pdf",
                    "caption": "Number of detected discs; position error (rms) from the fits, and "
                    "the deepest overlap "
                    "of two discs, which hard discs cannot have; distance of the rim from the "
                    "fitted path.",
                },
            ],
        ),
        ("section", "Made by"),
        ("table", (["", ""], [("command", found["command"]), ("version", found["version"])])),
    ]


def main():
    folder, found = described_folder(
        "found.json", "swirl track --report", "draws and writes report.html"
    )
    frames = style.read(os.path.join(folder, "frames.csv"))
    discs = style.read(os.path.join(folder, "discs.csv"))
    draw(folder, frames, found["discs"])
    write_or_exit(
        os.path.join(folder, "report.html"),
        rendered(
            "report.html.j2",
            folder,
            title=os.path.basename(found["video"]) or found["video"],
            blocks=contents(found, discs),
        ),
    )
