"""Prepares the source folder of `swirl site` for Sphinx: links to the tree, plus the gallery and
the notebooks as pages, and the live dish on the front page.

    site.py ROOT SOURCE GALLERY NOTEBOOKS

GALLERY has the files that the commands of web/gallery.txt made. NOTEBOOKS has the executed
notebooks; any other notebook is shown without output.
"""

import base64
import json
import os
import re
import shutil
import sys

SKIPPED = {"build", "out", ".git", "docs", "examples"}


def copy_tree(root, source):
    for name in os.listdir(root):
        if name not in SKIPPED:
            os.symlink(os.path.join(root, name), os.path.join(source, name))
    for name in ("docs", "examples"):
        shutil.copytree(os.path.join(root, name), os.path.join(source, name))


def write(path, text):
    with open(path, "w", encoding="utf-8") as opened:
        opened.write(text)


def video(source, more=""):
    """A movie, which is loaded when it plays; until then its first image is shown."""
    first = source.removesuffix(".mp4") + ".jpg"
    return (
        f'<video src="{source}" poster="{first}" {more} loop muted playsinline preload="none">'
        "</video>"
    )


def rows_of(root, name):
    """The rows of a table whose columns are separated by bars."""
    with open(os.path.join(root, name), encoding="utf-8") as opened:
        return [
            line.rstrip("\n").split(" | ") for line in opened if line.strip() and line[0] != "#"
        ]


def gallery_page(root, source, gallery):
    page = [
        "# Gallery\n\nFor every reader: images and movies, each with the command that makes it.\n"
    ]
    for caption, command, *stored in rows_of(root, "web/gallery.txt"):
        shown = stored[0] if stored else "gallery/" + re.search(r"--out (\S+)", command)[1]
        if not stored:
            made = os.path.join(gallery, os.path.basename(shown))
            if not os.path.exists(made):
                continue
            shutil.copy(made, os.path.join(source, "gallery"))
        alt = re.sub(r"([\[\]])", r"\\\1", caption)
        page.append(
            f"![{alt}]({shown})\n"
            if not shown.endswith(".mp4")
            else f'```{{raw}} html\n{video(shown, "controls")}\n```\n'
        )
        page.append(f"{caption}\n\n```sh\n./{command}\n```\n")
    write(os.path.join(source, "gallery.md"), "\n".join(page))


DISH = """```{raw} html
<iframe class="dish" src="../lab.html?embed=1" title="Live simulation"></iframe>
<p>The dish is simulated in your browser. <a href="../lab.html">Open the whole page.</a></p>
"""
# Movies start by themselves, unless the reader wants less motion.
PLAY = """<script>
for (const movie of document.querySelectorAll(".tiles video"))
    if (!matchMedia("(prefers-reduced-motion: reduce)").matches) movie.play().catch(() => {});
</script>
```
"""


def tiles(root, gallery):
    """Links with a movie to one page for each topic (web/tiles.txt). A movie that was not made,
    because ffmpeg is missing, is left out."""
    made = []
    for topic, page, command in rows_of(root, "web/tiles.txt"):
        name = re.search(r"--out (\S+)", command)[1]
        movie = video(f"../gallery/{name}") if os.path.exists(os.path.join(gallery, name)) else ""
        made.append(f'<a href="{page}">{movie}<span>{topic}</span></a>')
    return '<nav class="tiles" aria-label="Topics">\n' + "\n".join(made) + "\n</nav>\n"


def front_page(root, source, gallery):
    """The documentation's front page begins with its name, its purpose, the live dish and a tile
    for each topic."""
    path = os.path.join(source, "docs", "index.md")
    with open(path, encoding="utf-8") as opened:
        heading, purpose, picture, caption, rest = opened.read().split("\n\n", 4)
    assert picture.startswith("![") and caption.startswith("*"), "the dish replaces the animation"
    write(path, f"{heading}\n\n{purpose}\n\n{DISH}{tiles(root, gallery)}{PLAY}\n{rest}")


def output_markdown(output, folder, name):
    """The richest form of a cell's output. Images become files next to the page."""
    if output["output_type"] == "stream":
        return fenced("".join(output["text"]))
    data = {
        kind: "".join(value)
        for kind, value in output.get("data", {}).items()
        if isinstance(value, (str, list))
    }
    for kind, suffix in (("image/svg+xml", "svg"), ("image/png", "png")):
        if kind in data:
            with open(os.path.join(folder, f"{name}.{suffix}"), "wb") as opened:
                opened.write(
                    data[kind].encode() if suffix == "svg" else base64.b64decode(data[kind])
                )
            return f"![Output of the cell above]({name}.{suffix})\n"
    if "text/html" in data:
        return f"```````{{raw}} html\n{data['text/html']}\n```````\n"
    return fenced(data.get("text/plain", ""))


def fenced(text, language="text"):
    return f"```````{language}\n{text.rstrip()}\n```````\n"


def notebook_pages(source, executed):
    folder = os.path.join(source, "examples")
    names = sorted(name for name in os.listdir(folder) if name.endswith(".ipynb"))
    for name in names:
        run = os.path.join(executed, name)
        with open(
            run if os.path.exists(run) else os.path.join(folder, name), encoding="utf-8"
        ) as opened:
            cells = json.load(opened)["cells"]
        parts = []
        for k, cell in enumerate(cells):
            text = "".join(cell["source"])
            if cell["cell_type"] == "markdown":
                parts.append(text + "\n")
                continue
            parts.append(fenced(text, "python"))
            parts += [
                output_markdown(each, folder, f"{name[:-6]}_{k}_{j}")
                for j, each in enumerate(cell["outputs"])
            ]
        write(os.path.join(folder, name[:-6] + ".md"), "\n".join(parts))
    write(
        os.path.join(folder, "index.md"),
        "# Notebooks\n\nFor users of Python: the notebooks of the folder "
        "examples with their output.\n\n```{toctree}\n"
        + "\n".join(name[:-6] for name in names)
        + "\n```\n",
    )


if __name__ == "__main__":
    root, source, gallery, notebooks = sys.argv[1:5]
    copy_tree(root, source)
    front_page(root, source, gallery)
    os.makedirs(os.path.join(source, "gallery"), exist_ok=True)
    gallery_page(root, source, gallery)
    notebook_pages(source, notebooks)
