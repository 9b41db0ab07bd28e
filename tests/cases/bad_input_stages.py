"""What talus says to bad input for the stages before the dynamics; run by
bad_input.py.
"""

import pathlib

from bad_input_case import Case, GOOD

PRM = pathlib.Path(__file__).resolve().parents[2] / "prm"


class BadInputStages(Case):
    CLAY = GOOD.replace("linear elastic", "von Mises")

    def refuse_settings(self, settings, *words, content=CLAY):
        self.assert_refused(self.run_file(content, settings), *words)
        self.assert_untouched()

    def test_good_stages_run(self):
        result = self.run_file(
            self.CLAY, ["Stages=equilibrium, strength reduction, dynamics",
                        "Materials/clay/Undrained shear strength=1e5"])
        self.assertEqual(result.returncode, 0, result)
        self.assertEqual(result.stderr, "")
        self.assertIn("The factor of safety is ", result.stdout)

    def test_list_of_stages(self):
        for stages, *words in (
                ("equilibrum", "'equilibrum'", "'equilibrium'", "'dynamics'"),
                ("dynamics, equilibrium", "'equilibrium' after 'dynamics'",
                 "in the order"),
                ("strength reduction, equilibrium, dynamics",
                 "'equilibrium' after 'strength reduction'", "in the order"),
                ("equilibrium, equilibrium", "'equilibrium' after "
                 "'equilibrium'", "once at most"),
                ("", "Stages is empty", "'dynamics'")):
            with self.subTest(stages):
                self.refuse_settings(["Stages=" + stages], "Stages", *words)

    def test_small_strain_of_a_hyperelastic_law(self):
        self.refuse_settings(["Stages=equilibrium",
                              "Materials/clay/Law=Hencky"],
                             "'Equilibrium/Strain' is small", "'block'",
                             "large", "rate form",
                             content=GOOD)

    def test_no_gravity_at_the_start(self):
        for stages in ("equilibrium", "strength reduction",
                       "equilibrium, dynamics"):
            with self.subTest(stages):
                self.refuse_settings(["Stages=" + stages,
                                      "Gravity/Ramp time=1"],
                                     "no gravity at t = 0",
                                     "'Gravity/Ramp time' to 0")

    def test_nothing_has_a_strength(self):
        for settings in ([], ["Boundaries/Bottom=seabed",
                              "Strength reduction/Seabed=false"]):
            with self.subTest(settings):
                self.refuse_settings(["Stages=strength reduction", *settings],
                                     "'strength reduction'",
                                     "/Materials/clay", "'von Mises'",
                                     "'Strength reduction/Seabed'",
                                     content=GOOD)

    def test_seabed_alone_has_a_strength(self):
        result = self.run_file(
            GOOD, ["Stages=equilibrium, strength reduction",
                   "Gravity/Slope angle=5", "Boundaries/Bottom=seabed",
                   "Boundaries/Seabed/Friction coefficient=0.35",
                   "Boundaries/Seabed/Maximum shear stress=1e9"])
        self.assertEqual(result.returncode, 0, result)
        # 0.35/tan(5 degrees)
        self.assertIn("The factor of safety is 4.0", result.stdout)

    # Soil that cannot stand

    def falls(self, settings, *words):
        options = [o for s in settings for o in ("--set", s)]
        self.assert_refused(
            self.run_talus("--overwrite", "--output", "falls", "--set",
                           "Grid/Cell size=0.8", *options,
                           PRM / "landslide-trigger.prm"),
            "'equilibrium' found no balance", " of the load", ", at (",
            "'no-equilibrium'", "more strength or support", *words)
        written = self.folder / "falls" / "no-equilibrium.pvd"
        self.assertIn(".vtu", written.read_text())

    def test_soil_that_cannot_stand(self):
        self.falls(["Materials/clay/Undrained shear strength=2500"])

    def test_seabed_that_cannot_hold(self):
        self.falls(["Boundaries/Seabed/Maximum shear stress=1e3"])
