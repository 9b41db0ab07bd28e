# SPDX-License-Identifier: LGPL-2.1-or-later
"""What talus says when a run cannot be resumed.

Usage: resume_refused.py TALUS PRM_FOLDER FOLDER TestClass [LAUNCHER ...],
with a launcher such as `mpirun -np 2` before each talus.
"""

import shutil
import subprocess

from resume_case import Case, EVERY, FOLDER, PRM, TALUS, main


class ResumeRefused(Case):
    """Exit status 1, one helpful line, nothing touched."""

    prepared = None

    def setUp(self):
        super().setUp()
        if ResumeRefused.prepared is None:
            ResumeRefused.prepared = FOLDER / "prepared"
            shutil.rmtree(self.prepared, ignore_errors=True)
            self.assert_ends(self.run_talus(self.prepared,
                                            ["End time=0.2"] + EVERY))
        shutil.copytree(self.prepared, self.folder / "run")
        self.before = self.content("run", [])

    def refuse(self, settings, *words, options=("--resume",)):
        result = self.run_talus("run", settings, options)
        print(f"{self.id().split('.')[-1]}: {result.stderr.rstrip()}")
        self.assertEqual(result.returncode, 1, result)
        self.assertEqual(result.stdout, "")
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        self.assertTrue(result.stderr.startswith("talus: "), result.stderr)
        self.assertTrue(result.stderr.rstrip().endswith("."), result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)
        self.assertEqual(self.content("run", []), self.before)

    def damage(self, checkpoint, file="state.h5"):
        path = self.checkpoints("run")[checkpoint] / file
        data = bytearray(path.read_bytes())
        data[len(data) // 3] ^= 16
        path.write_bytes(data)
        self.before = self.content("run", [])

    def test_no_checkpoint(self):
        shutil.rmtree(self.folder / "run" / "checkpoints")
        self.before = self.content("run", [])
        self.refuse([], "no checkpoint in", "/run'", "--output",
                    "without --resume")

    def test_no_folder(self):
        result = self.run_talus("nowhere", [], ["--resume"])
        self.assertEqual(result.returncode, 1)
        self.assertIn("no checkpoint in", result.stderr)
        self.assertFalse((self.folder / "nowhere").exists())

    def test_both_damaged(self):
        self.damage(-1)
        self.damage(-2, "mesh")
        self.refuse([], "is damaged: the checksum of 'state.h5' does not match",
                    "the checksum of 'mesh' does not match", "--overwrite")

    def test_empty_and_missing_files(self):
        newest, previous = self.checkpoints("run")[::-1]
        (newest / "state.h5").write_bytes(b"")
        (previous / "mesh").unlink()
        self.before = self.content("run", [])
        self.refuse([], "the checksum of 'state.h5' does not match",
                    "the checksum of 'mesh' does not match")
        (newest / "checksums").unlink()
        self.before = self.content("run", [])
        self.refuse([], "'checksums' is missing or damaged")

    def test_damaged_and_previous(self):
        self.damage(-1, "mesh_variable.data")
        newest, previous = self.checkpoints("run")[::-1]
        result = self.run_talus("run", ["End time=0.3"], ["--resume"])
        self.assert_ends(result)
        sentence = (f"The checkpoint '{newest}' is damaged: the checksum of "
                    "'mesh_variable.data' does not match its content.")
        log = (self.folder / "run" / "log.txt").read_text()
        for text in (result.stdout, log):
            self.assertIn(sentence, text)
            self.assertIn("The run continues from the previous checkpoint.", text)
        self.assertIn(f", from '{previous}'", log)
        # It made way for one that is whole.
        self.assertNotIn(newest, self.checkpoints("run"))
        self.assert_ends(self.run_talus("run", ["End time=0.4"], ["--resume"]))

    def test_critical_parameters(self):
        for setting, *words in (
                ("Grid/Cell size=0.4", "'0.4'", "'0.8'"),
                ("Grid/Upper corner=288, 8", "'288, 8'", "'280, 8'"),
                ("Time step/CFL number=0.1", "'0.1'", "'0.2'"),
                ("Gravity/Slope angle=6", "'6'", "'5'"),
                ("Materials/clay/Poisson's ratio=0.48", "'0.49'"),
                ("Materials/clay/Undrained shear strength=2e3", "'2e3'"),
                ("Boundaries/Seabed/Maximum shear stress=9e2", "'9e2'"),
                ("Output/Runout=false", "'false'", "'true'"),
                ("Splitting/Threshold=1.5", "'1.5'", "'1.4'")):
            self.refuse([setting], "The parameter '" + setting.split("=")[0],
                        *words)

    def test_another_law(self):
        """By its name, not by a parameter that follows from it."""
        self.refuse(["Materials/clay/Law=Herschel-Bulkley"],
                    "The parameter 'Materials/clay/Law' is 'Herschel-Bulkley'",
                    "'von Mises'")

    def test_table_that_changed(self):
        record = self.folder / "record.csv"
        record.write_text("time [s],horizontal [m/s^2]\n0,0\n1,1\n")
        shutil.rmtree(self.folder / "run")
        settings = EVERY + [f"Ground motion/File={record}"]
        self.assert_ends(self.run_talus("run", ["End time=0.1"] + settings))
        self.before = self.content("run", [])
        record.write_text("time [s],horizontal [m/s^2]\n0,0\n1,2\n")
        self.refuse(settings, "The table", "record.csv", "differs from the file",
                    "Restore the file")

    def test_files_that_changed(self):
        """A surface, and a strength that is read at the start alone."""
        raster = self.folder / "bed.asc"
        strength = self.folder / "strength.csv"
        contents = {raster: "ncols 2\nnrows 2\nxllcorner -1000\nyllcorner -1000\n"
                            "cellsize 1500\n-1 -1\n-1 -1\n",
                    strength: "depth [m],undrained shear strength [Pa]\n"
                              "0,2500\n5,2600\n"}
        for file, content in contents.items():
            file.write_text(content)
        shutil.rmtree(self.folder / "run")
        settings = EVERY + [
            "Surfaces/Names=bed", f"Surfaces/bed/File={raster}",
            "Surfaces/bed/Section=0,0; 280,0", "Obstacles/Names=bottom",
            "Obstacles/bottom/Shape=terrain", "Obstacles/bottom/Surface=bed",
            f"Materials/clay/Undrained shear strength=table {strength}"]
        self.assert_ends(self.run_talus("run", ["End time=0.1"] + settings))
        self.before = self.content("run", [])
        for file, of, *change in ((raster, "raster", "-1 -1\n-1", "-1 -1\n-2"),
                                  (strength, "table", "2600", "2601")):
            file.write_text(contents[file].replace(*change))
            self.refuse(settings, f"The {of} '{file}' differs from the file",
                        "Restore the file")
            file.unlink()
            self.refuse(settings, str(file))
            file.write_text(contents[file])
        self.assert_ends(self.run_talus("run", settings, ["--resume"]))

    def test_harmless_parameters(self):
        self.assert_ends(self.run_talus(
            "run", ["Title=Another", "End time=3", "Checkpoint/Step interval=7",
                    "Output/Statistics interval=0.5", "Grid/Cell size=8e-1",
                    "Output/Boxes as cells=false",
                    "Bodies/slide/Vertices=0,0;48.66,0;40,5;8.66,5",
                    "Splitting/Maximum number of points=20000000"],
            ["--resume", "--validate"]))
        self.assertEqual(self.content("run", []), self.before)

    def test_other_dimension(self):
        result = subprocess.run(
            [*self.launcher, TALUS, PRM / "landslide-3d.prm", "--resume",
             "--output", self.folder / "run"], capture_output=True, text=True)
        self.assertEqual(result.returncode, 1, result)
        self.assertIn("Dimension = 2", result.stderr)
        self.assertIn("Dimension = 3", result.stderr)
        self.assertEqual(self.content("run", []), self.before)

    def test_end_is_over(self):
        self.refuse(["End time=0.1"], "end time is 0.1 s", "t = 0.2 s",
                    "'End time'")

    def test_run_without_end(self):
        """The end may change, and is looked at again."""
        self.refuse(["End time=1e30"], "time steps", "cannot end", "units")

    def test_fewer_points_allowed(self):
        self.refuse(["Splitting/Maximum number of points=10"],
                    "'Splitting/Maximum number of points' = 10", "Allow more")

    def test_files_of_others_in_checkpoints(self):
        """They are no damage; the mesh has no less to be what it was."""
        newest = self.checkpoints("run")[-1]
        for name in ("notes.txt", ".nfs0001", ".mesh.shfp.1.2"):
            (newest / name).write_text("mine")
        self.assert_ends(self.run_talus("run", ["End time=0.3"], ["--resume"]))
        log = (self.folder / "run" / "log.txt").read_text()
        self.assertIn(f", from '{newest}'", log)
        self.assertEqual((newest / "notes.txt").read_text(), "mine")

    def test_statistics_missing(self):
        (self.folder / "run" / "statistics.csv").unlink()
        self.before = self.content("run", [])
        self.refuse([], "statistics.csv", "cannot be read", "bytes")

    def test_profile_too_short(self):
        (self.folder / "run" / "profile.csv").write_text("time\n")
        self.before = self.content("run", [])
        self.refuse([], "profile.csv", "only 5 bytes")

    def test_statistics_with_other_columns(self):
        path = self.folder / "run" / "statistics.csv"
        path.write_text(path.read_text().replace("time [s]", "time [h]", 1))
        self.before = self.content("run", [])
        self.refuse([], "statistics.csv", "'time [h]'", "'time [s]'")

    def test_forgotten_resume(self):
        # A finished run may be overwritten, an unfinished one is guarded.
        self.assert_ends(self.run_talus("run", ["End time=0.2"]))
        self.assertEqual(len(self.checkpoints("run")), 1)
        self.assert_ends(self.run_talus(
            "run", EVERY + ["Checkpoint/At the end=false"]))
        self.before = self.content("run", [])
        self.refuse([], "holds the checkpoint", "of a run to 2 s", "--resume",
                    "--overwrite", options=())
        self.assert_ends(self.run_talus("run", ["End time=0.1"],
                                        ["--overwrite"]))

    def test_extended_and_killed(self):
        """A run that was finished and goes on is guarded at once."""
        self.assert_ends(self.run_talus(
            "run", ["End time=30", "Checkpoint/Wall time limit=0.001"],
            ["--resume"]), 75)
        # As if it had been killed before it wrote the newest.
        shutil.rmtree(self.checkpoints("run")[-1])
        self.before = self.content("run", [])
        self.refuse([], "holds the checkpoint", "of a run to 30 s",
                    options=())

    def test_resume_and_overwrite(self):
        self.refuse([], "--resume", "--overwrite",
                    options=("--resume", "--overwrite"))


if __name__ == "__main__":
    main(globals())
