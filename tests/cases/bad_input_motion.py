# SPDX-License-Identifier: LGPL-2.1-or-later
"""What talus says to bad input for ground at rest and for what sets it in motion;
run by bad_input.py.
"""

from bad_input_case import Case, GOOD


class BadInputMotion(Case):
    CLAY = GOOD.replace("linear elastic", "von Mises")

    def refuse_trigger(self, settings, *words, content=CLAY):
        self.assert_refused(self.run_file(
            content, ["Trigger/" + s for s in settings]), *words)
        self.assert_untouched()

    def test_trigger(self):
        weaker = "Strength fraction=0.5"
        for settings, *words in (
                (["Strength fraction=-0.1"], "'-0.1'", "from 0 to 1"),
                (["Seabed shear stress fraction=1.5"], "'1.5'", "from 0 to 1"),
                (["Duration=-1"], "'Duration'", "'-1'", "at least 0"),
                (["Start time=0.005"], "nothing", "'Trigger/Strength fraction'",
                 "less than 1"),
                ([weaker, "Start time=0.01"], "'Trigger/Start time' is 0.01 s",
                 "ends at 0.01 s", "'End time'"),
                ([weaker, "Bodies=block, blok"], "'Trigger/Bodies'", "'blok'",
                 "only: block"),
                ([weaker, "Region=2*"], "'Trigger/Region'", "'2*'",
                 "cannot be understood"),
                ([weaker, "Region=y; x"], "'Trigger/Region'", "1 are needed"),
                ([weaker, "Region=1,2,3"], "'Trigger/Region' = '1,2,3'",
                 "comma outside of a function's arguments"),
                ([weaker, "Region=1-t"], "'Trigger/Region' = '1-t'",
                 "cannot be understood", "in x, y, pi"),
                ([weaker, "Region=sqrt(y-1)"], "'Trigger/Region'", "nan",
                 "finite number"),
                ([weaker, "Region=-y"], "'Trigger/Region' = '-y'",
                 "at no point"),
                (["Seabed shear stress fraction=0.5"], "no face", "seabed"),
                (["Seabed shear stress fraction=0.5", "Region=y"],
                 "no face", "seabed")):
            with self.subTest(settings):
                self.refuse_trigger(settings, *words)

    def test_excess_pore_pressure(self):
        weight = ["Gravity/Magnitude=10"]
        for settings, *words in (
                (["Bodies=block"], "'Excess pore pressure/Bodies'", "no soil"),
                (["Initial=1", "Duration=1"], "'Final' is empty"),
                (["Final=1", "Start time=0.01"], "ends at 0.01 s", "'End time'"),
                (["Initial=1", "Stage value=final"], "'Final' is empty"),
                (["Final=1", "Stage value=final"], "no 'strength reduction'"),
                (["Initial=1", "Bodies=blok"], "'blok'", "only: block"),
                (["Initial=2*weight"], "'Excess pore pressure/Initial'",
                 "cannot be understood", "overburden"),
                (["Initial=1.1*overburden"], "'Excess pore pressure/Initial' is",
                 "would float", "largest ratio is 1.1"),
                (["Final=1e6*depth"], "'Excess pore pressure/Final'",
                 "would float"),
                (["Initial=table none.csv"], "none.csv", "cannot be read")):
            with self.subTest(settings):
                self.assert_refused(self.run_file(
                    GOOD, weight + ["Excess pore pressure/" + s
                                    for s in settings]), *words)
                self.assert_untouched()

    def test_trigger_of_obstacles_without_a_limit(self):
        obstacle = ("\nsubsection Obstacles\n  set Names = bed\n"
                    "  subsection bed\n    set Shape = half-plane\n"
                    "    set Normal = 0, 1\n  end\nend\n")
        self.refuse_trigger(["Seabed shear stress fraction=0.5"],
                            "no obstacle has a 'Maximum shear stress'",
                            content=self.CLAY + obstacle)

    def test_softening_by_slip(self):
        seabed = ["Boundaries/Bottom=seabed"]
        softens = ["Slip to remould=0.1", "Remoulded shear stress ratio=0.5"]
        on_seabed = ["Boundaries/Seabed/" + s for s in softens]
        bed = ["Obstacles/Names=bed", "Obstacles/bed/Shape=half-plane",
               "Obstacles/bed/Normal=0, 1"]
        on_bed = bed + ["Obstacles/bed/" + s for s in softens]
        half = "Trigger/Seabed shear stress fraction=0.5"
        for settings, *words in (
                (seabed + on_seabed[:1], "'Boundaries/Seabed/Slip to remould' is 0.1 m",
                 "Give both or neither"),
                (seabed + on_seabed[1:], "ratio of less than 1", "Give both or neither"),
                (on_seabed, "'Boundaries/Seabed/Slip to remould'", "no face of the mesh"),
                (on_bed, "'Obstacles/bed/Slip to remould'",
                 "'Obstacles/bed/Maximum shear stress' is empty"),
                (on_bed + ["Obstacles/bed/Maximum shear stress=1e3",
                           "Obstacles/bed/Velocity=1; 0"],
                 "'Obstacles/bed/Slip to remould'", "the obstacle moves",
                 "only surfaces at rest can soften"),
                (seabed + [half, "Trigger/Seabed region=-1-y"],
                 "'Trigger/Seabed region' = '-1-y'", "at no node of a seabed"),
                (seabed + [half, "Trigger/Seabed region=2*"], "'Trigger/Seabed region'",
                 "cannot be understood"),
                (seabed + ["Trigger/Seabed region=x"], "nothing would become weaker")):
            with self.subTest(settings):
                self.refuse_set(settings, *words)

    def test_obstacle_with_mass(self):
        ball = ["Obstacles/Names=ball", "Obstacles/ball/Shape=ball",
                "Obstacles/ball/Radius=1"]
        plane = ["Obstacles/Names=ball", "Obstacles/ball/Shape=half-plane"]
        mass = "Mass=10"
        turns = ["Free axes=x, rotation", "Moment of inertia=5"]
        for shape, entries, *words in (
                (ball, ["Mass=-1"], "'Mass'", "'-1'"),
                (ball, ["Free axes=x"], "'Obstacles/ball/Free axes' is given",
                 "'Obstacles/ball/Mass' is 0"),
                (ball, ["Force=1; 0"], "'Obstacles/ball/Force'", "Mass' is 0"),
                (ball, ["Spring stiffness=1, 1"], "Spring stiffness' is given",
                 "Give the mass in kg"),
                (ball, ["Spring damping=1, 1"], "Spring damping' is given",
                 "Mass' is 0"),
                (ball, ["Moment of inertia=1"], "Moment of inertia' is given",
                 "Mass' is 0"),
                (ball, [mass, "Velocity=1; 0"], "'Obstacles/ball/Mass' and",
                 "'Obstacles/ball/Velocity' = 1; 0", "Remove one"),
                (ball, [mass, "Free axes=x, z"], "the axis 'z'",
                 "some of x, y, rotation"),
                (ball, [mass, "Free axes=x, rotation"],
                 "'Obstacles/ball/Moment of inertia' is 0", "needs both"),
                (ball, [mass, "Moment of inertia=1"], "axis rotation is not listed",
                 "needs both"),
                (plane, [mass, *turns], "the shape has no ends"),
                (ball, [mass, "Force=1"], "'Obstacles/ball/Force'",
                 "2 are needed"),
                (ball, [mass, "Force=1; 0; 0"], "'Obstacles/ball/Force'",
                 "2 are needed"),
                (ball, [mass, "Force=1/t; 0"], "'Obstacles/ball/Force'",
                 "finite number"),
                (ball, [mass, "Spring stiffness=1"],
                 "'Obstacles/ball/Spring stiffness' has 1 numbers", "expected 2"),
                (ball, [mass, *turns, "Spring stiffness=1, 0"],
                 "has 2 numbers", "expected 3"),
                (ball, [mass, "Free axes=x", "Spring stiffness=1, 1"],
                 "Spring stiffness' is 1 for the axis y", "held there"),
                (ball, [mass, "Spring yield force=1, 0"],
                 "Spring yield force' is 1 for the axis x", "no spring can yield"),
                (ball, [mass, "Spring stiffness=-1, 0"], "'Spring stiffness'",
                 "-1")):
            with self.subTest(entries):
                self.refuse_set(shape + ["Obstacles/ball/" + e for e in entries],
                                *words)
        self.refuse_set(ball + ["Obstacles/ball/" + e for e in (
            mass, "Maximum shear stress=10", "Slip to remould=1",
            "Remoulded shear stress ratio=0.5")],
            "the obstacle moves ('Obstacles/ball/Mass')")

    def test_trigger_of_a_body_without_strength(self):
        weaker = "Strength fraction=0.5"
        self.refuse_trigger([weaker], "/Materials/clay", "no strength",
                            "'von Mises'", content=GOOD)
        self.refuse_trigger([weaker, "Bodies=block"], "'block'",
                            "/Materials/clay", "no strength", content=GOOD)

    def test_region_that_nothing_weakens(self):
        self.refuse_set(["Boundaries/Bottom=seabed", "Trigger/Region=y",
                         "Trigger/Seabed shear stress fraction=0.5"],
                        "'Trigger/Region'", "'Trigger/Strength fraction' is 1",
                        "remove")

    def refuse_table(self, content, *words, settings=()):
        (self.folder / "record.csv").write_text(content)
        self.refuse_set(["Ground motion/File=record.csv", *settings],
                        "record.csv", *words)

    def test_ground_motion(self):
        a, b = "time [s],horizontal [m/s^2]\n", "0,1\n1,0\n"
        for content, *words in (
                ("", "cannot be read or is empty", "existing CSV file"),
                ("0,1\n1,0\n", "line 1", "'0'", "'time [s]'",
                 "'gravity factor [-]'"),
                ("# a comment\ntime [s],x [g]\n" + b, "line 2", "'x [g]'",
                 "'horizontal [m/s^2]'"),
                ("horizontal [m/s^2]\n1\n", "line 1", "'time [s]'"),
                ("time [s]\n0\n1\n", "line 1", "at least one other"),
                ("time [s],time [s]\n" + b, "line 1", "'time [s]'", "twice"),
                (a + "0,1\n1;0\n", "line 3", "1 entries", "2 columns"),
                (a + "0,1\n1,0,0\n", "line 3", "3 entries", "2 columns"),
                (a + "0,1\n1,\n", "line 3", "''", "finite number"),
                (a + "0,1\n1,nan\n", "line 3", "'nan'", "finite number"),
                (a + "0,1\n\n1,1.2x\n", "line 4", "'1.2x'", "finite number"),
                (a + "0,1\n1,0\n1,0\n", "line 4", "1 s", "must ascend"),
                (a + "0,1\n", "1 rows", "at least two"),
                (a + "0.5,1\n1,0\n", "0.5 s", "1 m/s^2", "jump",
                 "'horizontal [m/s^2]'", "row with zeros"),
                (a + "0.5,0\n1,1\n", "t = 0.5 s to 1 s", "to 'End time' = 0.01",
                 "never act"),
                ("time [s],across [m/s^2]\n" + b, "'across [m/s^2]'",
                 "two-dimensional")):
            with self.subTest(content):
                self.refuse_table(content, *words)
        self.refuse_table(a + b, "2 s", "jump",
                          settings=["Ground motion/Start time=2"])
        self.refuse_table(a + b, "t = -10 s to -9 s", "never act",
                          settings=["Ground motion/Start time=-10"])

    def test_ground_motion_without_table(self):
        (self.folder / "rest.csv").write_text(
            "time [s],horizontal [m/s^2]\n0,0\n1,1\n")
        self.refuse_set(["Ground motion/File=rest.csv", "Ground motion/Factor=0"],
                        "'Ground motion/Factor' is 0", "rest.csv", "have no effect")
        self.refuse_set(["Ground motion/File=missing.csv"], "missing.csv",
                        "cannot be read", "folder of the parameter file")
        self.refuse_set(["Ground motion/File=."], "cannot be read")
        self.refuse_set(["Ground motion/Factor=2"], "'Ground motion/File'",
                        "empty")

    def test_ground_motion_lies_beside_the_parameter_file(self):
        inside = self.folder / "inside"
        inside.mkdir()
        (inside / "case.prm").write_text(GOOD)
        (inside / "record.csv").write_text(
            "\ufefftime [s], gravity factor [-]\r\n0, 1\r\n1, 2\r\n")
        result = self.run_talus("--output", "results", "--set",
                                "Ground motion/File=record.csv",
                                "inside/case.prm")
        self.assertEqual(result.returncode, 0, result)

    def test_K0(self):
        K0 = "Bodies/block/K0=0.5"
        for settings, *words in (
                ([K0, "Bodies/block/Initial stress=0; 0; 0; 0"],
                 "Bodies/block/K0", "Bodies/block/Initial stress", "one stress",
                 "Remove"),
                ([K0, "Materials/clay/Law=Hencky"], "Bodies/block/K0",
                 "deformation", "rate form"),
                ([K0, "Bodies/block/Initial displacement=0.1; 0"],
                 "Bodies/block/K0", "Initial displacement", "Remove"),
                ([K0, "Gravity/Ramp time=1"], "no gravity at t = 0",
                 "Gravity/Ramp time"),
                ([K0, "Gravity/Magnitude=0"], "no gravity at t = 0",
                 "Gravity/Magnitude"),
                (["Bodies/block/K0=-1"], "'K0'", "'-1'")):
            with self.subTest(settings):
                self.refuse_set(settings, *words)

    def test_stress_beyond_the_strength_is_in_the_log(self):
        # s_yy = -2000 (2 - y) g; at K0 = 0, plane strain: tau = |s_yy|/sqrt(3),
        # at the lowest points 0.25 m above the bottom.
        result = self.run_file(GOOD.replace("linear elastic", "von Mises"),
                               ["Bodies/block/K0=0", "Gravity/Magnitude=10",
                                "Materials/clay/Undrained shear strength=7e3"])
        self.assertEqual(result.returncode, 0, result.stderr)
        log = (self.results / "log.txt").read_text()
        for words in ("Body 'block': the K0 stress is more than the soil bears at 8 points",
                      "up to 1.44338 times", "'Bodies/block/K0'"):
            self.assertIn(words, log)
