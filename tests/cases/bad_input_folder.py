# SPDX-License-Identifier: LGPL-2.1-or-later
"""What talus does with the files that it finds: those of an earlier run, those of
another run that is going on, and those of the user."""

import os
import pathlib
import shutil
import signal
import subprocess
import time

from bad_input_case import Case, GOOD, RECORD, TALUS

LONG = GOOD.replace("set End time = 0.01", "set End time = 1e6")


class BadInputFolder(Case):
    def start_long_run(self, *settings):
        (self.folder / "long.prm").write_text(LONG)
        options = [o for s in settings for o in ("--set", s)]
        run = subprocess.Popen([TALUS, *options, "--output", "results",
                                "long.prm"],
                               cwd=self.folder, stdout=subprocess.DEVNULL,
                               stderr=subprocess.PIPE, text=True)
        self.addCleanup(run.stderr.close)
        self.addCleanup(run.wait)
        self.addCleanup(run.kill)
        for _ in range(600):
            log = self.results / "log.txt"
            if log.exists() and "time step" in log.read_text():
                return run
            time.sleep(0.05)
        self.fail("The run did not start.")

    # One run per folder

    def test_folder_of_a_run_that_goes_on(self):
        run = self.start_long_run()
        self.assert_refused(self.run_file(), "'results'", "another run",
                            f"process {run.pid}", "--output")
        self.assert_refused(self.run_talus("--output", "results", "--overwrite",
                                           "long.prm"), "another run")
        self.assertIsNone(run.poll())

    def test_resume_beside_a_run_that_goes_on(self):
        run = self.start_long_run()
        run.send_signal(signal.SIGUSR1)
        run.wait()
        run = subprocess.Popen([TALUS, "--resume", "--output", "results",
                                "long.prm"], cwd=self.folder,
                               stdout=subprocess.DEVNULL)
        self.addCleanup(run.wait)
        self.addCleanup(run.kill)
        while "Resumed" not in (self.results / "log.txt").read_text():
            time.sleep(0.05)
        self.assert_refused(self.run_talus("--resume", "--output", "results",
                                           "long.prm"),
                            "another run", f"process {run.pid}")
        self.assertIsNone(run.poll())

    def test_killed_run_leaves_no_lock(self):
        run = self.start_long_run()
        run.kill()
        run.wait()
        result = self.run_file()
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_hang_up_stops_with_a_checkpoint(self):
        # SIGPIPE: who read the standard output has gone.
        for name in (signal.SIGHUP, signal.SIGXCPU, signal.SIGPIPE):
            run = self.start_long_run()
            run.send_signal(name)
            self.assertEqual(run.wait(), 75)
            self.assertIn(name.name, (self.results / "log.txt").read_text())
            for file in self.results.glob("log.txt"):
                file.unlink()
            for file in (self.results / "checkpoints").glob("*/*"):
                file.unlink()
            for folder in (self.results / "checkpoints").iterdir():
                folder.rmdir()

    # Results that go

    def test_results_removed_in_mid_run(self):
        for remove in (pathlib.Path.unlink,
                       lambda path: path.write_text("cut\n")):
            run = self.start_long_run()
            remove(self.results / "statistics.csv")
            self.assertEqual(run.wait(60), 1)
            sentence = run.stderr.read()
            for word in ("results/statistics.csv", "removed or cut",
                         "--overwrite"):
                self.assertIn(word, sentence)
            (self.results / "log.txt").unlink()

    def test_other_results_removed_in_mid_run(self):
        for name in ("log.txt", "parameters.prm", "lock", "points-0000.vtu"):
            settings = ["End time=300", "Output/Field interval=1000"]
            run = self.start_long_run(*settings)
            while not (self.results / name).exists():
                time.sleep(0.01)
            (self.results / name).unlink()
            self.assertEqual(run.wait(60), 1, name)
            self.assertIn(f"lacks '{name}'", run.stderr.read())
            shutil.rmtree(self.results)

    def test_checkpoints_is_a_file(self):
        (self.results / "checkpoints").write_text("mine")
        self.earlier["checkpoints"] = "mine"
        self.assert_refused(self.run_file(), "results/checkpoints",
                            "not a folder", "--output")
        self.assert_untouched()

    def test_maps_is_a_file(self):
        """In the way of the rasters of 3-D only, and if they are wanted."""
        solid = "set Dimension = 3\n" + GOOD
        for flat in ("0, 0", "4, 4", "1, 0", "3, 2"):
            solid = solid.replace(flat + "\n", flat + ", " + flat[0] + "\n")
        (self.results / "maps").write_text("mine")
        self.earlier["maps"] = "mine"
        self.assert_refused(self.run_file(solid, ["Maps/Write=true"]),
                            "results/maps", "not a folder", "--output")
        self.assert_untouched()
        for content, settings in ((solid, []), (GOOD, ["Maps/Write=true"])):
            result = self.run_file(content, settings)
            self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual((self.results / "maps").read_text(), "mine")

    # Files of the user

    def test_parameters_of_the_user(self):
        (self.results / "parameters.prm").write_text(GOOD)
        self.earlier["parameters.prm"] = GOOD
        self.assert_refused(self.run_file(), "parameters.prm",
                            "no run has written", "--output")
        self.assert_untouched()
        self.assert_refused(self.run_talus("--output", "results",
                                           "results/parameters.prm"),
                            "results/parameters.prm", "which is also the input")
        self.assert_untouched()

    def test_ground_motion_that_would_be_written_over(self):
        table = "time [s],gravity factor [-]\n0,1\n1,1\n"
        (self.results / "statistics.csv").write_text(table)
        self.earlier["statistics.csv"] = table
        self.assert_refused(
            self.run_file(settings=["Ground motion/File=results/statistics.csv"]),
            "statistics.csv", "which is also the input", "--output")
        self.assert_untouched()

    def test_ground_motion_with_the_name_of_a_file_that_is_being_written(self):
        table = "time [s],gravity factor [-]\n0,1\n1,1\n"
        for name in ("parameters.prm.part", "points-0000.vtu.part"):
            (self.results / name).write_text(table)
            self.earlier[name] = table
            self.assert_refused(
                self.run_file(settings=[f"Ground motion/File=results/{name}"]),
                name, "which is also the input", "--output")
            self.assert_untouched()

    def test_record_of_an_earlier_run_is_a_parameter_file(self):
        self.assertEqual(self.run_file().returncode, 0)
        first = (self.results / "statistics.csv").read_text()
        result = self.run_talus("--output", "results", "results/parameters.prm")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual((self.results / "statistics.csv").read_text(), first)

    def test_record_that_was_changed_by_hand(self):
        self.assertEqual(self.run_file().returncode, 0)
        record = self.results / "parameters.prm"
        written = record.read_text()
        changed = written.replace("\nset End time", "\n# mine\nset End time")
        self.assertNotEqual(changed, written)
        for mine in (changed, written + "# mine\n",
                     # Without the line that has the checksum.
                     changed[:changed[:-1].rfind("\n") + 1],
                     written[:written[:-1].rfind("\n") + 1]):
            record.write_text(mine)
            self.assert_refused(self.run_file(), "parameters.prm",
                                "somebody has changed", "--output")
            self.assert_refused(self.run_talus("--output", "results",
                                               "results/parameters.prm"),
                                "results/parameters.prm", "which is also the input")
            self.assertEqual(record.read_text(), mine)

    def test_record_that_was_changed_is_in_the_way_of_resuming(self):
        (self.folder / "case.prm").write_text(GOOD)
        self.assertEqual(self.resume(0.1).returncode, 0)
        record = self.results / "parameters.prm"
        record.write_text(record.read_text() + "# mine\n")
        result = self.resume(0.2)
        self.assert_refused(result, "somebody has changed", "resume with the moved file")
        self.assertNotIn("--output", result.stderr)
        record.rename(self.folder / "case.prm")
        self.assertEqual(self.resume(0.2).returncode, 0)

    def test_validate_looks_at_the_folder(self):
        validate = ["--validate", "--output", "results"]
        (self.folder / "case.prm").write_text(GOOD)
        result = self.run_talus(*validate, "case.prm")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertFalse((self.results / "lock").exists())
        table = "time [s],gravity factor [-]\n0,1\n1,1\n"
        for name, content, settings, words in (
                ("lock", "mine", [], "no run has written"),
                ("statistics.csv", table,
                 ["--set", "Ground motion/File=results/statistics.csv"],
                 "which is also the input"),
                ("parameters.prm", GOOD, [], "no run has written"),
                ("parameters.prm", None, [], "may be yours")):
            before = self.earlier.get(name)
            path = self.results / name
            if content is None:
                path.unlink()
            else:
                path.write_text(content)
            for options in (validate, validate[1:]):
                self.assert_refused(
                    self.run_talus(*settings, *options, "case.prm"),
                    name if content else "statistics.csv", words)
            if before is None:
                path.unlink()
            else:
                path.write_text(before)
            self.assert_untouched()
        (self.results / "lock").unlink(missing_ok=True)
        (self.results / "lock").mkdir()
        for options in (validate, validate[1:]):
            self.assert_refused(self.run_talus(*options, "case.prm"), "lock")
        (self.results / "lock").rmdir()
        record = self.results / "parameters.prm"
        record.unlink()
        record.symlink_to("nowhere")
        (self.results / "statistics.csv").unlink()
        for options in (validate, validate[1:]):
            self.assert_refused(self.run_talus(*options, "case.prm"),
                                "parameters.prm", "no run has written")
        self.assertTrue(record.is_symlink())

    def test_validate_knows_an_unfinished_run(self):
        run = self.start_long_run()
        run.send_signal(signal.SIGUSR1)
        self.assertEqual(run.wait(), 75)
        for options in ([], ["--overwrite"], ["--resume"]):
            result = self.run_talus("--validate", "--output", "results",
                                    *options, "long.prm")
            if options:
                self.assertEqual(result.returncode, 0, result.stderr)
            else:
                self.assert_refused(result, "--resume", "--overwrite")

    # Files of an earlier run

    def resume(self, end_time):
        return self.run_talus(
            "--set", f"End time={end_time}", "--set", "Checkpoint/At the end=true",
            *(["--resume"] if end_time > 0.1 else []), "--output", "results",
            "case.prm")

    def test_remains_of_a_killed_run_go(self):
        (self.folder / "case.prm").write_text(GOOD)
        self.assertEqual(self.resume(0.1).returncode, 0)
        stale = ["last-state.vtu", "last-state.3.vtu", "points-0001.vtu.part",
                 "statistics.csv.part"]
        foreign = ["data.part", "last-state.txt"]
        for end_time in (0.2, 0.1):
            for name in stale + foreign:
                (self.results / name).write_text("mine")
            result = self.resume(end_time)
            self.assertEqual(result.returncode, 0, result.stderr)
            found = [f.name for f in self.results.iterdir()]
            self.assertEqual(set(found) & set(stale + foreign), set(foreign))

    def test_results_that_were_cut_before_resume(self):
        """A file of fields keeps its name and has lost its end."""
        for name in ("points-0001.vtu", "grid-0000.vtu"):
            (self.folder / "case.prm").write_text(GOOD)
            self.assertEqual(self.resume(0.1).returncode, 0)
            whole = (self.results / name).read_bytes()
            for n_bytes in (200, len(whole) - 1):
                (self.results / name).write_bytes(whole[:n_bytes])
                result = self.resume(0.2)
                self.assert_refused(result, f"lacks '{name}'", "cut short",
                                    "--overwrite")
                self.assertIn(f"lacks '{name}'", (self.results / "log.txt").read_text())
                # Put back, as the sentence asks for.
                (self.results / name).write_bytes(whole)
                self.assertEqual(self.resume(0.2).returncode, 0)
                self.assertEqual(self.resume(0.1).returncode, 0)
                whole = (self.results / name).read_bytes()

    def test_results_that_are_missing_at_resume(self):
        (self.folder / "case.prm").write_text(GOOD)
        for name in ("points-0000.vtu", "grid.pvd"):
            self.assertEqual(self.resume(0.1).returncode, 0)
            (self.results / name).unlink()
            # There is nothing left to do.
            for validate in ([], ["--validate"]):
                result = self.run_talus("--resume", "--set", "End time=0.1",
                                        "--set", "Checkpoint/At the end=true",
                                        *validate, "--output", "results",
                                        "case.prm")
                self.assertEqual(result.returncode, 1)
                self.assertIn(f"lacks '{name}'", result.stderr)
            result = self.resume(0.2)
            self.assertIn(f"lacks '{name}'",
                          (self.results / "log.txt").read_text())
            # An index is written anew.
            self.assertEqual(result.returncode, int(name.endswith("vtu")))

    def test_what_an_earlier_run_left_goes(self):
        stale = ["points-0000.vtu", "points-0007.0.vtu", "points.pvd",
                 "grid-0000.pvtu", "last-state.vtu", "last-state.3.vtu",
                 "mechanism.pvd", "newton.csv", "obstacles.csv", "points.xdmf",
                 "no-equilibrium.pvd", "no-equilibrium-0001.vtu",
                 "no-equilibrium-0000.h5"]
        foreign = ["points.txt", "notes.csv", "points-of-mine.vtu", "data.part",
                   "my-statistics.csv"]
        for name in stale + foreign:
            (self.results / name).write_text("of an earlier run")
        self.assertEqual(self.run_file().returncode, 0)
        for name in foreign:
            self.assertEqual((self.results / name).read_text(),
                             "of an earlier run")
        for name in stale:
            if (self.results / name).exists():
                self.assertNotEqual((self.results / name).read_text(),
                                    "of an earlier run", name)

    def test_results_without_a_run_may_be_the_users(self):
        (self.results / "parameters.prm").unlink()
        (self.results / "statistics.csv").unlink()
        self.earlier = {}
        for name in ("statistics.csv", "log.txt", "points-0000.vtu",
                     "last-state.vtu"):
            (self.results / name).write_text("mine")
            self.earlier[name] = "mine"
            self.assert_refused(self.run_file(), "results/" + name,
                                "may be yours", "--output")
            self.assert_untouched()
            (self.results / name).unlink()
            self.earlier = {}

    def test_results_that_are_links_leave_what_they_lead_to(self):
        mine = self.folder / "mine.csv"
        mine.write_text("mine")
        for name in ("log.txt", "profile.csv", "points-0000.vtu"):
            (self.results / name).symlink_to("../mine.csv")
        self.assertEqual(self.run_file().returncode, 0)
        self.assertEqual(mine.read_text(), "mine")

    def test_links_with_names_of_files_that_are_being_written(self):
        mine = self.folder / "mine.csv"
        mine.write_text("mine")
        for name in ("parameters.prm", "points-0000.vtu", "points.pvd"):
            (self.results / f"{name}.part").symlink_to("../mine.csv")
        result = self.run_file()
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(mine.read_text(), "mine")

    def test_pipes_with_names_of_outputs(self):
        """To open one would be to wait for its reader."""
        for name in ("statistics.csv", "log.txt", "profile.csv", "points-0000.vtu"):
            path = self.results / name
            path.unlink(missing_ok=True)
            os.mkfifo(path)
            self.assert_refused(self.run_file(), "a pipe", f"results/{name}",
                                "--output")
            path.unlink()

    def test_folder_that_its_record_cannot_name(self):
        for name in ("a\nb", "a\x1b[31m", "a#b", "{a}", "a\\"):
            self.assert_refused(self.run_file(output=name), "parameters.prm cannot "
                                "hold", "--output")
            self.assertFalse((self.folder / name).exists())

    def test_lock_of_the_user(self):
        mine = self.folder / "mine.txt"
        mine.write_text("mine")
        (self.results / "lock").write_text("mine")
        self.assert_refused(self.run_file(), "'lock'", "no run has written",
                            "--output")
        self.assertEqual((self.results / "lock").read_text(), "mine")
        (self.results / "lock").unlink()
        (self.results / "lock").symlink_to("../mine.txt")
        self.assert_refused(self.run_file(), "'lock'", "no run has written",
                            "--output")
        self.assertEqual(mine.read_text(), "mine")
        (self.results / "lock").unlink()
        self.assert_untouched()

    def test_what_others_put_beside_checkpoints_stays(self):
        places = ["checkpoints/2024/notes.txt", "checkpoints/0000000077/a.txt",
                  "checkpoints/00000000123/state.h5", "checkpoints/12345678901",
                  "checkpoints/data.part", "checkpoints/0000000912.part",
                  "checkpoints/thesis.part/chapter.tex",
                  "checkpoints/0000000913.part/notes.txt"]
        empty = self.results / "checkpoints" / "1999"
        empty.mkdir(parents=True)
        for place in places:
            (self.results / place).parent.mkdir(exist_ok=True)
            (self.results / place).write_text("mine")
        every = ["Checkpoint/Step interval=1", "Checkpoint/At the end=true"]
        for settings, options in ((["End time=0.1", *every], []),
                                  (["End time=0.2", *every], ["--resume"]),
                                  (["End time=0.1"], ["--overwrite"])):
            (self.folder / "case.prm").write_text(GOOD)
            result = self.run_talus(
                *[o for s in settings for o in ("--set", s)], *options,
                "--output", "results", "case.prm")
            self.assertEqual(result.returncode, 0, result.stderr)
            for place in places:
                self.assertEqual((self.results / place).read_text(), "mine")
            self.assertTrue(empty.exists())

    def test_checkpoints_of_an_earlier_run_go_but_for_what_is_in_them(self):
        old = self.results / "checkpoints" / "0000000999"
        half = self.results / "checkpoints" / "0000000998.part"
        for folder in (old, half):
            folder.mkdir(parents=True)
            for name in ("state.h5", "mesh", "mesh.info", "checksums", "notes.txt"):
                (folder / name).write_text("of an earlier run")
        # Open MPI's, beside the file that was open when the run was killed.
        killed = self.results / "checkpoints" / "0000000997.part"
        killed.mkdir()
        (killed / ".mesh.shfp.12174.1361915309").touch()
        (self.folder / "case.prm").write_text(GOOD)
        result = self.run_talus("--overwrite", "--output", "results", "case.prm")
        self.assertEqual(result.returncode, 0, result.stderr)
        for folder in (old, half):
            self.assertEqual([f.name for f in folder.iterdir()], ["notes.txt"])
        self.assertFalse(killed.exists())

    # Parameter files that include others

    def write(self, **files):
        for name, content in files.items():
            (self.folder / (name + ".prm")).write_text(content)

    def test_include(self):
        self.write(all="include case.prm\nset End time = 0.005\n", case=GOOD)
        result = self.run_talus("--output", "results", "all.prm")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("to t = 0.005 s", result.stdout)

    def test_include_in_a_circle(self):
        self.write(a="include b.prm\n", b="# and back\ninclude a.prm\n",
                   c="include c.prm\n")
        for file in "ac":
            self.assert_refused(self.run_talus("--output", "results",
                                               file + ".prm"),
                                "includes", file + ".prm")
        self.assert_untouched()

    def test_include_in_joined_lines(self):
        self.write(a="inc\\\nlude \\\n  a.prm\n")
        self.assert_refused(self.run_talus("--output", "results", "a.prm"),
                            "includes 'a.prm'")
        self.write(a="include a.prm\n", case=GOOD)
        self.assert_refused(
            self.run_talus("--output", "results", "--set",
                           "End time=0.01\ninclude a.prm", "case.prm"),
            "--set 'End time'", "several lines")
        self.assert_untouched()

    def test_include_that_doubles(self):
        self.write(**{f"a{i}": f"include a{i + 1}.prm\n" * 2
                      for i in range(18)}, a18="")
        self.assert_refused(self.run_talus("--output", "results", "a0.prm"),
                            "'a0.prm'", "more than 1000 times")
        self.assert_untouched()

    def test_files_without_end(self):
        (self.folder / "case.prm").write_text(GOOD)
        with open(self.folder / "holes.prm", "wb") as file:
            file.truncate(10**12)
        self.assert_refused(self.run_talus("--output", "results", "holes.prm"),
                            "'holes.prm'", "more than 100 MB")
        for table, words in (("holes.prm", "more than 100 MB"),
                             ("/dev/zero", "cannot be read")):
            self.assert_refused(
                self.run_talus("--set", "Ground motion/File=" + table,
                               "--output", "results", "case.prm"), words)
        os.mkfifo(self.folder / "pipe.csv")
        for table, words in (("holes.prm", "more than 100 MB"),
                             ("pipe.csv", "'pipe.csv' cannot be read"),
                             ("/dev/zero", "'/dev/zero' cannot be read")):
            self.assert_refused(
                self.run_talus("--set", "Materials/clay/Law=von Mises", "--set",
                               "Materials/clay/Undrained shear strength=table "
                               + table, "--output", "results", "case.prm"),
                words)
        result = subprocess.run(
            ["bash", "-c", f"'{TALUS}' --output results <(cat /dev/zero)"],
            cwd=self.folder, capture_output=True, text=True, timeout=120)
        self.assert_refused(result, "more than 100 MB")
        self.assert_untouched()

    def test_include_what_is_no_file(self):
        os.mkfifo(self.folder / "pipe.prm")
        for name in ("/dev/zero", ".", "missing.prm", "pipe.prm"):
            self.write(a=f"include {name}\n")
            self.assert_refused(self.run_talus("--output", "results", "a.prm"),
                                f"'{name}'", "cannot be read")
        self.assert_untouched()

    def test_included_file_that_would_be_written_over(self):
        self.write(a="include results/parameters.prm\n")
        (self.results / "parameters.prm").write_text(GOOD)
        self.earlier["parameters.prm"] = GOOD
        self.assert_refused(self.run_talus("--output", "results", "a.prm"),
                            "results/parameters.prm", "which is also the input")
        self.assert_untouched()

    def test_pipe(self):
        self.write(case=GOOD)
        result = subprocess.run(
            ["bash", "-c", f"'{TALUS}' --output results <(cat case.prm)"],
            cwd=self.folder, capture_output=True, text=True, timeout=120)
        self.assertEqual(result.returncode, 0, result.stderr)
