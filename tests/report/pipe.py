# SPDX-License-Identifier: LGPL-2.1-or-later
"""talus-pipe: beams with a closed form, tables of runs as loads, and refused input.

Usage: pipe.py TALUS ROOT FOLDER [SUITE]
"""

import math

import numpy

from tools_case import Case, main, read_csv

from talus_tools.errors import UserError
from talus_tools.pipe import beam
from talus_tools.pipe.settings import Settings

# Steel pipe of 0.6 m; the stiffnesses of the closed forms are given explicitly.
PIPE = {"Pipe/Outer diameter": 0.6, "Pipe/Wall thickness": 0.02}
EI, K, Q, B = 1.2e8, 2e5, 2e4, 100.0


class PipeCase(Case):
    def parameters(self, name, entries):
        """A parameter file of talus-pipe."""
        lines = []
        for key, value in (PIPE | entries).items():
            *sections, entry = key.split("/")
            lines += [f"subsection {s}" for s in sections] + [f"set {entry} = {value}"]
            lines += ["end" for s in sections]
        path = self.folder / f"{name}.prm"
        path.write_text("\n".join(lines) + "\n")
        return path

    def run_folder(self, name, **tables):
        """An output folder with tables that a run might have written."""
        folder = self.folder / name
        folder.mkdir(exist_ok=True)
        (folder / "parameters.prm").write_text("set Dimension = 2\n")
        for table, text in tables.items():
            (folder / f"{table}.csv").write_text(text)
        return folder

    def force(self, name, *forces):
        """A run with these forces on an obstacle, N per metre width."""
        return self.run_folder(name, obstacles="time [s],pipe force x [N]\n" + "".join(
            f"{i},{force!r}\n" for i, force in enumerate(forces)))

    def respond(self, run, name, entries):
        """Rows of along.csv and history.csv as {column: array}."""
        result = self.tool("talus-pipe", run, self.parameters(name, entries))
        self.assertEqual(result.returncode, 0, result)
        self.assertEqual(result.stderr, "")
        self.assertTrue((run / "pipe" / "pipe.png").stat().st_size > 10000)
        self.printed = result.stdout
        return [{key: numpy.array([float(row[key]) for row in rows]) for key in rows[0]}
                for rows in (read_csv(run / "pipe" / f"{table}.csv")
                             for table in ("along", "history"))]

    def assert_near(self, value, exact, tolerance):
        self.assertLess(abs(value / exact - 1), tolerance, (value, exact))


LINEAR = {"Length": 400, "Pipe/Bending stiffness": EI, "Pipe/Axial stiffness": 1,
          "Lateral springs/Stiffness": K, "Load/Obstacle": "pipe", "Load/Width": B}


class Beams(PipeCase):
    def test_winkler(self):
        """Uniform load over a width on linear springs: closed form of an endless beam."""
        run = self.force("winkler", 0.0, Q / 2, Q)
        along, history = self.respond(run, "winkler", LINEAR | {"Ends": "free"})
        beta = (K / (4 * EI)) ** 0.25
        x = along["s [m]"] - 200
        middle = abs(x) < 1e-9
        w0 = Q / K * (1 - math.exp(-beta * B / 2) * math.cos(beta * B / 2))
        m0 = Q / (2 * beta**2) * math.exp(-beta * B / 2) * math.sin(beta * B / 2)
        self.assert_near(w0, 0.0999485, 1e-5)
        self.assert_near(along["deflection [m]"][middle][0], w0, 1e-3)
        # The moment in the middle is 4e-3 of the largest one.
        self.assert_near(along["bending moment [N m]"][middle][0], m0, 1e-3)
        # The moment is largest pi/(4 beta) inside and outside of the edge of the slide.
        moment = abs(along["bending moment [N m]"])
        for part, place in ((abs(x) < 50, 44.5), (abs(x) > 50, 55.5)):
            self.assert_near(moment[part].max(), 78.97e3, 1e-3)
            self.assertLess(abs(abs(x[part][moment[part].argmax()]) - place), 0.5)
        self.assert_near(history["largest deflection [m]"][1],
                         history["largest deflection [m]"][2] / 2, 1e-9)
        self.assert_near(history["load [N]"][2], Q * B, 1e-12)
        # Stress by bending, on the section of the pipe itself.
        second = math.pi / 64 * (0.6**4 - 0.56**4)
        self.assert_near(history["largest utilisation [-]"][2],
                         moment.max() * 0.3 / second / 4.5e8, 2e-3)
        self.assertNotIn("Remark", self.printed)

    def test_stretched_beam(self):
        """A sine load on a pinned beam without springs: the deflection is a sine of amplitude
        a, and EI a + EA a^3/4 = q (L/pi)^4, by the axial force EA (pi a/2L)^2."""
        length, area, q = 200.0, 4e9, 500.0
        places = numpy.linspace(0, length, 401)
        pressure = q / 0.6 * numpy.sin(math.pi * places / length)
        run = self.run_folder("sine", lines=(
            "line,distance [m],maximum impact pressure [Pa]\n" + "".join(
                f"route,{s!r},{p!r}\n" for s, p in zip(places.tolist(), pressure.tolist()))))
        along, history = self.respond(run, "sine", {
            "Length": length, "Ends": "pinned", "Element size": 0.5,
            "Pipe/Bending stiffness": EI, "Pipe/Axial stiffness": area,
            "Lateral springs/Stiffness": 0, "Load/Source": "line", "Load/Line": "route"})
        amplitude = along["deflection [m]"].max()
        self.assert_near(EI * amplitude + area * amplitude**3 / 4, q * (length / math.pi) ** 4,
                         1e-3)
        self.assertGreater(area * amplitude**3 / 4, 5 * EI * amplitude)
        for column, value in (("axial force [N]", area * (math.pi * amplitude / 2 / length)**2),
                              ("largest axial force [N]", history["largest axial force [N]"][-1])):
            self.assert_near(along[column][200], value, 1e-3)

    def test_string_on_plastic_soil(self):
        """A pipe without bending stiffness on soil that yields at once: net load inside the
        slide, resistance outside as far as the pipe moves. Two parabolas."""
        tension, resistance, width = 2e6, 4e3, 40.0
        run = self.force("string", 0.0, 1e4)
        along, _ = self.respond(run, "string", {
            "Length": 300, "Element size": 0.25, "Pipe/Bending stiffness": 1e3,
            "Pipe/Axial stiffness": 1, "Pipe/Tension": tension,
            "Lateral springs/Stiffness": 1e8, "Lateral springs/Ultimate resistance": resistance,
            "Load/Obstacle": "pipe", "Load/Width": width})
        net = 1e4 - resistance
        beyond = net * width / 2 / resistance  # length outside of the slide that moves
        edge = resistance * beyond**2 / (2 * tension)
        middle = edge + net * width**2 / (8 * tension)
        x = abs(along["s [m]"] - 150)
        deflection = along["deflection [m]"]
        self.assert_near(deflection[x.argmin()], middle, 2e-3)
        self.assert_near(deflection[abs(x - width / 2).argmin()], edge, 5e-3)
        self.assertLess(abs(deflection[x > width / 2 + beyond + 2]).max(), 1e-3 * middle)

    def test_soil_remembers(self):
        """Where springs have yielded the pipe does not come back; linear springs forget."""
        run = self.force("cycle", 0.0, Q, 0.0)
        soil = LINEAR | {"Lateral springs/Ultimate resistance": 1.2e4, "Pipe/Axial stiffness": 4e9}
        _, history = self.respond(run, "plastic", soil)
        loaded, unloaded = history["largest deflection [m]"][1:]
        self.assertGreater(loaded, 3 * 0.1)
        self.assertGreater(unloaded, 0.2 * loaded)
        _, history = self.respond(run, "linear", LINEAR)
        self.assertLess(abs(history["largest deflection [m]"][2]), 1e-9)

    def test_axial_springs(self):
        """Soil that holds the pipe along its axis: without springs both ends pull as much as
        the middle, with them the axial force decays with distance from the slide."""
        run = self.force("axial", 0.0, 3 * Q)
        soil = LINEAR | {"Pipe/Axial stiffness": 7e9, "Lateral springs/Ultimate resistance": 2e4}
        along, _ = self.respond(run, "slipping", soil)
        axial = along["axial force [N]"]
        self.assert_near(axial.min(), axial.max(), 1e-6)
        along, _ = self.respond(run, "held", soil | {
            "Axial springs/Stiffness": 1e7, "Axial springs/Ultimate resistance": 8e3})
        axial, s = along["axial force [N]"], along["s [m]"]
        self.assertGreater(axial[len(s) // 2], 0)
        slope = numpy.diff(axial) / numpy.diff(s)
        # Outside of the slide the pipe slides through its soil: N' is the resistance.
        self.assert_near(slope[(s[:-1] > 110) & (s[:-1] < 140)].mean(), 8e3, 1e-3)


class Cables(PipeCase):
    """A pipe that starts straight and without tension, in a slide of 2.5 km: a cable."""
    LENGTH, LOADED, RESISTANCE = 4000.0, 2500.0, 4e3
    SOIL = {"Length": LENGTH, "Lateral springs/Stiffness": 1e5,
            "Lateral springs/Ultimate resistance": RESISTANCE, "Load/Source": "line",
            "Load/Line": "cable", "Load/Lateral resistance in the slide": 0}
    AREA, SECOND = math.pi * 0.02 * 0.58, math.pi / 64 * (0.6**4 - 0.56**4)

    def slide_of(self, q):
        """A run whose slide loads the middle with q, N/m."""
        ends = [(self.LENGTH + sign * self.LOADED) / 2 for sign in (-1, 1)]
        return self.run_folder(f"cable-{q:g}", lines=(
            "line,distance [m],maximum impact pressure [Pa]\n"
            + "".join(f"cable,{s!r},{q / 0.6!r}\n" for s in ends)))

    def axial_force(self, q):
        """Axial force H, N, of a cable between fixed ends, on soil that yields outside of the
        slide: the mean of V^2/(2 H^2) is the strain H/EA, with the transverse force V."""
        edge = q * self.LOADED / 2
        end = edge - self.RESISTANCE * (self.LENGTH - self.LOADED) / 2
        self.assertGreater(end, 0)  # soil alone does not hold the pipe
        squares = 2 * (edge**2 * self.LOADED / 2 / 3
                       + (edge**3 - end**3) / (3 * self.RESISTANCE))
        return (2.07e11 * self.AREA * squares / (2 * self.LENGTH)) ** (1 / 3)

    def test_cable(self):
        """Closed form of axial force, deflection in the middle and utilisation, with elements of
        5 m and of a sixteenth of the length of bending; the soil changes the 35 MN of a cable
        that is held at the edges of the slide to 46 MN."""
        self.assert_near(self.axial_force(6000), 45.82e6, 1e-3)
        for q in (6e3, 2e5):
            force, run = self.axial_force(q), self.slide_of(q)
            found = {}
            for size in ("5", ""):
                along, history = self.respond(run, f"cable-{q:g}", self.SOIL | {"Element size": size})
                axial, s = along["axial force [N]"], along["s [m]"]
                self.assert_near(axial.min(), axial.max(), 1e-6)
                self.assert_near(axial[0], force, 5e-3)
                middle = along["deflection [m]"][abs(s - self.LENGTH / 2).argmin()]
                edge = q * self.LOADED / 2
                outside = (self.LENGTH - self.LOADED) / 2
                self.assert_near(middle, (edge * self.LOADED / 4 + edge * outside
                                          - self.RESISTANCE * outside**2 / 2) / force, 5e-3)
                # At a fixed end the pipe bends over the length sqrt(EI/H).
                end = edge - self.RESISTANCE * outside
                moment = end * math.sqrt(2.07e11 * self.SECOND / force)
                if not size or q < 1e4:
                    stress = force / self.AREA + moment * 0.3 / self.SECOND
                    self.assert_near(history["largest utilisation [-]"][-1], stress / 4.5e8, 2e-2)
                self.assertIn("exceeds the yield stress", self.printed)
                found[size] = (axial[0], middle)
            for one, other in zip(found["5"], found[""]):
                self.assert_near(one, other, 1e-3)
            self.assertGreater(len(s), 6000)

    def test_one_step(self):
        """The whole load at once, from the straight pipe, without smaller parts: the same
        balance. Without a line search none is found, nor for a rope on stiff soil, nor for free
        ends."""
        for q, change in ((6e3, {}), (2e5, {}), (6e3, {
                "Ends": "free", "Axial springs/Stiffness": 1e6,
                "Axial springs/Ultimate resistance": 1e5,
                "Lateral springs/Ultimate resistance": 1e5}), (2e3, {
                "Pipe/Outer diameter": 0.05, "Pipe/Wall thickness": 0.001,
                "Lateral springs/Stiffness": 1e9})):
            path = self.parameters("step", self.SOIL | {"Element size": 2} | change)
            one = beam.Beam(Settings(path), lambda s: numpy.where(
                abs(s - self.LENGTH / 2) < self.LOADED / 2, 0, 1))
            load = numpy.where(one.resistance == 0, q, 0.0)
            state = one.balance(beam.State(len(one.s)), load)
            axial = one.axial_force(state.displacement)
            if not change:
                self.assert_near(axial.mean(), self.axial_force(q), 5e-3)
                continue
            # The soil holds the whole load.
            deflection = one.bent(state.displacement) @ one.shape + state.displacement[:-1, 1:2]
            held, _, _ = beam.spring(one.settings.lateral, one.resistance, deflection, 0)
            self.assert_near((held @ one.weights).sum(), q * self.LOADED, 1e-6)
            self.assertLess(abs(deflection).max(), self.LENGTH / 4)

    def test_friction(self):
        """Friction along the pipe, 1500 N/m, changes the axial force by at most friction times
        half the length, and the mean by less than 1 %, of second order in the change. Where the
        pipe slides the force changes by the friction per length."""
        along, _ = self.respond(self.slide_of(6e3), "friction", self.SOIL | {
            "Axial springs/Stiffness": 1e6, "Axial springs/Ultimate resistance": 1.5e3})
        axial, s = along["axial force [N]"], along["s [m]"]
        self.assert_near(axial.mean(), self.axial_force(6e3), 1e-2)
        self.assertLess(numpy.ptp(axial), 1.5e3 * self.LENGTH / 2)
        slope = abs(numpy.diff(axial) / numpy.diff(s))[(s[:-1] > 20) & (s[:-1] < 280)]
        self.assert_near(slope.mean(), 1.5e3, 1e-3)


class Loads(PipeCase):
    def test_stations(self):
        """Pressures at stations, linear in between, in time; the same load as an obstacle's
        where all pressures are equal."""
        pressure = Q / 0.6
        table = "time [s]," + ",".join(f"{n} impact pressure [Pa]" for n in "abc") + "\n"
        table += "0,0,0,0\n" + f"5,{pressure!r},{pressure!r},{pressure!r}\n"
        run = self.run_folder("stations", stations=table)
        by_stations = {k: v for k, v in LINEAR.items() if not k.startswith("Load/")} | {
            "Load/Source": "stations", "Load/Stations": "a: 150, b: 180, c: 250"}
        along, history = self.respond(run, "stations", by_stations)
        other, _ = self.respond(self.force("same", 0.0, Q), "same", LINEAR)
        for column in ("deflection [m]", "bending moment [N m]"):
            numpy.testing.assert_allclose(along[column], other[column], rtol=0,
                                          atol=1e-9 * abs(other[column]).max())
        self.assertEqual(history["time [s]"].tolist(), [0, 5])
        loads = read_csv(run / "pipe" / "loads.csv")
        self.assert_near(float(loads[1]["s = 180 m [N/m]"]), Q, 1e-11)

    def test_plan(self):
        """A route with a bend, in soil that moves east with 4 m/s: only the velocity across the
        route loads the pipe, from the right or the left, on the first leg over soil thinner than
        the pipe; nothing where there is no soil."""
        thickness, mass, speed = (0.3, 2.0), 1500., 4.  # m, kg/m^3, m/s
        # Columns of 10 m: the western half is thin; the last row has none.
        rows, whole = [], 0.
        for column in range(70):
            volume = 100 * thickness[column % 10 > 4]
            whole += volume
            rows.append((column, volume))
        rows = ["0,-1,0,0,0,0,0", *(f"2,{column},{V!r},{mass * V!r},{mass * V * speed!r},0,0"
                                    for column, V in [(-1, whole), *rows])]
        run = self.run_folder("plan")
        (run / "parameters.prm").write_text("set Dimension = 3\n")
        (run / "plan-cells.csv").write_text(
            "west [m],south [m],dx [m],dy [m],columns,rows\n1000,2000,10,10,10,8\n")
        (run / "plan.csv").write_text(
            "time [s],column,volume [m^3],mass [kg],momentum x [N s],momentum y [N s],"
            "momentum z [N s]\n" + "\n".join(rows) + "\n")
        # Northwards through the thin soil, then to the south-east through the thick soil.
        entries = {k: v for k, v in LINEAR.items() if not k.startswith("Load/")} | {
            "Load/Source": "plan", "Load/Route": "1025,2005; 1025,2075; 1095,2005",
            "Load/Drag coefficient": 0.8, "Load/Bearing factor": 10, "Load/Shear strength": 500}
        self.respond(run, "plan", entries)
        loads = read_csv(run / "pipe" / "loads.csv")
        self.assertEqual([row["time [s]"] for row in loads], ["0", "2"])
        found = {float(name[4:-len(" m [N/m]")]): [float(row[name]) for row in loads]
                 for name in loads[0] if name.startswith("s = ")}
        for s, (before, load) in found.items():
            self.assertEqual(before, 0)
            if s < 70:
                pressure = 0.8 * mass * speed**2 / 2 + 10 * 500
                exact = 0.3 * pressure
            else:
                along = (s - 70) / math.sqrt(2)
                pressure = 0.8 * mass * speed**2 / 4 + 10 * 500 / math.sqrt(2)
                exact = (0.6 if along > 25 else 0.3) * -pressure if along < 65 else 0.
            self.assertAlmostEqual(load, exact, delta=1e-9 * abs(exact), msg=f"{s}")

    def test_run(self):
        """A slide of talus on a pipe that is an obstacle."""
        run = self.slide("slide", "End time=1.5", "Obstacles/Names=pipe",
                         "Obstacles/pipe/Shape=ball", "Obstacles/pipe/Centre=47, 1.2",
                         "Obstacles/pipe/Radius=0.6")
        _, history = self.respond(run, "slide", LINEAR)
        obstacles = read_csv(run / "obstacles.csv")
        self.assertEqual(len(obstacles), len(history["time [s]"]))
        self.assert_near(history["load [N]"][-1],
                         B * float(obstacles[-1]["pipe force x [N]"]), 1e-9)


class Refused(PipeCase):
    def refuse(self, run, entries, *parts):
        self.assert_sentence(self.tool("talus-pipe", run, self.parameters("refused", entries)),
                             *parts)

    def test_parameters(self):
        run = self.force("refused", 0.0, Q)
        for change, *parts in (
                ({"Pipe/Diameter": 1}, "'Pipe/Diameter'", "no entry"),
                ({"Length": "long"}, "'Length = long'", "numbers separated by commas"),
                ({"Length": "400, 500"}, "'Length = 400, 500'", "one number"),
                ({"Length": "1e9"}, "20000", "Element size"),
                ({"Pipe/Wall thickness": 0.4}, "'Pipe/Wall thickness = 0.4'"),
                ({"Ends": "loose"}, "'fixed' or 'pinned' or 'free'"),
                ({"Load/Obstacle": "wall"}, "wall force x [N]"),
                ({"Load/Width": 500}, "places from 0 to 'Length' = 400"),
                ({"Load/Source": "stations", "Load/Stations": "a 3"}, "NAME: s"),
                ({"Load/Source": "line", "Load/Line": "a"}, "lines.csv"),
                ({"Load/Lateral resistance in the slide": 2}, "from 0 to 1")):
            self.refuse(run, LINEAR | change, *parts)

    def test_tables(self):
        self.refuse(self.folder, LINEAR, "no parameters.prm")
        self.refuse(self.run_folder("empty"), LINEAR, "no obstacles.csv")
        self.refuse(self.force("nothing", 0.0, 0.0), LINEAR, "zero at all times")
        self.refuse(self.force("endless", 0.0, math.nan), LINEAR, "not a number")

    def test_no_balance(self):
        """Free ends hold nothing: without balance if the load, Q B, is larger than the
        resistance of the soil over 400 m."""
        run = self.force("weak", 0.0, Q)
        free = LINEAR | {"Ends": "free", "Lateral springs/Ultimate resistance": 1e3}
        self.refuse(run, free, "No balance exists", "1.999e+06 N", "4e+05 N", "'Ends = free'")
        self.refuse(run, free | {"Lateral springs/Ultimate resistance": Q * B / 400 * 0.99},
                    "No balance exists")
        # The slide covers the pipe, so that all springs yield together.
        whole = {"Load/Width": 400, "Lateral springs/Ultimate resistance": Q * 1.001}
        self.respond(run, "held", free | whole)

    def test_newton_gives_up(self):
        """Without a proof that nothing holds the pipe the message does not say so."""
        path = self.parameters("gives-up", LINEAR | {
            "Pipe/Axial stiffness": 7e9, "Lateral springs/Ultimate resistance": 1e3})
        one = beam.Beam(Settings(path), numpy.ones_like)
        load = numpy.full_like(one.s_gauss, Q)
        most, beam.MAX_ITERATIONS = beam.MAX_ITERATIONS, 1
        try:
            with self.assertRaises(UserError) as caught:
                one.advance(beam.State(len(one.s)), 0 * load, load)
        finally:
            beam.MAX_ITERATIONS = most
        self.assertIn("Newton's method found no balance beyond 0 %", str(caught.exception))
        self.assertIn("is not known", str(caught.exception))
        state = one.advance(beam.State(len(one.s)), 0 * load, load)
        self.assertGreater(one.axial_force(state.displacement).min(), 0)

    def test_remarks(self):
        """What a result does not cover is said."""
        run = self.force("remarks", 0.0, 50 * Q)
        self.respond(run, "short", LINEAR | {"Length": 110, "Ends": "free"})
        self.assertIn("exceeds the yield stress", self.printed)
        self.assertIn("near an end", self.printed)
        self.respond(run, "held", LINEAR | {"Pipe/Axial stiffness": 7e9})
        self.assertIn("the ends hold 100 % of the axial force", self.printed)


main()
