"""The report of one video (report.html, one self-contained file) and figure_found.png and .pdf, from
the files that `swirl track --report` wrote to a folder.

    /usr/bin/python3 paper/track.py FOLDER
"""

import html
import math
import os

import experiment
import html_page as report
import style

FEWEST = 0.99  # fraction of the frames: a disc that is seen in fewer is doubtful


def draw(folder, frames, number):
    """Draw the number of discs, errors and overlaps, and the rim's deviation over time."""
    drawing, axes = style.figure(height=4.2, nrows=3, sharex=True)
    time = style.column(frames, "time")
    seen, filled = (style.column(frames, name) for name in ("seen", "filled"))
    axes[0].plot(time, seen, color=style.RED, linewidth=0.8, label="seen")
    axes[0].plot(time, [s + f for s, f in zip(seen, filled)], color=style.SKY, linewidth=0.8,
                 linestyle=":", label="including interpolated")
    axes[0].axhline(number, color=style.BLACK, linewidth=0.5)
    axes[0].set_ylabel("discs")
    style.legend(axes[0])
    axes[1].plot(time, style.column(frames, "error"), color=style.RED, linewidth=0.8,
                 label="position error")
    axes[1].plot(time, style.column(frames, "deepest_overlap"), color=style.SKY, linewidth=0.6,
                 label="deepest overlap")
    axes[1].set_ylabel("pixels")
    style.legend(axes[1])
    rims = [row for row in frames if row["rim_off"] >= 0]
    axes[2].plot(style.column(rims, "time"), style.column(rims, "rim_off"), color=style.RED,
                 linewidth=0.8)
    axes[2].set_ylabel("distance of rim\nfrom path, pixels")
    axes[2].set_xlabel("time")
    style.save(drawing, os.path.join(folder, "figure_found.csv"))


def found_rows(found):
    """Rows for the results, with their errors."""
    path, container, lens = found["path"], found["container"], found["lens"]
    unit = "s" if found["fps"] else "frame"
    omega, omega_error = path["omega"], path["omega_error"]
    radius = found["camera"]["scale"]
    species = ", ".join(f"{one['number']} of radius {one['radius']:.2f} pixels (scatter of single fits "
                        f"{one['radius_scatter']:.2f})" for one in found["species"])
    value = experiment.with_error
    rows = [("video", f"{found['video']}, {found['frames']} frames of {found['size'][0]} × "
                      f"{found['size'][1]} pixels"),
            ("discs", f"{found['discs']}, {found['discs_are']}: {species}"),
            ("container", f"radius {found['camera']['container-radius'] * radius:.2f} pixels, "
                          f"{found['camera']['container-radius']:.3f} disc radii; radius of the visible "
                          f"rim {container['rim_radius']:.2f} pixels"),
            ("centre of the path, pixels", " and ".join(
                value(c, path["centre_error"]) for c in path["centre"])),
            ("amplitude, pixels", f"{value(path['amplitude'], path['amplitude_error'])}; "
                                  f"{path['amplitude'] / radius:.3f} disc radii"),
            (f"Ω, rad/{unit}", value(omega, omega_error)),
            (f"period, {unit}", value(2 * math.pi / omega, 2 * math.pi * omega_error / omega ** 2)),
            ("direction of rotation", "clockwise in the image" if path["clockwise"] else "counter-clockwise"),
            ("path", path["shape"]),
            ("lens distortion", value(lens["distortion"], lens["distortion_error"])),
            ("camera", lens["camera"])]
    if found["millimetres_per_pixel"]:
        rows.append(("scale", f"{found['millimetres_per_pixel']:.5f} mm per pixel"))
    return rows


def quality_rows(found, discs):
    quality = found["quality"]
    doubtful = [d for d in discs if d["seen"] < FEWEST * found["frames"]]
    names = "; ".join(f"{d['particle']:.0f} in {100 * d['seen'] / found['frames']:.1f} %"
                      for d in doubtful)
    overlaps = quality["overlap_error"]
    return [("frames with all discs", f"{100 * quality['complete_share']:.2f} %"),
            ("interpolated positions", str(quality["filled_positions"])),
            ("circles beyond the number of discs", str(quality["excess_discs"])),
            ("position error", f"{quality['position_error']:.3f} pixels"),
            ("position error from overlaps",
             f"{overlaps:.3f} pixels" if overlaps > 0 else "n/a: too few discs touch"),
            (f"discs seen in fewer than {100 * FEWEST:.0f} % of the frames", names or "none"),
            ("distance of the rim from the path, median", f"{found['path']['residual']:.3f} pixels; "
             f"{100 * found['path']['agreeing_frames']:.1f} % of the frames agree with the path")]


def page(folder, found, discs):
    warnings = "".join(f"<li>{html.escape(text)}</li>" for text in found["warnings"])
    name = os.path.basename(found["video"]) or found["video"]

    def image(file, alt):
        return f'<img alt="{alt}" src="{report.inline(os.path.join(folder, file))}">'

    return "".join([
        report.opening(html.escape(name)),
        f"<h1>{html.escape(name)}</h1>\n",
        f"<ul>{warnings}</ul>\n" if warnings else "<p>No warnings.</p>\n",
        "<h2>Results</h2>\n", report.pairs(found_rows(found)),
        "<h2>Quality</h2>\n", report.pairs(quality_rows(found, discs)),
        report.grid([
            f"<figure>{image('video.png', 'the video with the detected discs')}<figcaption>"
            "<h3>First frame</h3><p>With the detected discs drawn over it.</p></figcaption></figure>\n",
            f"<figure>{image('figure_found.png', 'discs, errors and rim over time')}<figcaption>"
            "<h3>Over time</h3><p>Number of detected discs; position error (rms) from the fits, and the "
            "deepest overlap of two discs, which hard discs cannot have; distance of the rim from the "
            "fitted path.</p><p class=small><code>frames.csv</code>, <code>figure_found.pdf</code></p>"
            "</figcaption></figure>\n"]),
        "<h2>Made by</h2>\n", report.pairs([("command", found["command"]), ("version", found["version"])]),
        "</body></html>\n"])


def main():
    folder, found = report.described_folder("found.json", "swirl track --report",
                                            "draws and writes report.html")
    frames = style.read(os.path.join(folder, "frames.csv"))
    discs = style.read(os.path.join(folder, "discs.csv"))
    draw(folder, frames, found["discs"])
    report.write(os.path.join(folder, "report.html"), page(folder, found, discs))


if __name__ == "__main__":
    main()
