"""Questions that five kinds of readers ask, and where docs/index.md sends them: the linked section
must exist and answer. Each entry has the words that the answer cannot do without. So a link to a
page that begins with something else is a failure."""

import os
import pathlib
import re
import unittest

SOURCE = pathlib.Path(os.environ.get("SWIRL_SOURCE", pathlib.Path(__file__).parents[2]))
INDEX = SOURCE / "docs" / "index.md"
# Question: patterns that the linked section contains.
ANSWERS = {
    "Why does it reverse?": ("bearings", "pancake"),
    "Can I see it, without installing anything?": (r"one file, `lab\.html`", "animation"),
    "Is that what real marbles do?": (r"(?i)one\s+friction coefficient", "do not fit"),
    "What do the words mean?": ("### Period", "### Swirl"),
    "How fast is it?": ("events", "s"),
    "Which lesson can I give?": ("six steps", "45 minutes"),
    "How do I use the page on a school PC without Debian?": ("Windows", r"tab \*Releases\*"),
    "How do I record and measure our dish?": ("swirl track",),
    "Our dish in mm and rpm: which options?": ("--period", "rpm|per minute"),
    "How accurate is the tracking?": ("±",),
    "How do I set up camera and dish?": ("camera", "light"),
    "My friction coefficient is unknown: what now?": ("N_c", "μ"),
    "My shaker does not move on a circle": ("--motion",),
    "My particles have several sizes": ("--mixture", "--sizes"),
    "How do I compare my tracks with a simulation?": ("swirl experiment",),
    "What exactly is simulated?": ("collision",),
    "Which rotation rate do I quote?": ("by time",),
    "Why are there two values of N_c?": ("rigid",),
    "How long a run do I need for ± 0.001?": ("periods", "error"),
    "What shows the cause of the reversal?": ("cannot spin", "friction between"),
    "Which claims of the paper hold?": ("holds", "does not hold"),
    "How do I run it from Python?": (r"import swirl",),
    "How do I add a measurement?": ("block",),
    "What is in the files?": ("HDF5", "CSV"),
    "Does it give the same result elsewhere?": ("bitwise",),
    "Where do I report a bug?": ("Issues", "`repeat`"),
}
ROW = re.compile(r"^\| ([^*|][^|]*?) \| \[[^\]]*\]\(([^)#]*)(?:#([^)]*))?\)", re.M)


def anchor_of(heading):
    """As on GitHub: small letters, no punctuation, hyphens for spaces."""
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading.strip().lower())
    return re.sub(r"[^\w\- ]", "", text).replace(" ", "-")


def section_of(text, anchor):
    """The section with this anchor, up to the next heading of its level; the whole page without an
    anchor, or None."""
    if not anchor:
        return text
    for found in re.finditer(r"^(#+) (.*)$", text, re.M):
        if anchor_of(found[2]) == anchor:
            end = re.search(rf"^#{{1,{len(found[1])}}} ", text[found.end() :], re.M)
            return text[found.start() : found.end() + end.start()] if end else text[found.start() :]
    return None


def unanswered(index, folder, answers):
    """Questions whose link has no section, or a section without the words of the answer."""
    links = {question: (page, anchor) for question, page, anchor in ROW.findall(index)}
    missing = []
    for question, patterns in answers.items():
        page, anchor = links.get(question, (None, None))
        file = folder / page if page else None
        section = (
            section_of(file.read_text(encoding="utf-8"), anchor)
            if file and file.is_file()
            else None
        )
        if section is None or not all(re.search(pattern, section) for pattern in patterns):
            missing.append(question)
    return missing


class Questions(unittest.TestCase):
    def test_each_question_leads_to_its_answer(self):
        self.assertGreaterEqual(len(ANSWERS), 25)
        self.assertEqual(unanswered(INDEX.read_text(encoding="utf-8"), INDEX.parent, ANSWERS), [])

    def test_every_question_of_the_index_is_checked(self):
        asked = [
            question
            for question, page, _ in ROW.findall(
                INDEX.read_text(encoding="utf-8").split("\n## Tutorials")[0]
            )
        ]
        self.assertEqual(sorted(asked), sorted(ANSWERS))

    def test_wrong_links_are_found(self):
        def found(row):
            return unanswered(row + "\n", INDEX.parent, {"Where?": ("`repeat`",)})

        self.assertEqual(found("| Where? | [here](how-to/report_a_bug.md) |"), [])
        for row in (
            "| Where? | [here](how-to/no_such_page.md) |",
            "| Where? | [here](how-to/report_a_bug.md#no-such-section) |",
            "| Where? | [here](how-to/install.md) |",
            "| Who? | [here](how-to/report_a_bug.md) |",
        ):
            self.assertEqual(found(row), ["Where?"], row)


if __name__ == "__main__":
    unittest.main()
