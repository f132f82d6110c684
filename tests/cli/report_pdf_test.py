"""The report as PDF (paper/report_pdf.py): its bookmarks and links refer to objects that exist."""

import os
import re
import subprocess
import sys
import tempfile
import unittest

from program import read_bytes

SOURCE = os.environ.get("SWIRL_SOURCE", ".")
PYTHON = "/usr/bin/python3"

MAKE = """
import sys
sys.path.insert(0, sys.argv[1])
import report_pdf
figure = {"caption": "word " * 900, "findings": ["$x$ a_b"]}
blocks = [("text", "Opening"), ("bullets", ["one"])]
for k in range(30):
    blocks += [("section", f"Section {k} with ϖ"), ("figures", [{"title": f"Part {k}", **figure}])]
made = report_pdf.report_pdf(".", "Title", blocks)
open(sys.argv[2], "wb").write(made)
"""


class ReportPdf(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if subprocess.run([PYTHON, "-c", "import matplotlib"], capture_output=True).returncode:
            print("matplotlib is not installed")
            sys.exit(77)
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "r.pdf")
            subprocess.run([PYTHON, "-B", "-c", MAKE, os.path.join(SOURCE, "paper"), file], check=True,
                           timeout=120)
            cls.pdf = read_bytes(file)

    def objects(self):
        """The last version of each object, by the tables of both parts of the file."""
        found = {}
        start = int(re.findall(rb"startxref\s+(\d+)", self.pdf)[-1])
        while start is not None:
            table, trailer = self.pdf[start:].split(b"trailer", 1)
            lines = table.split(b"\n")[1:]
            number = 0
            for line in lines:
                if re.fullmatch(rb"\d+ \d+\s*", line):
                    number = int(line.split()[0])
                elif re.match(rb"\d{10} \d{5} [nf]", line):
                    if line[17:18] == b"n":
                        at = int(line[:10])
                        self.assertTrue(self.pdf[at:].startswith(b"%d 0 obj" % number), number)
                        found.setdefault(number, self.pdf[at:self.pdf.index(b"endobj", at)])
                    number += 1
            before = re.search(rb"/Prev (\d+)", trailer[:trailer.index(b"startxref")])
            start = int(before[1]) if before else None
        return found

    def test_each_heading_is_a_bookmark_and_a_link_to_its_page(self):
        objects = self.objects()
        pages = {number for number, text in objects.items() if re.search(rb"/Type /Page\b", text)}
        self.assertGreater(len(pages), 30)
        bookmarks = [text for text in objects.values() if b"/Title" in text and b"/Dest" in text]
        self.assertEqual(len(bookmarks), 60)
        for text in bookmarks:
            self.assertIn(int(re.search(rb"/Dest \[(\d+) 0 R", text)[1]), pages)
            title = bytes.fromhex(re.search(rb"/Title <(\w+)>", text)[1].decode()).decode("utf-16")
            self.assertRegex(title, r"^(Section \d+ with ϖ|Part \d+)$")
        links = [int(n) for number in pages
                 for n in re.findall(rb"/Subtype /Link.*?/Dest \[(\d+) 0 R", objects[number])]
        self.assertEqual(len(links), 60)
        self.assertTrue(set(links) <= pages)
        catalog = [text for text in objects.values() if b"/Type /Catalog" in text]
        self.assertEqual(len(catalog), 1)
        self.assertIn(b"/Outlines", catalog[0])


if __name__ == "__main__":
    unittest.main()
