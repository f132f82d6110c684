"""Figure 1c: the M-frame, and the two forces that act in it.

    /usr/bin/python3 figures/figure_1c.py out/figure_1c.csv
"""

import math

import style


def arrow(axes, start, end, color, text="", shift=(0, 0)):
    axes.annotate("", xy=end, xytext=start,
                  arrowprops={"arrowstyle": "-|>", "color": color, "linewidth": 1.1,
                              "shrinkA": 0, "shrinkB": 0, "mutation_scale": 8})
    axes.text(end[0] + shift[0], end[1] + shift[1], text, color=color, ha="center", va="center")


def main():
    table = style.table_from_arguments("figure_1c")
    row = style.read(table)[0]
    R, A = row["container_radius"], row["amplitude"]
    drawing, (lab, frame) = style.figure(height=1.95, ncols=2)
    for axes in (lab, frame):
        style.bare(axes)
    # The lab: the container at an angle of 50 degrees on its path.
    at = math.radians(50)
    C = (A * math.cos(at), A * math.sin(at))
    lab.add_patch(style.plt.Circle((0, 0), A, fill=False, color=style.GREY, linestyle=":"))
    lab.add_patch(style.plt.Circle(C, R, fill=False, color=style.BLACK))
    M = (C[0] + R * math.cos(at), C[1] + R * math.sin(at))
    lab.plot(*zip((0, 0), C, M), color=style.GREY, linewidth=0.6)
    for name, point, side in (("S", (0, 0), (-0.9, -0.9)), ("C", C, (1.0, -0.7)),
                              ("M", M, (1.0, 0.8))):
        lab.plot(*point, "o", color=style.BLACK, markersize=3)
        lab.text(point[0] + side[0], point[1] + side[1], name, ha="center", va="center")
    arrow(lab, (C[0], C[1]), (C[0] - 3 * math.sin(at), C[1] + 3 * math.cos(at)), style.BLUE,
          "velocity of\nthe container", (0.2, 1.5))
    lab.set_title("lab: the container does not turn", fontsize=7)
    lab.set_xlim(-R - 1, R + A + 2.5)
    lab.set_ylim(-R - 1.2, R + A + 2.5)
    # The M-frame.
    frame.add_patch(style.plt.Circle((0, 0), R, fill=False, color=style.BLACK))
    S = (0, A)
    for name, point, side in (("S", S, (0.9, 0.3)), ("C", (0, 0), (0.9, -0.3)),
                              ("M", (0, -R), (0, -1.0))):
        frame.plot(*point, "o", color=style.BLACK, markersize=3)
        frame.text(point[0] + side[0], point[1] + side[1], name, ha="center", va="center")
    for degrees in (0, 60, 120, 180, 240, 300):  # the wall runs clockwise
        a, b = math.radians(degrees + 14), math.radians(degrees - 14)
        arrow(frame, (1.08 * R * math.cos(a), 1.08 * R * math.sin(a)),
              (1.08 * R * math.cos(b), 1.08 * R * math.sin(b)), style.GREY)
    disc = (-4.4, -3.0)
    frame.add_patch(style.plt.Circle(disc, 1, facecolor=style.GREEN, alpha=0.35,
                                     edgecolor=style.GREEN))
    v = (-0.6, 2.4)
    arrow(frame, disc, (disc[0] + v[0], disc[1] + v[1]), style.BLUE, "$v$", (-0.7, 0.3))
    from_s = (disc[0] - S[0], disc[1] - S[1])
    frame.plot(*zip(S, disc), color=style.GREY, linewidth=0.5, linestyle=":")
    arrow(frame, disc, (disc[0] + 0.42 * from_s[0], disc[1] + 0.42 * from_s[1]), style.ORANGE,
          r"$F_{\rm cent}$", (0.2, -0.9))
    arrow(frame, disc, (disc[0] + v[1], disc[1] - v[0]), style.RED, r"$F_{\rm Cor}$", (1.5, 0.1))
    frame.set_title(r"M-frame: the wall turns with $-\Omega$", fontsize=7)
    frame.set_xlim(-1.25 * R, 1.25 * R)
    frame.set_ylim(-1.3 * R, 1.25 * R)
    style.save(drawing, table)


if __name__ == "__main__":
    main()
