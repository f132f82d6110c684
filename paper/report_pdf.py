"""The report as PDF: a title page with contents, then the same text and figures as report.html. Each entry of the
contents is a link, and a bookmark of the file.
"""

import io
import os
import re
import textwrap

import numpy as np

import style  # noqa: F401 sets the backend
from html_page import size_of
from matplotlib.backends.backend_pdf import PdfPages
from matplotlib.figure import Figure
from style import plt

WIDTH, HEIGHT, MARGIN = 8.27, 11.69, 0.8  # A4, in inches
LETTER = 0.57  # mean width of a letter of DejaVu Sans, in font sizes
LEADING = 1.4  # distance of lines, in font sizes
POINTS = 72


class Pages:
    """Fills pages from the top to the bottom, and remembers where the headings are."""

    def __init__(self, title):
        plt.rcParams.update(style.SETTINGS)
        self.pages = [self._new()]
        self.top = HEIGHT - MARGIN
        self.headings = []  # (text, page, height above the bottom of the page)
        self.title = title

    @staticmethod
    def _new():
        return Figure(figsize=(WIDTH, HEIGHT))

    def break_page(self):
        self.pages.append(self._new())
        self.top = HEIGHT - MARGIN

    def _require(self, height):
        if self.top - height < MARGIN:
            self.break_page()

    def text(self, text, size=9, weight="normal", color="black", indent=0.0, bullet=""):
        letters = int((WIDTH - 2 * MARGIN - indent) * POINTS / (LETTER * size))
        line = LEADING * size / POINTS
        for k, part in enumerate(textwrap.wrap(text, letters)):
            self._require(line)
            y = (self.top - 0.8 * line) / HEIGHT
            if bullet and k == 0:
                self.pages[-1].text((MARGIN + indent - 0.15) / WIDTH, y, bullet, fontsize=size)
            self.pages[-1].text((MARGIN + indent) / WIDTH, y, part.replace("$", r"\$"), fontsize=size,
                                weight=weight, color=color)
            self.top -= line
        self.space(0.06)

    def heading(self, text, size=13, below=0.0):
        """`below`: height of an image that must be on the same page."""
        self._require(max(1.2, 0.6 + below))
        self.space(0.12)
        self.headings.append((text, len(self.pages) - 1, self.top, size))
        self.text(text, size=size, weight="bold")

    def space(self, height):
        self.top -= height

    def image(self, file):
        pixels = np.uint8(np.round(255 * plt.imread(file)))  # a quarter of the memory, which all pages together need
        width, height = size_on_page(*size_of(file))
        self._require(height)
        axes = self.pages[-1].add_axes(((WIDTH - width) / 2 / WIDTH, (self.top - height) / HEIGHT,
                                        width / WIDTH, height / HEIGHT))
        axes.imshow(pixels, aspect="auto")
        axes.axis("off")
        self.top -= height + 0.08

    def contents(self, page, top, entries_per_page):
        """Writes the contents to pages reserved from `page` on. Returns [(page, y, target)]."""
        links = []
        for k, (text, target, _, size) in enumerate(self.headings):
            on, line = divmod(k, entries_per_page)
            y = (top if on == 0 else HEIGHT - MARGIN) - 0.2 * line
            figure, indent = self.pages[page + on], 0.0 if size > 11 else 0.2
            figure.text((MARGIN + indent) / WIDTH, y / HEIGHT, shortened(text), fontsize=8.5)
            figure.text((WIDTH - MARGIN) / WIDTH, y / HEIGHT, str(target + 1), fontsize=8.5, ha="right")
            links.append((page + on, y, k))
        return links

    def bytes(self, links):
        for k, figure in enumerate(self.pages):
            figure.text(0.5, 0.4 * MARGIN / HEIGHT, str(k + 1), fontsize=8, ha="center", color="0.4")
        file = io.BytesIO()
        with PdfPages(file, metadata={"Title": self.title, "CreationDate": None}) as pdf:
            for figure in self.pages:
                pdf.savefig(figure)
        return with_outline(file.getvalue(), self.headings, links)


def size_on_page(across, up, max_width=WIDTH - 2 * MARGIN, max_height=5.0):
    """Width and height in inches, of at least 220 pixels per inch."""
    width = min(max_width, across / 220)
    height = width * up / across
    return (width, height) if height <= max_height else (width * max_height / height, max_height)


def shortened(text, letters=95):
    return text if len(text) <= letters else text[:letters - 1].rsplit(" ", 1)[0] + " …"


def pdf_text(text):
    return "<" + ("\ufeff" + text).encode("utf-16-be").hex() + ">"


def destination(page_objects, headings, k):
    _, page, top, _ = headings[k]
    return f"[{page_objects[page]} 0 R /XYZ 0 {(top + 0.1) * POINTS:.1f} null]"


def with_outline(pdf, headings, links):
    """The PDF with bookmarks and links, appended as an incremental update (ISO 32000-1, 7.5.6)."""
    tail = pdf[pdf.rindex(b"trailer"):].decode("latin-1")
    root = int(re.search(r"/Root (\d+) 0 R", tail)[1])
    size = int(re.search(r"/Size (\d+)", tail)[1])
    start = int(re.search(r"startxref\s+(\d+)", tail)[1])

    def content(number):
        found = re.search(rb"(?:^|\n)%d 0 obj\n(.*?)\nendobj" % number, pdf, re.DOTALL)
        return found[1].decode("latin-1")

    catalog = content(root)
    kids = content(int(re.search(r"/Pages (\d+) 0 R", catalog)[1]))
    pages = [int(n) for n in re.findall(r"(\d+) 0 R", re.search(r"/Kids \[(.*?)\]", kids, re.DOTALL)[1])]
    objects, outline = {}, size
    objects[root] = catalog.rstrip().removesuffix(">>") + f"/Outlines {outline} 0 R /PageMode /UseOutlines >>"
    first = outline + 1
    objects[outline] = (f"<< /Type /Outlines /First {first} 0 R /Last {first + len(headings) - 1} 0 R "
                        f"/Count {len(headings)} >>")
    for k, (text, _, _, _) in enumerate(headings):
        beside = (f"/Prev {first + k - 1} 0 R " if k else "") + \
                 (f"/Next {first + k + 1} 0 R " if k + 1 < len(headings) else "")
        objects[first + k] = (f"<< /Title {pdf_text(text)} /Parent {outline} 0 R {beside}"
                              f"/Dest {destination(pages, headings, k)} >>")
    for page in {page for page, _, _ in links}:
        rectangles = [f"<< /Type /Annot /Subtype /Link /Border [0 0 0] /Rect [{MARGIN * POINTS} "
                      f"{(y - 0.05) * POINTS:.1f} {(WIDTH - MARGIN) * POINTS} {(y + 0.14) * POINTS:.1f}] "
                      f"/Dest {destination(pages, headings, k)} >>" for on, y, k in links if on == page]
        about = re.sub(r"/Annots (\d+ 0 R|\[.*?\])", "", content(pages[page]), flags=re.DOTALL)
        objects[pages[page]] = about.rstrip().removesuffix(">>") + f"/Annots [{' '.join(rectangles)}] >>"
    added, table = bytearray(b"\n"), "xref\n0 1\n0000000000 65535 f \n"
    for number in sorted(objects):
        table += f"{number} 1\n{len(pdf) + len(added):010d} 00000 n \n"
        added += f"{number} 0 obj\n{objects[number]}\nendobj\n".encode("latin-1")
    at = len(pdf) + len(added)
    info = re.search(r"/Info \d+ 0 R", tail)
    table += (f"trailer\n<< /Size {first + len(headings)} /Root {root} 0 R {info[0] if info else ''} "
              f"/Prev {start} >>\nstartxref\n{at}\n%%EOF\n")
    return pdf + bytes(added) + table.encode("latin-1")


def plain(text):
    """Text without the marks of Markdown."""
    return re.sub(r"[`*]", "", str(text)).replace("\n", " ")


def write_figure(pages, folder, f):
    images = [os.path.join(folder, name) for name in f.get("images", ())]
    pages.heading(plain(f["title"]), size=10.5, below=sum(size_on_page(*size_of(image))[1] for image in images))
    for image in images:
        pages.image(image)
    for name in ("question", "caption"):
        pages.text(plain(f.get(name, "")))
    write_block(pages, folder, "bullets", f.get("findings", ()))
    for text in (*f.get("remarks", ()), f.get("command", "")):
        write_block(pages, folder, "small", text)


def write_claim(pages, folder, c):
    pages.text(plain(f"{c['number']}. {c['statement']} ({c['source']})"))
    write_block(pages, folder, "bullets", [f"{c['verdict']}: {c['found']}"])
    write_block(pages, folder, "small", "; ".join(filter(None, (f"judged on {c['on']}", c["sizes"], c["command"]))))


def write_block(pages, folder, kind, value):
    """A block of a page (html_page.py)."""
    if kind == "section":
        pages.break_page()
        pages.heading(value)
    elif kind == "picture":
        pages.image(os.path.join(folder, value))
    elif kind == "table":
        write_block(pages, folder, "bullets", [f"{row[0]}: " + " Here: ".join(map(str, row[1:])) for row in value[1]])
    elif kind == "text":
        pages.text(plain(value))
    elif kind == "small":
        pages.text(plain(value), size=8, color="0.35")
    else:
        for one in value:
            if kind == "bullets":
                pages.text(plain(one), indent=0.2, bullet="•")
            else:
                (write_figure if kind == "figures" else write_claim)(pages, folder, one)


def report_pdf(folder, title, blocks):
    """The file as bytes. The blocks before the first section are the first page; the contents follow."""
    pages = Pages(title)
    pages.text(title, size=18, weight="bold")
    first = next((k for k, (kind, _) in enumerate(blocks) if kind == "section"), len(blocks))
    for kind, value in blocks[:first]:
        write_block(pages, folder, kind, value)
    entries = sum(kind == "section" or len(value) * (kind == "figures") for kind, value in blocks)
    pages.break_page()
    pages.text("Contents", size=13, weight="bold")
    page, top = len(pages.pages) - 1, pages.top - 0.1
    per_page = int((HEIGHT - 2 * MARGIN - 0.6) / 0.2)
    for _ in range((entries - 1) // per_page):
        pages.break_page()
    for kind, value in blocks[first:]:
        write_block(pages, folder, kind, value)
    return pages.bytes(pages.contents(page, top, per_page))
