"""Pages of `pintle report` that show no run, driven in headless Chromium: equilibria, modes, static cases, sweeps.

usage: test_other_pages.py PINTLE"""

import csv
import json
import math
import unittest

from driven import Driven, browser, folder, report, show, table

(folder / "upright.yaml").write_text("""
gravity: [0, -9.81]
bodies: {rod: {rigid: {mass: 1 kg, inertia: 0.1}, points: {O: [0, -1]}, pose: {at: [0, 1]}}}
joints: {hinge: {revolute: [ground, rod.O]}}
""")
(folder / "free.yaml").write_text("""
materials: {steel: {young: 207 GPa, poisson: 0.3, density: 7850 kg/m^3}}
bodies: {bar: {beam: {through: [a, b], section: {rectangle: [1 mm, 25 mm]}, material: steel, elements: 8}, points: {a: [0, 0], b: [0.3, 0]}}}
""")
report("modes", "rest", "shapes", "loaded", "upright", "free", "heavy", "frozen")

# Cases of a sweep with warnings, and one that was stopped.
for name, file in ("doubted", "sweep.csv"), ("stopped", "sweep-so-far.csv"):
    (folder / name).mkdir()
    (folder / name / file).write_text("case,speed [m/s],peak [N],status\n1,1,3,finished\n2,2,,refused\n")
(folder / "doubted/sweep.json").write_text('{"title": "Doubted"}')
(folder / "doubted/warnings.csv").write_text('case,warning\n1,"steep, at 3 s"\n2,loose\n2,"steep, at 3 s"\n2,loose\n')

# A study of basins: its plane of starts comes first.
(folder / "basins").mkdir()
(folder / "basins/section.csv").write_text("x0 [m],v0 [m/s],return,t [s],x [m]\n0,0,1,1,1\n0,1,1,1,2\n1,0,1,1,1\n")
(folder / "basins/values.csv").write_text("x0 [m],v0 [m/s],status,attractor,returns\n0,0,finished,1,1\n0,1,finished,2,1\n1,0,finished,1,1\n")
(folder / "basins/nonlinear.json").write_text(json.dumps({"title": "Two wells", "varied": ["x0 [m]", "v0 [m/s]"], "recorded": ["x [m]"], "attractors": []}))
show("doubted", "stopped", "basins")


class OtherResults(Driven):
    def test_the_chosen_mode_moves_as_its_table_says(self):
        self.open("modes")
        names, rows = table("modes/mode_motions.csv")
        for mode in 1, 3:
            browser.get(f"((byId('mode').selectedIndex = {mode - 1}), byId('mode').onchange())")
            browser.click("#step-on")
            row = [row for row in rows if row[0] == mode][1]
            shown = browser.get("page.stage.now[1]")
            self.assertEqual(shown["angle"], row[names.index("coupler.angle")])
            self.assertEqual(shown["eta"], row[names.index("coupler.mode 1"):][:len(shown["eta"])])
            self.assertEqual(browser.get("byId('clock').textContent"), "phase 15°")
            browser.click("#play")
            browser.wait("page.clock.time < page.clock.begin + 0.03")  # round again
            browser.click("#play")
        self.assertEqual(browser.get("page.data.tables[0].file"), "linearized.csv")

    def test_an_equilibrium_is_drawn_with_its_forces_and_values(self):
        self.open("rest")
        with open(folder / "rest/statics.csv", newline="") as text:
            held = dict(list(csv.reader(text))[1:])
        self.assertEqual(browser.get("page.stage.now[0].angle"), float(held["chassis.angle [rad]"]))
        arrows = browser.get("page.motion.forces(0, page.stage.now).filter(({name}) => name === 'left coil').map(({force}) => force)")
        self.assertEqual([arrows[0]["x"], arrows[0]["y"]], [float(held[f"left coil.f{axis} on left lower arm [N]"]) for axis in "xy"])
        self.assertEqual(browser.get("[byId('transport').hidden, byId('plots').hidden]"), [True, True])
        shown = browser.get("[...byId('study-table').tBodies[0].rows].map((row) => [...row.cells].map(({title}) => title))")
        self.assertEqual({name: float(value) for name, value in shown}, {name: float(value) for name, value in held.items()})

    def test_a_mode_of_a_cantilever_crosses_it_as_often_as_beams_do(self):
        self.open("shapes")
        for mode in range(1, 7):
            browser.get(f"((byId('mode').selectedIndex = {mode - 1}), byId('mode').onchange())")
            x, y = browser.get("(({points, world}) => [Array.from(points), Array.from(world, (w, i) => w - points[i])])"
                               "((page.stage.draw(page.clock.time), page.stage.meshes[0]))")
            along = sorted((x[i], y[i + 1]) for i in range(0, len(x), 2))
            crossings = sum((a > 0) != (b > 0) for (_, a), (_, b) in zip(along, along[1:]) if min(abs(a), abs(b)) > 1e-5)
            self.assertEqual(crossings, mode - 1)
            self.assertAlmostEqual(max(math.hypot(*y[i:i + 2]) for i in range(0, len(y), 2)) / browser.get("page.stage.model.length"), 0.1, places=3)

    def test_a_static_case_is_bent_and_coloured_as_its_results_say(self):
        self.open("loaded")
        held = json.loads((folder / "loaded/static.json").read_text())
        for mine, value in (("Stress", held["greatest von Mises stress"]["value [Pa]"]), ("Deflection", held["greatest displacement"]["value [m]"])):
            self.assertAlmostEqual(browser.get(f"page.stage.greatest{mine}") / value, 1, places=5)
        self.assertGreater(browser.get("page.stage.deformation"), 1)
        self.assertEqual(browser.get("byId('colour-most').textContent"), "33.2 MPa")

    def test_stress_between_the_nodes_of_a_beam_is_that_of_the_results(self):
        self.open("heavy")  # by its weight
        held = json.loads((folder / "heavy/static.json").read_text())["greatest von Mises stress"]["value [Pa]"]
        self.assertAlmostEqual(browser.get("page.stage.greatestStress") / held, 1, places=6)

    def test_masses_of_rounding_are_none(self):
        self.open("free")
        names, rows = table("free/modes.csv")
        shown = browser.get("[...byId('study-table').tBodies[0].rows].map((row) => [...row.cells].map((cell) => [cell.textContent, cell.title]))")
        self.assertEqual([[float(title) for _, title in row] for row in shown], rows)
        for name in "effective mass x", "effective mass y", "effective inertia", "share x", "share y", "share rotation":
            self.assertEqual({row[names.index(name)][0] for row in shown}, {"0"}, name)
        self.assertEqual(browser.get("byId('title').textContent"), "bar")
        self.assertNotIn("effective mass", browser.get("byId('facts').textContent"))

    def test_no_stress_is_held_that_is_not_shown(self):
        self.assertNotIn("stresses", json.loads((folder / "shapes/drawing.json").read_text())["mesh"])

    def test_what_there_is_none_of_is_not_offered(self):
        self.open("frozen")  # a worn pin, of whose clearance modes tell nothing
        self.assertEqual(browser.get("[byId('show-forces').parentElement, byId('clearance-option')].map(({hidden}) => hidden)"), [True, True])
        self.assertEqual(browser.get("""(() => {
            const written = [], plain = write;
            write = (stage, text, ...more) => (written.push(text), plain(stage, text, ...more));
            page.stage.draw(0);
            write = plain;
            return written.filter((text) => text.includes("clearance"));
        })()"""), [])
        self.open("rest")
        self.assertEqual(browser.get("[byId('show-forces').checked, byId('show-forces').parentElement.hidden]"), [True, False])

    def test_colours_change_within_a_triangle(self):
        self.open("loaded")
        light = browser.get("""(() => {
            const context = Object.assign(document.createElement("canvas"), {width: 100, height: 100}).getContext("2d", {willReadFrequently: true});
            fillByStress({context, greatestStress: 1}, {triangles: [0, 1, 2], mises: [0, 0, 1]}, [0, 0, 100, 0, 0, 100]);
            return [[30, 3], [3, 50], [3, 90]].map(([x, y]) => context.getImageData(x, y, 1, 1).data.slice(0, 3).reduce((a, b) => a + b));
        })()""")
        self.assertTrue(light[0] + 60 < light[1] < light[2] - 60, light)

    def test_what_does_not_rest_stably_says_so_at_the_top(self):
        self.open("upright")
        self.assertEqual(browser.get("byId('summary').textContent.split(' · ')[0]"), "unstable in 1 direction")
        self.assertTrue(browser.get("byId('summary').classList.contains('trouble')"))

    def test_warnings_of_cases_are_listed_once_with_their_number(self):
        self.open("doubted")
        self.assertEqual(browser.get("[...byId('warnings').children].map((one) => one.textContent)"),
                         ["2 cases, the first is case 1: steep, at 3 s", "case 2: loose"])

    def test_of_a_stopped_sweep_the_cases_so_far_are_there(self):
        self.open("stopped")
        self.assertEqual(browser.get("byId('summary').textContent"),
                         "the sweep has not ended: 2 cases so far; the command of the sweep continues it")
        self.assertTrue(browser.get("byId('summary').classList.contains('trouble')"))
        self.assertEqual(browser.get("[...byId('study-table').tBodies[0].rows].map((row) => row.cells[2].title)"), ["3", ""])

    def test_of_basins_shows_the_plane_of_starts_first(self):
        self.open("basins")
        self.assertEqual(browser.get("page.data.tables.map(({file}) => file)"), ["values.csv", "section.csv"])
        self.assertEqual(browser.get("[page.x.name, page.y.name, page.colour.name]"), ["x0", "v0", "attractor"])


if __name__ == "__main__":
    unittest.main()
