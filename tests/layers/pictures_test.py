"""Every picture of the documentation has a caption in words. It is the line in italics below the
picture."""

import os
import pathlib
import re
import unittest

SOURCE = pathlib.Path(os.environ.get("SWIRL_SOURCE", pathlib.Path(__file__).parents[2]))
PAGES = [SOURCE / "README.md", *sorted((SOURCE / "docs").rglob("*.md"))]
# Pages whose text below a picture describes it.
DESCRIBED = ("docs/explanation/why.md",)
# Its next sentences describe it.
WITHOUT = {("README.md", "docs/images/swirl.gif")}
PICTURE = re.compile(r"^!\[([^\]]*)\]\(([^)]*)\)$", re.M)
LEAST = 8  # words


def captions_of(text):
    """[(picture, alternative text, caption)]; neighbouring pictures share a caption, which is empty
    if there is none."""
    found = []
    for group in re.finditer(r"(?:^!\[[^\]]*\]\([^)]*\)\n)+", text, re.M):
        below = re.match(r"\s*\*([^*].*?)\*(?!\*)", text[group.end() :], re.S)
        caption = " ".join(below[1].split()) if below and "\n\n" not in below[0].strip() else ""
        found += [(picture, words, caption) for words, picture in PICTURE.findall(group[0])]
    return found


class Pictures(unittest.TestCase):
    def test_every_picture_has_a_caption(self):
        count = 0
        for page in PAGES:
            name = page.relative_to(SOURCE).as_posix()
            for picture, words, caption in captions_of(page.read_text(encoding="utf-8")):
                if name in DESCRIBED or (name, picture) in WITHOUT:
                    continue
                count += 1
                with self.subTest(page=name, picture=picture):
                    self.assertGreaterEqual(
                        len(caption.split()), LEAST, "a caption says what to see"
                    )
                    self.assertNotEqual(caption.rstrip("."), words.rstrip("."))
        self.assertGreater(count, 30)

    def test_a_picture_without_a_caption_is_found(self):
        text = (
            "![a](b.png)\n(`command`)\n\nText *in italics*.\n\n![c](d.png)\n![e](f.png)\n\n"
            "*What both\nshow.*\n"
        )
        self.assertEqual(
            captions_of(text),
            [
                ("b.png", "a", ""),
                ("d.png", "c", "What both show."),
                ("f.png", "e", "What both show."),
            ],
        )


if __name__ == "__main__":
    unittest.main()
