"""--portable: results and recordings without the folders of files."""

import os
import subprocess

from program import InFolder, main, read_bytes, swirl, write_text

FOLDER = "ada-lovelace"  # stands for a user name


class StoredPaths(InFolder):
    def stored(self, *more):
        """The bytes of all files of a run whose files and configuration are in FOLDER."""
        folder = self.path(FOLDER)
        os.makedirs(folder, exist_ok=True)
        write_text(os.path.join(folder, "a.toml"), f"# by {FOLDER}\ndiscs = 3\n")
        write_text(os.path.join(folder, "path.csv"), "t,x,y\n0,0,0\n1,1,0\n2,1,1\n3,0,0\n")
        write_text(os.path.join(folder, "sizes.csv"), "radius\n1\n1\n0.9\n")
        names = {
            option: os.path.join(folder, name)
            for option, name in (
                ("--trajectory", "t.h5"),
                ("--log-events", "e.h5"),
                ("--series", "s.csv"),
                ("--json", "r.json"),
            )
        }
        self.assert_works(
            "run",
            os.path.join(folder, "a.toml"),
            "--motion=" + os.path.join(folder, "path.csv"),
            "--periods",
            4,
            "--warmup",
            1,
            "--quiet",
            "--overwrite",
            *(word for pair in names.items() for word in pair),
            *more,
        )
        found = b""
        for name in names.values():
            found += read_bytes(name)
            if not name.endswith(".csv"):
                self.assert_works("verify", name)
        return found

    def test_results_and_recordings_have_no_folders(self):
        self.assertIn(FOLDER.encode(), self.stored())
        found = self.stored("--portable")
        self.assertNotIn(FOLDER.encode(), found)
        self.assertIn(b"swirl run a.toml --motion=path.csv", found)

    def test_only_folders_are_omitted(self):
        done = swirl(
            "run",
            "--discs",
            3,
            "--sizes",
            "uniform:0.9:1",
            "--ramp",
            "mu=0:1@1..2",
            "--periods",
            3,
            "--warmup",
            0,
            "--series",
            f"{self.folder}//s.csv",
            "--json",
            "-",
            "--quiet",
            "--portable",
        )
        self.assertIn("--sizes uniform:0.9:1 --ramp mu=0:1@1..2 ", done.stdout, done.stderr)
        self.assertIn("--series s.csv", done.stdout)

    def test_tracks_have_no_folders(self):
        os.mkdir(self.path(FOLDER))
        video = self.path(f"{FOLDER}/lab.mp4")
        done = swirl(
            "synthetic-video",
            "--discs",
            20,
            "--container-radius",
            6.5,
            "--scale",
            12,
            "--width",
            240,
            "--height",
            240,
            "--periods",
            1.15,
            "--frames-per-period",
            64,
            "--seed",
            3,
            "--out",
            video,
            "--quiet",
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        out = self.path("tracks.h5")
        done = swirl("track", video, "--out", out, "--quiet", "--portable")
        if "no camera support" in done.stderr:
            self.skipTest("this build has no camera support")
        self.assertEqual(done.returncode, 0, done.stderr)
        for file in (out, self.path("tracks.camera.json")):
            found = subprocess.run(["grep", "-c", FOLDER, file], capture_output=True, text=True)
            self.assertEqual(found.stdout, "0\n", file)
            self.assertIn(b"lab.mp4", read_bytes(file))


if __name__ == "__main__":
    main()
