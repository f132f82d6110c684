"""What `swirl paper` prints: progress and errors, in the words of the program."""

import math
import os
import signal
import sys
import time

INTERRUPTED = 130  # exit code


class Problem(Exception):
    """An error with its exit code: 2 for a wrong call, 1 for a failure."""

    def __init__(self, text, code=1):
        super().__init__(text)
        self.code = code


def report(error):
    """Prints an error and returns the exit code."""
    print(f"error: {error}", file=sys.stderr)
    return getattr(error, "code", 1)


def stop_on_signals():
    """All signals that end a program raise KeyboardInterrupt, except those that the caller ignores
    (nohup)."""

    def stop(*_):
        raise KeyboardInterrupt

    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        if signal.getsignal(number) is not signal.SIG_IGN:
            signal.signal(number, stop)


def duration(seconds):
    """ "12 s", "3 min 20 s", "2 h 5 min"."""
    s = math.ceil(seconds)
    if s < 60:
        return f"{s} s"
    return f"{s // 60} min {s % 60} s" if s < 3600 else f"{s // 3600} h {s % 3600 // 60} min"


# A share below this says too little about the rest: the first runs are the longest.
LEAST_SHARE, LEAST_SECONDS, DAY = 0.02, 5.0, 86_400.0


def time_left(seconds, fraction):
    """ ", 3 min 20 s left", an estimate from the time so far; nothing while it would be a guess."""
    if fraction < LEAST_SHARE or seconds < LEAST_SECONDS:
        return ""
    left = seconds * (1 / fraction - 1)
    return ", more than a day left" if left > DAY else f", {duration(left)} left"


class Progress:
    """On a terminal a line that is drawn again, in a log file an occasional one."""

    def __init__(self, label, quiet):
        self.label, self.quiet, self.begin = label, quiet, time.monotonic()
        self.terminal = sys.stderr.isatty() and os.environ.get("TERM", "dumb") != "dumb"
        self.next = self.begin + (0 if self.terminal else 10)

    def __enter__(self):
        return self.show

    def __exit__(self, *_):
        if self.terminal and not self.quiet:
            print("\r\x1b[K", end="", file=sys.stderr, flush=True)

    def show(self, fraction, part=""):
        """`part` names what is being made."""
        now = time.monotonic()
        if self.quiet or now < self.next:
            return
        self.next = now + (0.1 if self.terminal else 30)
        text = (
            f"{self.label}{part and f', {part}'}: {100 * fraction:.0f} "
            f"%{time_left(now - self.begin, fraction)}"
        )
        print(
            f"\r{text}\x1b[K" if self.terminal else text,
            end="" if self.terminal else "\n",
            file=sys.stderr,
            flush=True,
        )
