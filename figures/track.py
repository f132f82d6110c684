"""The report of one film: report.html (one self-contained file) and figure_found.png and .pdf, from
what `swirl track --report` left in a folder.

    /usr/bin/python3 figures/track.py film
"""

import html
import math
import os

import experiment
import report
import style

FEWEST = 0.99  # of the pictures: a disc that is seen in fewer is doubtful


def draw(folder, pictures, number):
    """What there is over time: discs, errors and overlaps, the rim."""
    drawing, axes = style.figure(height=4.2, nrows=3, sharex=True)
    time = style.column(pictures, "time")
    seen, filled = (style.column(pictures, name) for name in ("seen", "filled"))
    axes[0].plot(time, seen, color=style.RED, linewidth=0.8, label="seen")
    axes[0].plot(time, [s + f for s, f in zip(seen, filled)], color=style.SKY, linewidth=0.8,
                 linestyle=":", label="with those filled in")
    axes[0].axhline(number, color=style.BLACK, linewidth=0.5)
    axes[0].set_ylabel("discs")
    style.legend(axes[0])
    axes[1].plot(time, style.column(pictures, "error"), color=style.RED, linewidth=0.8,
                 label="error of a place")
    axes[1].plot(time, style.column(pictures, "deepest_overlap"), color=style.SKY, linewidth=0.6,
                 label="deepest overlap")
    axes[1].set_ylabel("pixels")
    style.legend(axes[1])
    rims = [row for row in pictures if row["rim_off"] >= 0]
    axes[2].plot(style.column(rims, "time"), style.column(rims, "rim_off"), color=style.RED,
                 linewidth=0.8)
    axes[2].set_ylabel("rim off\nits path, pixels")
    axes[2].set_xlabel("time")
    style.save(drawing, os.path.join(folder, "figure_found.csv"))


def found_rows(found):
    """What was found, with its error."""
    path, dish, lens = found["path"], found["dish"], found["lens"]
    unit = "s" if found["fps"] else "picture"
    omega, omega_error = path["omega"], path["omega_error"]
    radius = found["camera"]["scale"]
    kinds = ", ".join(f"{kind['number']} of {kind['radius']:.2f} pixels radius (scatter of single "
                      f"fits {kind['radius_scatter']:.2f})" for kind in found["kinds"])
    value = experiment.with_error
    rows = [("film", f"{found['film']}, {found['pictures']} pictures of {found['size'][0]} × "
                     f"{found['size'][1]}"),
            ("discs", f"{found['discs']}, {found['discs_are']}: {kinds}"),
            ("dish", f"radius {found['camera']['container-radius'] * radius:.2f} pixels, "
                     f"{found['camera']['container-radius']:.3f} disc radii; the rim that is seen has "
                     f"{dish['rim_radius']:.2f} pixels"),
            ("centre of the swirl, pixels", " and ".join(
                value(c, path["centre_error"]) for c in path["centre"])),
            ("amplitude, pixels", f"{value(path['amplitude'], path['amplitude_error'])}; "
                                  f"{path['amplitude'] / radius:.3f} disc radii"),
            (f"Ω, rad/{unit}", value(omega, omega_error)),
            (f"period, {unit}", value(2 * math.pi / omega, 2 * math.pi * omega_error / omega ** 2)),
            ("sense", "clockwise in the picture" if path["clockwise"] else "counter-clockwise"),
            ("path", path["shape"]),
            ("lens, distortion", value(lens["distortion"], lens["distortion_error"])),
            ("camera", lens["camera"])]
    if found["millimetres_per_pixel"]:
        rows.append(("scale", f"{found['millimetres_per_pixel']:.5f} mm a pixel"))
    return rows


def quality_rows(found, discs):
    quality = found["quality"]
    doubtful = [d for d in discs if d["seen"] < FEWEST * found["pictures"]]
    names = "; ".join(f"{d['particle']:.0f} in {100 * d['seen'] / found['pictures']:.1f} %"
                      for d in doubtful)
    overlaps = quality["position_error_from_overlaps"]
    return [("pictures with all discs", f"{100 * quality['pictures_with_all_discs']:.2f} %"),
            ("positions filled in", str(quality["filled_positions"])),
            ("circles that would have been a disc too many", str(quality["discs_too_many"])),
            ("error of a place, from the fits", f"{quality['position_error']:.3f} pixels"),
            ("the same from overlaps that cannot be",
             f"{overlaps:.3f} pixels" if overlaps > 0 else "too few discs touch to tell"),
            (f"discs seen in fewer than {100 * FEWEST:.0f} % of the pictures", names or "none"),
            ("rim off its path, median", f"{found['path']['residual']:.3f} pixels; "
             f"{100 * found['path']['pictures_that_agree']:.1f} % of the pictures agree with the path")]


def page(folder, found, discs):
    warnings = "".join(f"<li>{html.escape(text)}</li>" for text in found["warnings"])
    name = os.path.basename(found["film"]) or found["film"]

    def image(file, alt):
        return f'<img alt="{alt}" src="{report.inline(os.path.join(folder, file))}">'

    def rows(pairs):
        return report.table(["", ""], [(report.td(a), report.td(b)) for a, b in pairs])

    return "".join([
        report.opening(html.escape(name)),
        f"<h1>{html.escape(name)}</h1>\n",
        f"<ul>{warnings}</ul>\n" if warnings else "<p>Nothing looks wrong.</p>\n",
        "<h2>What was found</h2>\n", rows(found_rows(found)),
        "<h2>How well</h2>\n", rows(quality_rows(found, discs)),
        report.grid([
            f"<figure>{image('film.png', 'the film with the discs that were found')}<figcaption>"
            "<h3>The first picture</h3><p>With the discs that were found drawn over it.</p>"
            "</figcaption></figure>\n",
            f"<figure>{image('figure_found.png', 'discs, errors and rim over time')}<figcaption>"
            "<h3>Over time</h3><p>How many discs were seen; the rms error that their fits claim, and how "
            "deep discs seem to lie in each other, which hard discs cannot; and how far the rim is from "
            "the circle that was fitted.</p><p class=small><code>pictures.csv</code>, "
            "<code>figure_found.pdf</code></p></figcaption></figure>\n"]),
        "<h2>Made by</h2>\n", rows([("command", found["command"]), ("version", found["version"])]),
        "</body></html>\n"])


def main():
    folder, found = report.described_folder("found.json", "swirl track --report",
                                            "draws and writes report.html")
    pictures = style.read(os.path.join(folder, "pictures.csv"))
    discs = style.read(os.path.join(folder, "discs.csv"))
    draw(folder, pictures, found["discs"])
    report.write(os.path.join(folder, "report.html"), page(folder, found, discs))


if __name__ == "__main__":
    main()
