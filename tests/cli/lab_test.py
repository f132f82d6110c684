"""The browser page: the WebAssembly engine reproduces the command line exactly, and the page works
in a real browser."""

import collections
import csv
import gzip
import json
import math
import os
import re
import shlex
import shutil
import signal
import socket
import statistics
import struct
import subprocess
import tempfile
import zlib

from program import (
    ALL,
    HANG,
    SOURCE,
    ProgramTest,
    all_scenes,
    help_of,
    made_of_the_web,
    main,
    option_of,
    options,
    read_bytes,
    read_json,
    read_rows,
    read_text,
    slow,
    swirl,
    text_of,
    write_text,
)

LAB = os.path.join(SOURCE, "web", "lab.sh")
HERE = os.path.dirname(os.path.abspath(__file__))
CHROMIUM = shutil.which("chromium")
# The scripts in a browser take a minute each, so the default suite omits what they list.
COMPLETE = ["--all"] if ALL else []

# The tests give the warm-up themselves, and numbers of JavaScript are exact up to 2^53.
SCENES = [
    scene for scene in all_scenes() if "warmup" not in scene and scene.get("seed", 0) < 2**53
]
EVENTS = 20000
# Keys of a result that the page omits: the program's build, its command line and its duration.
ONLY_COMMAND_LINE = {
    "seconds",
    "events_per_second",
    "simd",
    "version",
    "build",
    "command",
    "config_text",
}

NODE = """
const engineOf = async (path) => {
    const text = [], module = await WebAssembly.compile(require("fs").readFileSync(path));
    const noSystem = new Proxy({}, {get: (_, name) => () => { text.push(name); return 52; }});
    return () => {
        let out;
        const read = (at, size) => Buffer.from(out.memory.buffer, at, size).toString();
        const reject = (at, size) => {
            const message = JSON.parse(read(at, size));
            throw Object.assign(new Error(message.text), {said: message});
        };
        out = new WebAssembly.Instance(module,
            {wasi_snapshot_preview1: noSystem, page: {reject}}).exports;
        out._initialize();
        const write = (given) => {
            const lines = Buffer.from(Object.entries(given).map((e) => e.join("=") + "\\n").join(""));
            const at = out.buffer_for(lines.length);
            Buffer.from(out.memory.buffer, at, lines.length).set(lines);
        };
        const begin = (given) => { write(given); out.begin(); };
        return {out, write, begin, asked: text, answer: (size) => read(out.text(), size)};
    };
};
// Answers each line, the calls of an engine each, with one line.
engineOf(process.argv[1]).then(async (make) => {
    for await (const line of require("readline").createInterface({input: process.stdin})) {
        const said = [];
        for (const {given, events, steps} of JSON.parse(line)) {
            const engine = make(), answers = [];
            try {
                engine.begin(given);
                engine.out.run_events(events);
                for (const [name, ...values] of steps ?? []) {
                    if (["change", "keeps_discs"].includes(name)) engine.write(values.pop());
                    answers.push(engine.out[name](...values));
                }
                const problem = JSON.parse(engine.answer(engine.out.problem(1)) || "null");
                const seen = answers.length ? engine.out.frame(steps.at(-1)[1]) : 0;
                const frame = new Float64Array(engine.out.memory.buffer, seen,
                                               seen ? engine.out.frame_size() : 0);
                said.push({
                    answers, frame: answers.length ? [...frame] : [],
                    hash: BigInt.asUintN(64, engine.out.state_hash()).toString(16).padStart(16, "0"),
                    rotation: JSON.parse(engine.answer(engine.out.rotation())),
                    result: JSON.parse(engine.answer(engine.out.result())),
                    turns: [...new Float64Array(engine.out.memory.buffer, engine.out.turns(), 2)],
                    cause: [...new Float64Array(engine.out.memory.buffer, engine.out.cause(), 10)],
                    contacts: engine.out.contacts() / 4,
                    problem: problem ? problem.text : "", message: problem,
                    command: engine.answer(engine.out.command()),
                    asked: engine.asked});
            } catch (error) {
                said.push({rejected: error.message, message: error.said});
            }
        }
        const table = make();
        console.log(JSON.stringify({said, parameters: JSON.parse(table.answer(table.out.parameters()))}));
    }
});
"""


def pixels_of(path):
    """The rows of a PNG of eight bits a channel that is not interlaced, each a list of pixels.
    Raises an error if the file or a checksum is not valid."""
    data = read_bytes(path)
    chunks, at = {}, 8
    while at < len(data):
        size, name = struct.unpack(">I4s", data[at : at + 8])
        body = data[at + 8 : at + 8 + size]
        assert (
            zlib.crc32(name + body) == struct.unpack(">I", data[at + 8 + size : at + 12 + size])[0]
        )
        chunks[name] = chunks.get(name, b"") + body
        at += 12 + size
    width, height, depth, kind, _, _, interlaced = struct.unpack(">IIBBBBB", chunks[b"IHDR"])
    assert b"IEND" in chunks and (depth, interlaced) == (8, 0) and kind in (2, 6)
    step = 3 if kind == 2 else 4
    stream, before, rows = zlib.decompress(chunks[b"IDAT"]), bytes(step * width), []
    assert len(stream) == height * (1 + step * width)
    for y in range(height):
        way, *row = stream[y * (1 + step * width) : (y + 1) * (1 + step * width)]
        for k, above in enumerate(before):
            left, corner = (row[k - step], before[k - step]) if k >= step else (0, 0)
            if way == 4:  # Paeth: the one nearest to left + above − corner
                nearest = min((left, above, corner), key=lambda x: abs(left + above - corner - x))
            else:
                nearest = (0, left, above, (left + above) // 2)[way]
            row[k] = (row[k] + nearest) % 256
        before = row
        rows.append(list(zip(*(row[c::step] for c in range(3)))))
    return rows


class Laboratory(ProgramTest):
    @classmethod
    def setUpClass(cls):
        cls.page = made_of_the_web(cls, LAB, "laboratory.html")
        cls.pages = made_of_the_web(cls, LAB, "pages/")
        cls.node = subprocess.Popen(
            ["node", "-e", NODE, os.path.join(SOURCE, "build/wasm/swirl.wasm")],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        cls.addClassCleanup(cls.node.communicate)

    def engine(self, calls):
        self.node.stdin.write(json.dumps(calls) + "\n")
        self.node.stdin.flush()
        return json.loads(self.node.stdout.readline())

    def test_all_scenes_match_the_command_line_exactly(self):
        said = self.engine(
            [
                {
                    "given": {
                        **{k: text_of(v) for k, v in scene.items()},
                        "warmup": "0",
                        "measure": "slip",
                    },
                    "events": EVENTS,
                }
                for scene in SCENES
            ]
        )
        for scene, there in zip(SCENES, said["said"]):
            with self.subTest(scene):
                self.assertNotIn("rejected", there)
                self.assertEqual(there["asked"], [])
                here = json.loads(
                    swirl(
                        "run",
                        *options(scene),
                        "--warmup",
                        "0",
                        "--events",
                        str(EVENTS),
                        "--measure",
                        "slip",
                        "--json",
                        "-",
                        "--quiet",
                    ).stdout
                )
                self.assertEqual(there["hash"], here["state_hash"])
                self.assert_same_result(there["result"], here)

    def test_with_the_swirl_has_one_color_in_every_medium(self):
        # 8 discs turn with the swirl and 48 against it.
        table = read_json(os.path.join(SOURCE, "web", "src", "drawing", "look.json"))["light"]
        folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, folder)
        seen = {name: tuple(bytes.fromhex(table[name][1:])) for name in ("with", "against")}
        for discs, direction in ((8, "with"), (48, "against")):
            scene = ["--discs", discs, "--theme", "light", "--size", "640x540", "--quiet"]
            drawn = os.path.join(folder, f"{discs}.png")
            frames = os.path.join(folder, f"frames of {discs}")
            swirl("image", *scene, "--out", drawn)
            swirl("movie", *scene, "--seconds", "4", "--fps", "1", "--frame-files", frames)
            last = os.path.join(frames, sorted(os.listdir(frames))[-1])
            for path in (drawn, last):
                count = collections.Counter(p for row in pixels_of(path) for p in row)
                for name, color in seen.items():
                    there = count[color] > 100
                    self.assertEqual(there, name == direction, f"{name} in {path}")
        # The page, the figures and Python plots; units.mjs tests the page's arc.
        page = read_text(self.page)
        for name, color in seen.items():
            text = table[name]
            self.assertIn(f"--{name}:{text}", page)
            for copy in ("paper/look.py", "bindings/python/swirl/_look.py"):
                self.assertIn(f'{name.upper()} = "{text}"', read_text(os.path.join(SOURCE, copy)))
        movies = read_text(os.path.join(SOURCE, "docs", "how-to", "movies.md"))
        self.assertIn("Orange means\nwith the swirl", movies)
        self.assertGreater(seen["with"][0], seen["with"][2] + 100)

    def test_the_offered_command_reproduces_the_state(self):
        scenes = [
            {**scene, "events": events}
            for scene, events in (
                ({"discs": 12, "seed": 2}, 60000),
                ({"discs": 48, "warmup": "auto"}, 2000),
                ({"seed": 7, "path": "circle", "discs": 28, "warmup": 3}, 30000),
                ({"discs": 40, "mixture": "20:0.6"}, 5000),
                ({"discs": 20, "preset": "experiment"}, 5000),
            )
        ]
        said = self.engine(
            [
                {
                    "given": {k: str(v) for k, v in scene.items() if k != "events"},
                    "events": scene["events"],
                }
                for scene in scenes
            ]
        )["said"]
        warmups = 0
        for scene, there in zip(scenes, said):
            with self.subTest(scene):
                program, *words = shlex.split(there["command"])
                self.assertEqual(program, "./swirl")
                here = json.loads(swirl(*words, "--json", "-", "--quiet").stdout)
                # If a run ends within the page's warm-up, the command line has a shorter warm-up.
                has_warmup = bool(re.search(r"--warmup \d", there["command"]))
                warmups += has_warmup
                for key in ["state_hash"] + ["rotation", "warmup"] * has_warmup:
                    self.assertEqual(there["result"][key], here[key], key)
        self.assertEqual(warmups, 2)

    def assert_same_result(self, there, here):
        """All keys that the page has, in the same order."""
        self.assertEqual(list(there), [key for key in here if key not in ONLY_COMMAND_LINE])
        for key, value in there.items():
            self.assertEqual(value, here[key], key)
            if isinstance(value, dict):
                self.assertEqual(list(value), list(here[key]), key)

    def test_warnings_and_verdicts_match_the_command_line(self):
        warnings, verdicts = set(), set()
        for scene, events in (
            ({"discs": 8, "mu": 0}, 5000),
            ({"discs": 5, "seed": 2}, 60000),
            ({"discs": 8, "mu": 0, "path": "circle"}, 5000),
            ({"discs": 48}, 3000),
            ({"discs": 3, "mu": 0.01}, 20000),
            ({"discs": 12, "amplitude": 0}, 1),
        ):
            with self.subTest(scene):
                given = {**{k: str(v) for k, v in scene.items()}, "warmup": "0", "measure": "slip"}
                there = self.engine([{"given": given, "events": events}])["said"][0]["result"]
                here = json.loads(
                    swirl(
                        "run",
                        *options({**scene, "warmup": 0}),
                        "--measure",
                        "slip",
                        "--events",
                        str(events),
                        "--json",
                        "-",
                        "--quiet",
                    ).stdout
                )
                self.assert_same_result(there, here)
                warnings |= {warning.split()[0] for warning in there["warnings"]}
                verdicts.add(there["steady_state"]["verdict"])
        self.assertGreaterEqual(warnings, {"without", "the", "not"})
        self.assertEqual(verdicts, {"steady", "drifting", "too short to tell"})

    def test_averages_with_the_default_warmup_match_the_offered_command(self):
        for scene in ({"discs": 12, "seed": 2}, {"discs": 5, "path": "circle", "warmup": "auto"}):
            with self.subTest(scene):
                given = {key: str(value) for key, value in scene.items()}
                there = self.engine([{"given": given, "events": 60000}])["said"][0]["result"]
                here = json.loads(
                    swirl(
                        "run",
                        *options({**scene, "warmup": 20}),
                        "--events",
                        "60000",
                        "--json",
                        "-",
                        "--quiet",
                    ).stdout
                )
                self.assertEqual(there["warmup"]["periods"], 20)
                for key in ("state_hash", "periods", "warmup", "rotation"):
                    self.assertEqual(there[key], here[key], key)

    def test_a_long_run_reports_the_periods_per_block(self):
        period = 11.866071
        for warmup, periods, blocks in (
            ("0", 2040, [0, [1, 1], 2040]),
            ("0", 2060, [0, [1, 2], 1030]),
            ("2050", 2070, [1025, [2, 1], 1045]),
        ):
            with self.subTest(warmup=warmup, periods=periods):
                given = {"discs": "1", "measure": "", "warmup": warmup}
                steps = [["advance_to", (periods + 0.5) * period, 10**9]]
                said = self.engine([{"given": given, "events": 0, "steps": steps}])["said"][0]
                rotation = said["rotation"]
                self.assertEqual(
                    [
                        rotation["warmup_blocks"],
                        rotation["periods_per_block"],
                        len(rotation["blocks"]),
                    ],
                    blocks,
                )

    def test_a_problem_has_the_event_and_the_message_of_the_command_line(self):
        collapsing = {"discs": 48, "restitution": 0.5, "contact_duration": 0}
        # On the way, at the end of the request, not yet; then rounding errors.
        problems = []
        for scene, events in (
            (collapsing, 300000),
            (collapsing, 100000),
            (collapsing, 2000),
            ({"discs": 5, "radius": 1e-6, "container_radius": 0.001, "amplitude": 100000}, 3000),
        ):
            with self.subTest(scene, events=events):
                given = {key: str(value) for key, value in scene.items()}
                there = self.engine([{"given": given, "events": events}])["said"][0]
                here = swirl(
                    "run", *options(scene), "--events", str(events), "--quiet", check=False
                )
                self.assertEqual(here.returncode, 1 if there["problem"] else 0, here.stderr)
                self.assertIn(there["problem"], here.stderr)
                problems.append(there["problem"][:9])
        self.assertEqual(problems, ["the last ", "the last ", "", "after 0.0"])

    def discs(self, given, steps):
        """x, y, angle, spin and velocity of each disc after the last step, an advance_to."""
        said = self.engine(
            [{"given": {"discs": "5", "seed": "3", **given}, "events": 0, "steps": steps}]
        )["said"][0]
        self.assertNotIn("rejected", said)
        frame, discs = said["frame"][11:], []
        for begin in range(0, len(frame), 8):
            discs.append(frame[begin : begin + 6])
        return discs, said["answers"]

    def test_orientations_of_spheres_match_a_recording(self):
        given = {"preset": "experiment", "discs": "12", "seed": "4"}
        folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, folder)
        recorded = os.path.join(folder, "frames.h5")
        swirl(
            "run",
            *options(given),
            "--periods",
            "2",
            "--warmup",
            "0",
            "--frames-per-period",
            "7",
            "--trajectory",
            recorded,
            "--json",
            recorded + ".json",
            "--quiet",
        )
        units = read_json(recorded + ".json")["units"]
        swirl("export", recorded, "--format", "table", "--out", recorded + ".csv", "--quiet")
        rows = read_rows(recorded + ".csv")
        frames = [rows[k : k + 12] for k in range(0, len(rows), 12)]
        largest = 0.0
        for frame in frames[1:10:4]:
            time = float(frame[0]["time (r/v)"]) * units["r"] / units["v"]
            seen = self.engine(
                [{"given": given, "events": 0, "steps": [["advance_to", time, 10**6]]}]
            )["said"][0]["frame"]
            self.assertEqual(len(seen), 11 + 12 * (8 + 4))
            for i, sphere in enumerate(frame):
                there = seen[11 + 12 * 8 + 4 * i :][:4]
                here = [float(sphere[f"turned {axis}"]) for axis in "wxyz"]
                # The time of a frame is rounded to the page's clock: 1e-15 relative to about 20.
                for a, b in zip(there, here, strict=True):
                    self.assertAlmostEqual(a, b, delta=1e-12)
                largest = max(largest, 1 - abs(here[0]))
        self.assertGreater(largest, 0.5)  # the spheres really rotate

    def assert_same_discs(self, these, those):
        # Positions are shifted into the other simulation and rounded. Each of a few collisions
        # increases that error tenfold.
        for one, other in zip(these, those, strict=True):
            for a, b in zip(one, other, strict=True):
                self.assertAlmostEqual(a, b, delta=1e-9)

    def test_moving_by_hand_along_the_polygon_matches_the_path(self):
        period, amplitude, sides = 11.866071, 1.892, 30
        vertices = [
            [amplitude * f(2 * math.pi * k / sides) for f in (math.cos, math.sin)] for k in range(4)
        ]
        segment = period / sides
        swirled, _ = self.discs({}, [["advance_to", 3 * segment * (1 - 1e-12), 10**6]])
        steps = []
        for k in range(3):
            now = 0 if k == 0 else segment
            steps += [
                ["steer", now, *vertices[k + 1], segment],
                ["advance_to", segment * (1 - 1e-12), 10**6],
            ]
        by_hand, answers = self.discs({}, steps)
        self.assertEqual(answers[1::2], [1, 1, 1])
        self.assert_same_discs(by_hand, swirled)

    def test_a_change_keeps_the_discs_or_needs_a_new_simulation(self):
        period = 11.866071
        same, _ = self.discs({}, [["advance_to", 1.1 * period, 10**6]])
        given = {"discs": "5", "seed": "3"}
        change = lambda **more: ["change", period, {**given, **more}]  # noqa: E731
        steps = [["advance_to", period, 10**6], change(), ["advance_to", 0.1 * period, 10**6]]
        self.assertEqual(
            self.discs(
                {}, [["keeps_discs", {"discs": "5", "seed": "3", "mu": "0"}], ["advance_to", 0, 10]]
            )[1][0],
            1,
        )
        kept, answers = self.discs({}, steps)
        self.assertEqual(answers, [1, 1, 1])
        # In the lab frame the container does not move.
        self.assert_same_discs(kept, same)
        steps[1] = change(mu="0")
        other, answers = self.discs({}, steps)
        self.assertEqual(answers, [1, 1, 1])
        self.assertNotEqual(other, kept)
        for more in (
            {"radius": "0.5"},
            {"container_radius": "10"},
            {"seed": "4"},
            {"discs": "6", "mixture": "2:0.5"},
        ):
            self.assertEqual(
                self.discs(
                    {},
                    [["keeps_discs", {"discs": "5", "seed": "3", **more}], ["advance_to", 0, 10]],
                )[1][0],
                0,
            )
            steps[1] = change(**more)
            self.assertEqual(self.discs({}, steps[:2] + [["advance_to", period, 10**6]])[1][1], 0)

    def test_contacts_change_at_once_and_the_path_at_a_period(self):
        period = 11.866071
        given = {"discs": "5", "seed": "3"}
        for more, when in (
            ({"mu": "0.5"}, 1),
            ({"discs": "7"}, 1),
            ({"amplitude": "1"}, 2),
            ({"path": "circle"}, 2),
        ):
            answers = self.discs({}, [["keeps_discs", {**given, **more}], ["advance_to", 0, 10]])[1]
            self.assertEqual(answers[0], when, more)
        # A change to the same values in the middle of a period does not alter the motion.
        same, _ = self.discs({}, [["advance_to", 0.5 * period, 10**6]])
        kept, answers = self.discs(
            {},
            [
                ["advance_to", 0.4 * period, 10**6],
                ["change", 0.4 * period, given],
                ["advance_to", 0.1 * period, 10**6],
            ],
        )
        self.assertEqual(answers, [1, 1, 1])
        # The frames are those of the container's centre, which is where it was.
        self.assert_same_discs(kept, same)

    def test_discs_are_added_where_there_is_room_and_the_last_are_removed(self):
        given = {"discs": "5", "seed": "3"}
        time = 3.0
        before, _ = self.discs({}, [["advance_to", time, 10**6]])
        steps = lambda n: [
            ["advance_to", time, 10**6],
            ["change", time, {**given, "discs": str(n)}],  # noqa: E731
            ["advance_to", 0, 10**6],
        ]
        more, answers = self.discs({}, steps(12))
        self.assertEqual((answers[1], len(more)), (1, 12))
        self.assert_same_discs(more[:5], before)
        for i, a in enumerate(more):
            for b in more[:i]:
                self.assertGreaterEqual(math.dist(a[:2], b[:2]), 2)
        fewer, answers = self.discs({}, steps(2))
        self.assertEqual(answers[1], 1)
        self.assert_same_discs(fewer, before[:2])
        # The answer is 1 plus the number of discs for which there was no room.
        full, answers = self.discs({}, steps(59))
        self.assertEqual(answers[1], 1 + 59 - len(full))
        self.assertLess(len(full), 59)

    def test_the_cause_has_the_values_of_the_command_line(self):
        for discs in (12, 48):
            with self.subTest(discs=discs):
                there = self.engine(
                    [
                        {
                            "given": {"discs": str(discs), "measure": ""},
                            "events": 0,
                            "steps": [["advance_to", 220 * 11.866071, 10**9]],
                        }
                    ]
                )["said"][0]
                here = json.loads(
                    swirl(
                        "run",
                        "--discs",
                        str(discs),
                        "--periods",
                        "220",
                        "--warmup",
                        "20",
                        "--measure",
                        "slip,frustration",
                        "--json",
                        "-",
                        "--quiet",
                    ).stdout
                )["measured"]
                rows = [
                    here["slip"]["cluster"],
                    here["slip"]["cluster_perimeter"],
                    *(
                        here["frustration"][name]
                        for name in ("spin_correlation", "disc_sticking", "wall_sticking")
                    ),
                ]
                for k, row in enumerate(rows):
                    # Both have eight samples per period, but at other phases; every collision
                    # counts for both.
                    limit = 4 * row["error"] if k < 3 else 1e-3
                    self.assertAlmostEqual(
                        there["cause"][2 * k], row["mean"], delta=limit, msg=str(row)
                    )
                    self.assertLess(
                        abs(math.log(there["cause"][2 * k + 1] / row["error"])),
                        math.log(3),
                        str(row),
                    )
                self.assertGreater(there["contacts"], 100)
                self.assertLessEqual(there["contacts"], 4096)

    def test_turns_are_the_rotation_rate_times_the_periods(self):
        period = 11.866071
        for warmup, periods in (("0", 6), ("3", 6)):
            given = {"discs": "28", "seed": "2", "warmup": warmup, "measure": ""}
            said = self.engine(
                [
                    {
                        "given": given,
                        "events": 0,
                        "steps": [["advance_to", periods * period * (1 + 1e-12), 10**9]],
                    }
                ]
            )["said"][0]
            averaged = periods - int(warmup)
            for turns, rate in zip(said["turns"], ("mean_by_time", "rigid_by_time")):
                # The first sample of the next period is taken with the event at its beginning, so a
                # sample of 1/64 period may be counted on one side only; a rate is below 2 Ω.
                self.assertAlmostEqual(
                    turns, averaged * said["rotation"][rate]["mean"], delta=2 / 64, msg=rate
                )

    def test_a_dragged_disc_stops_at_obstacles(self):
        now = 4.0
        before, _ = self.discs({}, [["advance_to", now, 10**6]])
        dish = self.container_centre(now)
        free = next(
            [x, y]
            for x, y in (
                (dish[0] + 6.0 * math.cos(k), dish[1] + 6.0 * math.sin(k)) for k in range(7)
            )
            if all(math.dist(disc[:2], (x, y)) > 2.01 for disc in before[1:])
        )
        moved, _ = self.discs(
            {}, [["advance_to", now, 10**6], ["drag", now, 0, *free], ["advance_to", 0, 10**6]]
        )
        self.assert_same_discs(
            [moved[0][:2], *[disc[:2] for disc in moved[1:]]],
            [free, *[disc[:2] for disc in before[1:]]],
        )
        # Into another disc, and out of the container: it stops at the contact.
        for target, touches in (
            (before[1][:2], lambda disc: math.dist(disc[:2], before[1][:2]) - 2),
            ([40.0, 0.0], lambda disc: 7.6 - math.dist(disc[:2], dish)),
        ):
            moved, _ = self.discs(
                {},
                [
                    ["advance_to", now, 10**6],
                    ["drag", now, 0, *target],
                    ["advance_to", 0, 10**6],
                ],
            )
            others = min(math.dist(moved[0][:2], disc[:2]) for disc in moved[1:])
            self.assertGreaterEqual(others, 2)
            self.assertLess(min(touches(moved[0]), others - 2), 1e-6)

    def container_centre(self, now):
        said = self.engine(
            [
                {
                    "given": {"discs": "5", "seed": "3"},
                    "events": 0,
                    "steps": [["advance_to", now, 10**6]],
                }
            ]
        )["said"][0]
        return said["frame"][3:5]

    def test_the_page_knows_every_parameter_of_the_command_line(self):
        help_text = help_of("run")
        for row in self.engine([])["parameters"]:
            if row["settable"]:
                self.assertIn(option_of(row["name"]) + " ", help_text)

    def test_an_invalid_parameter_has_the_message_of_the_command_line(self):
        for wrong in ({"discs": "100"}, {"mu": "nan"}, {"disks": "5"}, {"path": "square"}):
            with self.subTest(wrong):
                there = self.engine([{"given": wrong, "events": 1}])["said"][0]
                here = self.assert_fails(2, "run", *options(wrong), check=False)
                if "disks" in wrong:  # the command line calls it an option
                    self.assertEqual(
                        there["rejected"],
                        "there is no parameter 'disks'.\nhint: did you mean 'discs'?",
                    )
                    continue
                self.assertIn(there["rejected"], here.stderr)
                self.assertRegex(there["rejected"], r"(?s)^(--)?\w.*\.$")

    def test_the_page_in_a_browser(self):
        if not CHROMIUM:
            self.skipTest("this test needs chromium")
        dish = ["--discs", "28", "--mu", "0.5", "--seed", "3"]
        run = json.loads(swirl("run", *dish, "--events", "20000", "--json", "-", "--quiet").stdout)
        folder = os.path.dirname(self.page)
        picture = os.path.join(folder, "dish.svg")
        swirl(
            "image",
            *dish,
            "--start",
            repr(run["periods"]),
            "--no-annotations",
            "--out",
            picture,
            "--quiet",
        )
        self.assert_script_passes(
            "page.mjs", self.page, CHROMIUM, run["state_hash"], picture, folder, *COMPLETE
        )
        self.assertEqual(read_json(os.path.join(folder, "result.json"))["config"]["discs"], 28)
        self.assert_shows_discs(os.path.join(folder, "swirl.png"), 28)
        if shutil.which("ffprobe"):
            asked = subprocess.run(
                [
                    "ffprobe",
                    "-v",
                    "error",
                    "-count_frames",
                    "-show_entries",
                    "stream=nb_read_frames",
                    "-of",
                    "csv=p=0",
                    os.path.join(folder, "swirl.webm"),
                ],
                check=True,
                capture_output=True,
                text=True,
            )
            self.assertGreater(int(asked.stdout), 5)

    def test_the_page_in_firefox(self):
        firefox = shutil.which("firefox-esr") or shutil.which("firefox")
        if not firefox:
            self.skipTest("this test needs firefox")
        # Debian 12 has Node.js 18.
        if subprocess.run(
            ["node", "--experimental-websocket", "-e", ""], capture_output=True
        ).returncode:
            self.skipTest("this test needs a Node.js with WebSocket, version 20.10 or later")
        run = json.loads(
            swirl(
                "run",
                "--discs",
                "28",
                "--mu",
                "0.5",
                "--seed",
                "3",
                "--events",
                "20000",
                "--json",
                "-",
                "--quiet",
            ).stdout
        )
        done = subprocess.run(
            [
                "node",
                "--experimental-websocket",
                os.path.join(SOURCE, "web", "test", "firefox.mjs"),
                self.pages,
                firefox,
                run["state_hash"],
                *COMPLETE,
            ],
            capture_output=True,
            text=True,
            timeout=HANG,
        )
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def assert_script_passes(self, script, *arguments):
        """A script of web/test ends without a failed assertion."""
        done = subprocess.run(
            ["node", os.path.join(SOURCE, "web", "test", script), *arguments],
            capture_output=True,
            text=True,
            timeout=HANG,
        )
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def assert_shows_discs(self, path, discs):
        """The image has a light background and colours from blue to grey to orange, which cover the
        area of the discs within a fifth. (Rims and orientation marks are dark.)"""
        rows = pixels_of(path)
        self.assertEqual({len(row) for row in rows}, {len(rows) - 22})
        paper, floor, ink = (0xFB, 0xF9, 0xF6), (0xFF, 0xFF, 0xFF), (0x1D, 0x23, 0x28)
        address = {pixel for row in rows[-22:] for pixel in row}  # below the image
        self.assertGreater(len(address), 3)
        rows = rows[:-22]
        arcs = (0xCC, 0x5C, 0x0A), (0x24, 0x63, 0x9E)  # of the turns, outside the wall
        for corner in (rows[0][0], rows[0][-1], rows[-1][0], rows[-1][-1]):
            self.assertEqual(corner, paper)
        colors = collections.Counter(pixel for row in rows for pixel in row)
        self.assertGreater(colors[ink], len(rows))
        much = 1e-4 * len(rows) ** 2
        shown = [
            color
            for color, n in colors.items()
            if n > much and color not in (paper, floor, ink, *arcs)
        ]
        self.assertGreater(len(shown), 5)
        self.assertGreater(max(r - b for r, _, b in shown), 20)
        self.assertGreater(max(b - r for r, _, b in shown), 20)
        covered = sum(colors[color] for color in shown) / len(rows) ** 2
        radius = (len(rows) / 2 - 20) / (8.6 + 1.892)  # in pixels; the image has a border of 20
        expected = discs * math.pi * (radius / len(rows)) ** 2
        self.assertLess(abs(covered / expected - 1), 0.2)

    def test_the_first_page_in_a_browser(self):
        if not CHROMIUM:
            self.skipTest("this test needs chromium")
        self.assert_script_passes("first.mjs", self.pages, CHROMIUM, *COMPLETE)

    def test_the_layout_on_phones_and_laptops(self):
        if not CHROMIUM:
            self.skipTest("this test needs chromium")
        self.assert_script_passes("sizes.mjs", self.page, CHROMIUM, *COMPLETE)

    def test_the_units_of_the_page(self):
        done = subprocess.run(
            ["node", os.path.join(SOURCE, "web", "test", "units.mjs")],
            capture_output=True,
            text=True,
        )
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_the_sources_of_the_page_are_formatted(self):
        done = subprocess.run(
            ["npm", "run", "--silent", "format"],
            capture_output=True,
            text=True,
            cwd=os.path.join(SOURCE, "web"),
        )
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def files(self):
        """A folder with a result."""
        folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, folder)
        at = lambda name: os.path.join(folder, name)  # noqa: E731
        swirl(
            "run",
            "--discs",
            "12",
            "--mu",
            "0.3",
            "--periods",
            "8",
            "--warmup",
            "2",
            "--json",
            at("run.json"),
            "--quiet",
        )
        write_text(at("parameters.json"), json.dumps(self.engine([])["parameters"]))
        write_text(at("messages.json"), json.dumps(self.messages()))
        return folder

    def messages(self):
        """Error messages of the engine that need several values, with the codes of their sentences;
        panels.mjs tries each parameter alone."""
        said = self.engine(
            [
                {"given": wrong, "events": 1}
                for wrong in (
                    {"discs": "60"},
                    {"discs": "1000"},
                    {"discs": "40", "mixture": "39:2"},
                    {"radius": "9", "discs": "1"},
                    {"path": "circle", "sides": "5"},
                    {"path": "circle", "floor": "sliding"},
                    {"speed": "2", "amplitude": "1", "period": "5"},
                    {
                        "body": "sphere",
                        "floor": "sliding",
                        "rolling_resistance": "1",
                        "floor_friction": "0.1",
                    },
                )
            ]
        )["said"]
        collapsed = self.engine(
            [
                {"given": given, "events": 300000}
                for given in (
                    {"discs": "48", "restitution": "0.5", "contact_duration": "0"},
                    {"discs": "58"},
                )
            ]
        )["said"]
        return [one["message"] for one in said + collapsed]

    def test_the_units_of_discovery_explorer_lesson_and_files(self):
        folder = self.files()
        done = subprocess.run(
            [
                "node",
                os.path.join(SOURCE, "web", "test", "panels.mjs"),
                os.path.join(folder, "parameters.json"),
                os.path.join(SOURCE, "build/wasm/swirl.wasm"),
                folder,
            ],
            capture_output=True,
            text=True,
        )
        self.assertEqual(done.returncode, 0, done.stderr)

    @slow(
        "discovery, explorer and lesson make hundreds of runs; their units are tested without a "
        "browser"
    )
    def test_discovery_explorer_lesson_and_files_in_a_browser(self):
        if not CHROMIUM:
            self.skipTest("this test needs chromium")
        folder = os.path.dirname(self.page)
        self.assert_script_passes("panels_page.mjs", self.page, CHROMIUM, self.files(), folder)
        # A point of the explorer is the mean of runs, and its row has their command lines.
        with open(os.path.join(folder, "rotation_explored.csv"), encoding="utf-8") as opened:
            rows = [row for row in csv.DictReader(opened) if row["discs"] == "8"]
        self.assertEqual(len(rows), 3)
        for row in rows:
            runs = []
            for command in row["command"].split(" && "):
                program, *words = shlex.split(command)
                self.assertEqual(program, "./swirl")
                runs.append(json.loads(swirl(*words, "--json", "-", "--quiet").stdout)["rotation"])
            self.assertEqual([len(runs), row["runs"], row["collapsed"]], [4, "4", "0"])
            for rate in ("mean_by_time", "mean_by_event", "rigid_by_time", "rigid_by_event"):
                means = [run[rate]["mean"] for run in runs]
                # The page adds in the same order; only the last digit of a sum may differ.
                self.assertAlmostEqual(
                    float(row[f"varpi_{rate}"]), statistics.mean(means), delta=1e-14, msg=rate
                )
                error = (
                    3.182 / 1.96 * statistics.stdev(means) / 2
                )  # Student's t, which the page has within 1 %
                self.assertAlmostEqual(
                    float(row[f"varpi_{rate}_error"]), error, delta=0.01 * error, msg=rate
                )

    def test_maps_are_measured_only_while_they_are_shown(self):
        done = subprocess.run(
            [
                "node",
                "-e",
                NODE.split("// Answers each line")[0]
                + """
            engineOf(process.argv[1]).then((make) => {
                const said = {}, period = 11.866071;
                for (const [name, from, to] of [["never", 99, 99], ["always", 0, 99], ["late", 22.5, 99], ["ended", 0, 25]]) {
                    const engine = make();
                    engine.begin({discs: "12"});
                    const until = (periods) => { while (!engine.out.advance_to(periods * period, 1000)); };
                    for (const [periods, shown] of [[from, 1], [to, 0]]) if (periods < 40) {
                        until(periods);
                        engine.out.show_maps(shown);
                    }
                    until(40);
                    engine.out.report();
                    const write = new TextEncoder().encode("density//by_time"), at = engine.out.buffer_for(write.length);
                    new Uint8Array(engine.out.memory.buffer, at, write.length).set(write);
                    const size = engine.out.column();
                    const values = [...new Float64Array(engine.out.memory.buffer, engine.out.values(), size)];
                    said[name] = [engine.out.state_hash().toString(), values.map((each) => (Number.isFinite(each) ? each : 0))];
                }
                console.log(JSON.stringify(said));
            });""",
                os.path.join(SOURCE, "build/wasm/swirl.wasm"),
            ],
            check=True,
            capture_output=True,
            text=True,
        )
        said = json.loads(done.stdout)
        self.assertEqual(
            len({state for state, _ in said.values()}), 1
        )  # the trajectory is the same
        never, always, late, ended = (
            said[name][1] for name in ("never", "always", "late", "ended")
        )
        self.assertEqual(never, [])
        # Each is the mean over its periods after the warm-up: 20 of them, 17 from period 23 on, and
        # the first five.
        for values in (always, late, ended):
            self.assertGreater(max(values), 0.1)
        self.assertNotEqual(always, late)
        self.assertNotEqual(always, ended)
        # A map over all periods is nearer to one over 17 of them than to one over five.
        distance = lambda other: math.dist(always, other)  # noqa: E731
        self.assertLess(distance(late), distance(ended))

    @slow("it makes 240 runs at each of two numbers of discs")
    def test_intervals_contain_the_true_rotation_rate(self):
        done = subprocess.run(
            [
                "node",
                os.path.join(SOURCE, "web", "test", "coverage.mjs"),
                os.path.join(SOURCE, "build/wasm/swirl.wasm"),
            ],
            capture_output=True,
            text=True,
        )
        print(done.stdout)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_the_crossing_of_runs_matches_the_command_line(self):
        search = json.loads(
            swirl(
                "crossing",
                "--mu",
                "0.5",
                "--from",
                "41",
                "--to",
                "47",
                "--step",
                "1",
                "--events",
                "20000",
                "--json",
                "-",
                "--quiet",
            ).stdout
        )
        runs = [
            number
            for point in search["points"]
            for number in (point["discs"], point["mean"], point["error"], 100, 0)
        ]
        done = subprocess.run(
            [
                "node",
                "-e",
                NODE.split("// Answers each line")[0]
                + """
            engineOf(process.argv[1]).then((make) => {
                const engine = make(), runs = JSON.parse(process.argv[2]), at = engine.out.runs(runs.length / 5);
                new Float64Array(engine.out.memory.buffer, at, runs.length).set(runs);
                console.log(engine.answer(engine.out.crossing()));
            });""",
                os.path.join(SOURCE, "build/wasm/swirl.wasm"),
                json.dumps(runs),
            ],
            check=True,
            capture_output=True,
            text=True,
        )
        there = json.loads(done.stdout)
        self.assertEqual(there["verdict"], "crosses")
        for key in ("", "_error", "_lower", "_upper"):
            self.assertEqual(there[key[1:] or "discs"], search["N_c" + key], key)
        self.assertEqual(there["undetermined"], search["undetermined"])
        change = search["sign_changes"][-1]
        self.assertEqual([there["before"], there["after"]], [change["from"], change["to"]])
        self.assertEqual(
            there["points"], [[p["discs"], p["mean"], p["error"]] for p in search["points"]]
        )

    def test_options_of_a_run_set_the_parameters_of_the_page(self):
        folder = os.path.dirname(self.page)
        written = os.path.join(folder, "with_parameters.html")
        done = subprocess.run(
            [
                LAB,
                "--discs",
                "40",
                "--mu_disc=0.3",
                "--mixture",
                "20:0.6",
                "--out",
                written,
                "--quiet",
            ],
            capture_output=True,
            text=True,
        )
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        with open(written, encoding="utf-8") as opened, open(self.page, encoding="utf-8") as plain:
            entry = (
                '<meta name="swirl-start" '
                'content="discs=40&amp;mu_disc=0.3&amp;mixture=20%3A0.6">\n'
            )
            text = opened.read()
            self.assertIn(entry, text)
            self.assertEqual(text.replace(entry, ""), plain.read())
        for wrong in (["--discs", "1000"], ["--mu", "x"], ["--motion", "square"]):
            done = subprocess.run([LAB, *wrong, "--out", written], capture_output=True, text=True)
            here = swirl("run", *wrong, check=False)
            self.assertEqual((done.returncode, here.returncode), (2, 2), wrong)
            self.assertEqual(done.stderr, here.stderr)

    def test_it_is_small(self):
        packed = gzip.compress(read_bytes(self.page), 9)
        # 18,000 of them are the font, 2,300 the units of quantities and the particles that cannot
        # spin, 400 the options whose name is not their key.
        self.assertLessEqual(len(packed), 344_000)
        first = gzip.compress(read_bytes(os.path.join(self.pages, "index.html")), 9)
        self.assertLessEqual(len(first), 260_000)

    @slow("it watches the page for ten seconds; test_the_page_in_a_browser requires motion too")
    def test_it_keeps_running(self):
        if not CHROMIUM:
            self.skipTest("this test needs chromium")
        done = subprocess.run(
            ["node", os.path.join(SOURCE, "web", "test", "frames.mjs"), self.page, CHROMIUM],
            capture_output=True,
            text=True,
            timeout=HANG,
        )
        print(done.stdout)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_it_makes_no_requests(self):
        for name in ("index.html", "laboratory.html"):
            text = read_text(os.path.join(self.pages, name))
            self.assertNotRegex(text, r"""(src|href)=["']?(https?:)?//""")

    def test_it_serves_the_page_and_reports_a_port_in_use(self):
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = str(free.getsockname()[1])
        with subprocess.Popen(
            [LAB, "--port", port, "--no-browser", "--discs", "40", "--mu", "0.3"],
            stdout=subprocess.PIPE,
            text=True,
        ) as lab:
            self.assertIn(f"http://localhost:{port}/?discs=40&mu=0.3 ", lab.stdout.readline())
            second = subprocess.run(
                [LAB, "--port", port, "--no-browser"], capture_output=True, text=True
            )
            self.assertEqual(second.returncode, 1)
            self.assertIn(f"port {port} is already in use", second.stderr)
            lab.send_signal(signal.SIGINT)
        self.assertEqual(lab.returncode, 130)

    def test_usage_errors(self):
        for wrong, said in (
            (["--port", "0"], "--port is '0'"),
            (["--port", "x"], "--port is 'x'"),
            (["--loud"], "'--loud'"),
            (["--out"], "--out needs a value"),
            (["--discs"], "--discs needs a value"),
            (["--periods", "5"], "'--periods'"),
            (["--seed", "1\n2"], "--seed contains a line break"),
        ):
            done = subprocess.run([LAB, *wrong], capture_output=True, text=True)
            self.assertEqual(done.returncode, 2, wrong)
            self.assertIn(said, done.stderr)
        done = subprocess.run([LAB, "--out", "/nowhere/lab.html"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 1)
        self.assertIn("cannot be written", done.stderr)


if __name__ == "__main__":
    main()
