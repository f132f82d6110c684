"""Sphinx configuration of the documentation. The source folder is the root of the tree, so that the
links of the pages to source files work unchanged:

    sphinx-build -c docs . OUT

`swirl site` adds the gallery and the executed notebooks (web/site.py).
"""

import os
import posixpath
import re
import struct
from html import escape
from io import BytesIO

from docutils import nodes
from sphinx import addnodes
from sphinx.transforms.post_transforms import SphinxPostTransform
from sphinx.util.nodes import make_refnode

project = "swirl"
root_doc = "docs/index"
extensions = ["myst_parser"]
include_patterns = [
    "*.md",
    "docs/*.md",
    "docs/**/*.md",
    "bench/*.md",
    "bench/**/*.md",
    "src/**/README.md",
    "examples/*.md",
    "tests/**/README.md",
]
exclude_patterns = ["build", "out", "web", ".git", ".github", "bindings", "**/node_modules"]
# A heading of the third level directly below the first is no error.
suppress_warnings = ["myst.header"]

myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 4
html_theme = "furo"
html_title = "swirl"
html_copy_source = False
html_show_sourcelink = False
html_show_copyright = False
pygments_style = "default"
# Quotes and ellipses only: the hyphens of "--mu" in a table stay as they are.
smartquotes_action = "qe"
html_math_renderer = "mathtext"
html_static_path = ["site.css"]
html_css_files = ["site.css"]

# The public address of the site, which the picture of a link preview needs (web/site.sh).
ADDRESS = os.environ.get("SWIRL_SITE_ADDRESS", "")
html_baseurl = ADDRESS  # Sphinx writes the canonical address of each page
PROJECT = ["/README", "/gallery", "/examples/index"]


def add_contents(app, docname, source):
    """Appends the tables of contents to the home page: its own lists, in their order. Pages in src,
    bench and tests are in none. The pages themselves have no Sphinx directives, since they are also
    read as plain Markdown."""
    if docname.startswith(("src/", "bench/", "tests/", "track/")):
        source[0] = f"---\norphan: true\n---\n{source[0]}"
    if docname != root_doc:
        return
    for section in re.findall(r"^## (.*\n(?:.*\n)*?)(?=^## |\Z)", f"{source[0]}\n", re.M):
        caption, _, text = section.partition("\n")
        pages = re.findall(r"^- .*?\]\((.*?)\.md\)", text, re.M)
        pages += [
            name
            for name in PROJECT
            if caption == "Project" and os.path.exists(f"{app.srcdir}{name}.md")
        ]
        if pages:
            listed = "\n".join(f"/{page[3:]}" if page.startswith("../") else page for page in pages)
            source[
                0
            ] += f"\n```{{toctree}}\n:caption: {caption.split(':')[0]}\n:hidden:\n\n{listed}\n```\n"


SUBSCRIPT = re.compile(r"(?<!\w)([A-Za-zϖμωφθτρηΓσ])_([A-Za-zθ]{1,3})(?!\w)")


def set_subscripts(app, doctree, docname):
    """N_c, which plain Markdown shows as it is, with a subscript."""
    for text in list(doctree.findall(nodes.Text)):
        if any(
            isinstance(
                above, (nodes.literal, nodes.literal_block, nodes.raw, nodes.math, nodes.math_block)
            )
            for above in (text.parent, text.parent.parent)
        ) or not SUBSCRIPT.search(text):
            continue
        parts = SUBSCRIPT.split(text)
        made = [nodes.Text(parts[0])]
        for symbol, index, rest in zip(parts[1::3], parts[2::3], parts[3::3]):
            made += [nodes.Text(symbol), nodes.subscript("", index), nodes.Text(rest)]
        text.parent.replace(text, made)


def describe_page(app, pagename, templatename, context, doctree):
    """Title, text and picture for pages that link to this one (Open Graph)."""
    first = doctree and next((each.astext() for each in doctree.findall(nodes.paragraph)), "")
    tags = {
        "title": f"{re.sub('<[^>]+>', '', context.get('title') or project)} – swirl",
        "description": " ".join((first or "Why a few marbles in a swirled dish reverse.").split())[
            :300
        ],
        "type": "website",
    }
    if ADDRESS:
        tags["image"] = f"{ADDRESS}preview.png"
    context["metatags"] = (
        context.get("metatags", "")
        + f'<meta name="description" content="{escape(tags["description"])}" />'
        + "".join(
            f'<meta property="og:{name}" content="{escape(text)}" />' for name, text in tags.items()
        )
    )
    if "body" in context:
        context["body"] = with_late_images(scrollable_tables(context["body"]), app.srcdir)


def scrollable_tables(body):
    """A wide table scrolls in a box of its own, also by the keyboard."""
    box = '<div class="scrolls" tabindex="0" role="group" aria-label="Table">'
    return body.replace("<table", f"{box}<table").replace("</table>", "</table></div>")


def with_late_images(body, source):
    """Images are loaded when they are near the window. Their sizes keep the place of each."""

    def late(found):
        name = found[1]
        for place in ("docs/images", "gallery", "examples"):
            path = os.path.join(source, place, name)
            size = image_size(path) if os.path.exists(path) else None
            if size:
                return f'{found[0]} loading="lazy" width="{size[0]}" height="{size[1]}"'
        return found[0]

    return re.sub(r'<img alt="[^"]*" src="[^"]*_images/([^"/]+)"', late, body)


def image_size(path):
    """(width, height) of a PNG or GIF; None for other images."""
    with open(path, "rb") as opened:
        head = opened.read(24)
    if head.startswith(b"\x89PNG"):
        return struct.unpack(">II", head[16:24])
    if head.startswith(b"GIF8"):
        return struct.unpack("<HH", head[6:10])
    return None


def resolve_folder(app, env, node, contnode):
    """A link to a folder leads to its page, if it has one; otherwise its text remains."""
    target = posixpath.normpath(
        posixpath.join(posixpath.dirname(node.get("refdoc", "")), node["reftarget"])
    )
    if not os.path.isdir(os.path.join(app.srcdir, target)):
        return None
    for page in (f"{target}/index", f"{target}/README"):
        if page in env.found_docs:
            return make_refnode(app.builder, node["refdoc"], page, "", contnode)
    return contnode


class Folders(SphinxPostTransform):
    """Resolves links to folders before MyST, whose newer versions ask nobody and warn."""

    default_priority = 5  # MyST has 9

    def run(self, **_):
        for node in list(self.document.findall(addnodes.pending_xref)):
            if node["reftype"] != "myst":
                continue
            found = resolve_folder(self.app, self.env, node, node[0].deepcopy())
            if found is not None:
                node.replace_self(found)


# The size of the text, in the units of a formula's lengths. The formula's letters are larger: their
# small letters have the height of those of the text.
SIZE = 10


def math_svg(formula):
    """The formula as SVG by matplotlib, since MathJax would need a network."""
    from matplotlib import rc_context
    from matplotlib.font_manager import FontProperties
    from matplotlib.mathtext import math_to_image

    formula = " ".join(formula.split())
    # mathtext needs braces for the arguments of fonts and fractions.
    formula = re.sub(r"\\(mathbf|mathrm|mathcal)\s+([A-Za-z])", r"\\\1{\2}", formula)
    formula = re.sub(
        r"\\text\{([^}]*)\}", lambda text: f"\\mathrm{{{text[1]}}}".replace(" ", r"\ "), formula
    )
    formula = re.sub(r"\\(ge|le)(?![a-z])", r"\\\1q", formula)  # names that matplotlib has
    image = BytesIO()
    with rc_context({"svg.fonttype": "path", "mathtext.fontset": "cm", "svg.hashsalt": "swirl"}):
        depth = math_to_image(
            f"${formula}$", image, FontProperties(size=1.2 * SIZE), dpi=72, format="svg"
        )
    # Lengths relative to the size of the text, and the formula's base line on that of the text.
    text = re.sub(
        r'(width|height)="([\d.]+)pt"',
        lambda length: f'{length[1]}="{float(length[2]) / SIZE:.3f}em"',
        image.getvalue().decode(),
    )
    return (
        f'<span role="img" aria-label="{escape(formula)}" class="formula" style="vertical-align: '
        f'{-depth / SIZE:.3f}em">{text[text.index("<svg"):]}</span>'
    )


def visit_math(self, node):
    self.body.append(math_svg(node.astext()))
    raise nodes.SkipNode


def visit_math_block(self, node):
    self.body.append(
        f'<div class="formula-block">{math_svg(node.astext().replace("frac{", "dfrac{"))}</div>'
    )
    raise nodes.SkipNode


def bundle_theme(app, exception):
    """Makes Debian's furo work from file://. Its script imports a second one, and its style sheet
    one of the web server; both are inserted here."""
    if exception:
        return
    style = os.path.join(app.outdir, "_static", "styles", "furo.css")
    with open(style, encoding="utf-8") as opened:
        text = opened.read()
    with open("/usr/share/javascript/normalize.css/normalize.css", encoding="utf-8") as opened:
        text = re.sub(r"@import [^;]*/normalize\.css[^;]*;", lambda _: opened.read(), text)
    with open(style, "w", encoding="utf-8") as opened:
        opened.write(text)
    scripts = os.path.join(app.outdir, "_static", "scripts")
    parts = []
    for name in ("gumshoe-patched.js", "furo.js"):
        if not os.path.exists(os.path.join(scripts, name)):
            return
        with open(os.path.join(scripts, name), encoding="utf-8") as opened:
            script = opened.read()
        parts.append(re.sub(r"^import (\* as )?Gumshoe from .*$", "", script, flags=re.M))
    # A heading "Exports" defines a global of that name in the browser, which this test takes for
    # Node.js.
    parts[0] = parts[0].replace('typeof exports === "object"', "false")
    # A page without subheadings has no last item.
    parts[0] = re.sub(
        r"(var useLastItem = function \(item, settings\) \{)",
        r"\1 if (!item) return false;",
        parts[0],
    )
    with open(os.path.join(scripts, "furo.js"), "w", encoding="utf-8") as opened:
        opened.write("\n".join(parts))
    os.remove(os.path.join(scripts, "gumshoe-patched.js"))


def setup(app):
    app.connect("build-finished", bundle_theme)
    app.connect("source-read", add_contents)
    app.add_post_transform(Folders)
    app.connect("doctree-resolved", set_subscripts)
    app.connect("html-page-context", describe_page)
    app.add_html_math_renderer("mathtext", (visit_math, None), (visit_math_block, None))
