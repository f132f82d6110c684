"""Progress: a bar on a terminal, an occasional line elsewhere, nothing with --quiet."""

import os
import pty
import select
import subprocess
import unittest

from program import HANG, SWIRL, main, slow


def on_a_terminal(*arguments, **environment):
    """The output of the program to stderr on a terminal."""
    master, slave = pty.openpty()
    clean = {k: v for k, v in os.environ.items() if k != "NO_COLOR"}
    process = subprocess.Popen(
        [SWIRL, *arguments],
        stdout=subprocess.DEVNULL,
        stderr=slave,
        stdin=subprocess.DEVNULL,
        env={**clean, "TERM": "xterm", **environment},
    )
    os.close(slave)
    text = b""
    while True:
        if not select.select([master], [], [], 0.2)[0]:
            if process.poll() is not None:
                break
            continue
        try:
            got = os.read(master, 65536)
        except OSError:  # the program has ended
            break
        if not got:
            break
        text += got
        if text.count(b"\r") > 6:
            process.terminate()
    process.wait(timeout=HANG)
    os.close(master)
    return text.decode()


LONG = ("run", "--events", "1e12", "--checkpoint-every", "0")


class Terminal(unittest.TestCase):
    def test_the_bar_shows_rate_and_time_left_and_is_removed(self):
        text = on_a_terminal(*LONG)
        self.assertGreater(text.count("\r"), 3)
        self.assertRegex(text, r"48 discs .*\d %  [\d.]+ (thousand|million) events/s  .* left")
        self.assertIn("\x1b[36m", text)
        self.assertIn("\r\x1b[K", text[text.rindex("left") :])

    def test_no_color_disables_colors(self):
        text = on_a_terminal(*LONG, NO_COLOR="1")
        self.assertIn("left", text)
        self.assertNotIn("\x1b[36m", text)

    def test_a_dumb_terminal_gets_no_bar(self):
        text = on_a_terminal("run", "--events", "300000", TERM="dumb")
        self.assertNotIn("\x1b[K", text)

    def test_quiet_prints_no_progress(self):
        self.assertEqual(on_a_terminal("run", "--events", "300000", "--quiet"), "")


class LogFile(unittest.TestCase):
    @slow("it waits for ten seconds")
    def test_gets_an_occasional_line(self):
        process = subprocess.Popen(
            [SWIRL, *LONG], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True
        )
        line = process.stderr.readline()  # after ten seconds
        process.terminate()
        process.communicate(timeout=HANG)
        self.assertRegex(line, r"^48 discs: \d+ %, [\d.]+ (thousand|million) events/s, .* left\n$")


if __name__ == "__main__":
    main()
