"""A sweep on a real Slurm with three nodes, one of which fails during the sweep."""

import os
import subprocess

import private_slurm
import program
from program import SOURCE, InFolder, read_text, slow, swirl, wait_until, write_text

AXES = ["--discs", "20:34", "--mu", "0.5,1"]
RUNS = ["--replicates", "2", "--events", "200000"]
TABLE = "discs,mu\n" + "".join(f"{discs},{mu}\n" for discs in range(20, 35) for mu in (0.5, 1))
POINTS = 60


class Cluster(InFolder):
    def test_a_failed_node_does_not_change_the_table(self):
        """On the cluster the points are a table, on this machine a product of axes."""
        slurm, environment = private_slurm.started_for(self, nodes=3)
        out = self.path("a cluster, 100 % ours")  # the script must quote this name
        write_text(self.path("points.csv"), TABLE)
        submitted = self.assert_works(
            "sweep",
            "--points",
            self.path("points.csv"),
            *RUNS,
            "--out",
            out,
            "--slurm",
            "--tasks",
            3,
            environment=environment,
        )
        self.assertIn("Submitted as job", submitted.stdout)

        # The log folder exists under the unquoted name.
        self.assertTrue(os.path.isdir(out + "/log"))

        def status():
            done = self.assert_works("sweep", "--out", out, "--status", environment=environment)
            return done.stdout

        def results():
            return sum(name.endswith(".json") for name in os.listdir(out + "/results"))

        killed = False
        running_seen = False

        def is_over():
            nonlocal killed, running_seen
            text = status()
            running_seen = running_seen or ("running" in text and "job " in text)
            if not killed and results() >= 5 and slurm.steps_on("n2"):
                slurm.kill_node("n2")
                killed = True
                self.assertLess(results(), POINTS, "the sweep ended before the node failed")
            return f"{POINTS} of {POINTS} runs done" in text

        wait_until(is_over)
        logs = ""
        for name in sorted(os.listdir(out + "/log")):
            logs += read_text(f"{out}/log/{name}")
        self.assertIn(f"{POINTS} of {POINTS} runs done", status(), logs)
        self.assertEqual(len(os.listdir(out + "/log")), 3)
        self.assertTrue(killed)
        self.assertTrue(running_seen)

        self.assert_works("sweep", *AXES, *RUNS, "--out", self.path("one"), "--quiet")
        tables = [
            swirl("collect", folder, "--csv", "-").stdout for folder in (out, self.path("one"))
        ]
        self.assertEqual(len(tables[0].splitlines()), 1 + POINTS // 2)
        self.assertEqual(tables[0], tables[1])


class Workflow(InFolder):
    @slow("Snakemake has many packages")
    def test_snakemake_makes_the_parts_and_the_table(self):
        plan = {"discs": "5:8", "mu": "0.5,1", "replicates": "2", "events": "2000"}
        done = subprocess.run(
            [
                "snakemake",
                "--snakefile",
                os.path.join(SOURCE, "examples", "sweep.smk"),
                "--cores",
                "2",
                "--config",
                f"swirl={program.SWIRL}",
                "parts=3",
                *(f"{k}={v}" for k, v in plan.items()),
            ],
            cwd=self.folder,
            capture_output=True,
            text=True,
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(len(os.listdir(self.path("parts"))), 3)
        options = [word for name, value in plan.items() for word in (f"--{name}", value)]
        self.assert_works("sweep", *options, "--out", self.path("one"), "--quiet")
        self.assertEqual(
            read_text(self.path("table.csv")),
            swirl("collect", self.path("one"), "--csv", "-").stdout,
        )


if __name__ == "__main__":
    program.main()
