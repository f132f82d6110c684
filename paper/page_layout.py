"""The arrangement of the figures in the report, and their HTML."""

import html
import os
import struct

from captions import image_of, question_of, title_of
from html_page import bullets, grid, inline, rich

# An image wider than this, in pixels, is made for the width of the page; figures for one column have 1012
# (style.COLUMN). So is an image that is wider than FLAT times its height.
ONE_COLUMN = 1200
FLAT = 2.0
# The height of a line of a caption, and its number of letters, in a column of width 1.
LINE, LETTERS = 0.045, 62
MAX_ARRANGED = 12  # figures that are arranged together
STEP_BACK = 0.3    # cost of a figure that begins above the one before it, per column width


def size_of(path):
    """Width and height of a PNG in pixels, from its header."""
    with open(path, "rb") as file:
        return struct.unpack(">16xII", file.read(24))


def is_wide(path):
    width, height = size_of(path)
    return width > ONE_COLUMN or width > FLAT * height


def heights(folder, figure, texts):
    """Approximate heights of the image and of the text below it, in a column of width 1."""
    image = image_of(figure)
    width, height = size_of(os.path.join(folder, image)) if image else (1, 0)
    caption, findings, remarks = texts[figure["name"]]
    blocks = [question_of(figure), caption, *findings, *remarks]
    return height / width, LINE * (3 + sum(-(-len(block) // LETTERS) for block in blocks))


def in_columns(sizes):
    """(cost, [column of each figure]): the most even arrangement in two columns that seldom steps back. `sizes`
    are the heights of figures with their texts."""
    best = None
    for choice in range(1 << max(len(sizes) - 1, 0)):
        ends, begin, cost, sides = [0.0, 0.0], 0.0, 0.0, []
        for k, size in enumerate(sizes):
            side = choice >> (k - 1) & 1 if k else 0
            # If both columns end alike, the left one is cheaper.
            cost += STEP_BACK * max(begin - ends[side], 0.0) + (1e-6 if side and ends[0] == ends[1] else 0)
            begin = ends[side]
            ends[side] += size
            sides.append(side)
        cost += abs(ends[0] - ends[1])
        if best is None or cost < best[0]:
            best = (cost, sides)
    return best


def arranged(sizes):
    """For each figure made for a column, the column (0 or 1), or None if it spans the page with its
    text next to it. The first figure, the last one or both span the page if that leaves less of it empty. `sizes`
    are the heights of images and of texts."""
    if not sizes:
        return []
    if len(sizes) > MAX_ARRANGED:
        return arranged(sizes[:MAX_ARRANGED]) + arranged(sizes[MAX_ARRANGED:])
    whole = [image + text for image, text in sizes]
    cost, sides = in_columns(whole)
    for first, last in ((1, 0), (0, 1), (1, 1)):
        if first + last > len(sizes):
            continue
        inner = range(first, len(sizes) - last)
        less, others = in_columns([whole[k] for k in inner])
        less += sum(abs(image - text) for k, (image, text) in enumerate(sizes) if k not in inner)
        if less < cost:
            cost, sides = less, [None] * first + others + [None] * last
    return sides


def figures_html(folder, figures, texts):
    """One section of the page: wide images across it, others in two columns."""
    parts, row = [], []

    def end_columns(columns):
        if columns[0]:
            parts.extend("<div>\n" + "".join(column) + "</div>\n" for column in columns)

    def end_row():
        columns = [[], []]
        for figure, side in zip(row, arranged([heights(folder, f, texts) for f in row])):
            if side is None:
                end_columns(columns)
                columns = [[], []]
                parts.append(figure_html(folder, figure, "wide split", texts))
            else:
                columns[side].append(figure_html(folder, figure, "", texts))
        end_columns(columns)
        row.clear()

    for figure in figures:
        image = image_of(figure)
        if image is None or is_wide(os.path.join(folder, image)):
            end_row()
            parts.append(figure_html(folder, figure, "wide", texts))
        else:
            row.append(figure)
    end_row()
    return grid(parts)


def figure_html(folder, figure, kind, texts):
    title = title_of(figure)
    image = image_of(figure, (".svg", ".png"))
    kind = "" if not kind else f' class="{kind}"' if " " in kind else f" class={kind}"
    image = (f'<img alt="{html.escape(title)}" src="{inline(os.path.join(folder, image))}">' if image else "")
    caption, findings, remarks = texts[figure["name"]]
    question = f"<p class=question>{rich(question_of(figure))}</p>" if question_of(figure) else ""
    caption = f"<p>{rich(caption)}</p>" if caption else ""
    runs = f"<p class=small>{rich(' '.join(remarks))}</p>" if remarks else ""
    return (f"<figure{kind}>{image}<figcaption><h3>{rich(title)}</h3>{question}{caption}{bullets(findings)}{runs}"
            f"<code>swirl paper --figure {html.escape(figure['name'])}</code></figcaption></figure>\n")
