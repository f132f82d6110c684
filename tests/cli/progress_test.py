"""Progress: a bar on a terminal, a line now and then elsewhere, nothing with --quiet."""

import os
import pty
import select
import subprocess
import time
import unittest

from program import SWIRL


def on_a_terminal(*arguments, seconds=20, **environment):
    """What the program writes to stderr if that is a terminal."""
    master, slave = pty.openpty()
    clean = {k: v for k, v in os.environ.items() if k != "NO_COLOR"}
    process = subprocess.Popen([SWIRL, *arguments], stdout=subprocess.DEVNULL, stderr=slave,
                               stdin=subprocess.DEVNULL,
                               env={**clean, "TERM": "xterm", **environment})
    os.close(slave)
    said = b""
    deadline = time.time() + seconds
    while time.time() < deadline:
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
        said += got
        if said.count(b"\r") > 6:
            process.terminate()
    process.wait(timeout=20)
    os.close(master)
    return said.decode()


LONG = ("run", "--events", "1e12", "--checkpoint-every", "0")


class Terminal(unittest.TestCase):
    def test_a_bar_with_rate_and_time_left_that_is_removed_in_the_end(self):
        said = on_a_terminal(*LONG)
        self.assertGreater(said.count("\r"), 3)
        self.assertRegex(said, r"48 discs .*\d %  [\d.]+ (thousand|million) events/s  .* left")
        self.assertIn("\x1b[36m", said)
        self.assertIn("\r\x1b[K", said[said.rindex("left"):])

    def test_no_color_when_it_is_not_wanted(self):
        said = on_a_terminal(*LONG, NO_COLOR="1")
        self.assertIn("left", said)
        self.assertNotIn("\x1b[36m", said)

    def test_no_bar_on_a_terminal_that_cannot_go_back(self):
        said = on_a_terminal("run", "--events", "300000", TERM="dumb")
        self.assertNotIn("\x1b[K", said)

    def test_quiet_is_quiet(self):
        self.assertEqual(on_a_terminal("run", "--events", "300000", "--quiet"), "")


class LogFile(unittest.TestCase):
    def test_gets_a_line_now_and_then(self):
        process = subprocess.Popen([SWIRL, *LONG], stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE, text=True)
        line = process.stderr.readline()  # after ten seconds
        process.terminate()
        process.communicate(timeout=20)
        self.assertRegex(line, r"^48 discs: \d+ %, [\d.]+ (thousand|million) events/s, .* left\n$")


if __name__ == "__main__":
    unittest.main()
