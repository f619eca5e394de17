"""Pages of `pintle report` driven in headless Chromium by mouse and keys: they show what the tables hold, and nothing goes wrong in them.

usage: test_page.py PINTLE"""

import csv
import math
import os
import shutil
import unittest
from pathlib import Path

from driven import Driven, browser, folder, report, show, source, table

report("worn", "plate", "warned", "events", "sweep")

# What a run leaves that is interrupted after its first row.
shutil.copytree(folder / "worn", folder / "begun")
for file in "trajectory.csv", "ledger.csv":
    (folder / "begun" / file).write_text("".join((folder / "worn" / file).read_text().splitlines(True)[:2]))
show("begun")


class Transport(Driven):
    def test_plays_and_pauses_by_its_button_and_by_a_key(self):
        self.open("worn")
        browser.get("page.clock.seconds = 1e4")  # so that a slow machine does not reach the end
        for press in (lambda: browser.click("#play"), lambda: browser.key(" ")):
            begin = browser.get("page.clock.time")
            press()
            browser.wait(f"page.clock.time > {begin}")
            press()
            time = browser.get("page.clock.time")
            self.assertEqual(browser.get("[page.clock.playing, page.clock.time]"), [False, time])
            self.expect_values_of("worn")

    def test_the_slider_goes_to_a_time(self):
        self.open("worn")
        for share in (0.37, 0.71):
            browser.click(browser.place("#scrub", share))
            time, end = browser.get("[page.clock.time, page.clock.end]")
            self.assertAlmostEqual(time / end, share, delta=0.02)  # the thumb's middle stays 8 of some 500 px from the ends
            self.assertEqual(browser.get("byId('clock').textContent"), f"{1e3 * time:.3f} ms")
            self.expect_values_of("worn")

    def test_the_speed_is_the_chosen_one(self):
        self.open("worn")
        browser.get("byId('speed').focus()")
        browser.key("ArrowDown")
        self.assertEqual(browser.get("[page.clock.seconds, Number(byId('speed').value)]"), [16, 16])

    def test_steps_go_to_rows_and_to_impacts(self):
        self.open("worn")
        impacts = [float(row.split(",")[1]) for row in (folder / "worn/events.csv").read_text().splitlines()[1:]]
        self.assertGreater(len(impacts), 2)
        for time in impacts[:3]:
            browser.key("n")
            self.assertEqual(browser.get("page.clock.time"), time)
            self.expect_values_of("worn")
        browser.key("p")
        self.assertEqual(browser.get("page.clock.time"), impacts[1])
        browser.key("Home")
        browser.key("ArrowRight")
        self.assertEqual(browser.get("page.clock.time"), browser.get("page.clock.t[1]"))

    def test_rows_of_impacts_take_the_keyboard_and_let_it_go(self):
        self.open("worn")
        browser.get("document.querySelector('#impact-table tbody tr').focus()")
        browser.key("Tab")
        self.assertEqual(browser.get("document.activeElement.rowIndex"), 2)
        browser.key("Enter")
        self.assertEqual(browser.get("page.clock.time"), browser.get("page.clock.events[1]"))


class View(Driven):
    def test_the_wheel_zooms_about_the_pointer(self):
        self.open("worn")
        at = browser.place("#canvas", 0.25, 0.6)
        under = "(b => page.stage.toWorld(%r - b.left, %r - b.top))(byId('canvas').getBoundingClientRect())" % at
        scale, before = browser.get("page.stage.scale"), browser.get(under)
        browser.mouse("Wheel", at, deltaX=0, deltaY=-200)
        browser.wait(f"page.stage.scale > {scale}")
        after = browser.get(under)
        self.assertAlmostEqual(browser.get("page.stage.scale") / scale, math.exp(0.3), delta=1e-9)
        for axis in "xy":
            self.assertAlmostEqual(after[axis], before[axis], delta=1.5 / scale)  # offsetX is whole

    def test_follows_a_body(self):
        self.open("worn")
        browser.get("byId('follow').focus()")
        browser.key("ArrowDown")
        self.assertEqual(browser.get("byId('follow').selectedOptions[0].textContent"), "crank")
        middle = browser.get("page.stage.px(page.stage.now[0])")
        browser.click(browser.place("#scrub", 0.4))
        self.assertEqual(browser.get("page.stage.px(page.stage.now[0])"), middle)
        browser.click(browser.place("#canvas", 0.1, 0.1))
        browser.key("0")
        self.assertEqual(browser.get("[page.stage.followed, Number(byId('follow').value), page.stage.fitted]"), [-1, -1, True])

    def test_sliders_enlarge_clearance_and_deformation(self):
        for name, id, field in ("worn", "clearance", "exaggeration"), ("plate", "deformation", "deformation"):
            self.open(name)
            before = browser.get(f"page.stage.{field}")
            browser.click(browser.place("#" + id, 0.98))
            after = browser.get(f"page.stage.{field}")
            self.assertGreater(after, before)
            self.assertEqual(browser.get(f"byId('{id}').nextElementSibling.textContent"), browser.get(f"`× ${{plain({after}, 3)}}`"))

    def test_colours_of_stress_reach_to_the_greatest_of_all_rows(self):
        self.open("plate")
        browser.click("#show-stress")
        greatest = browser.get("Math.max(...Array.from(page.motion.t, (_, row) => "
                               "page.stage.meshes[1].stress(page.motion.bodies[1].modes.map((values) => values[row]))))")
        self.assertGreater(greatest, 0)
        self.assertEqual(browser.get("page.stage.greatestStress"), greatest)
        self.assertEqual(browser.get("byId('colour-most').textContent"), browser.get(f"engineering({greatest}, 'Pa', 3)"))

    def test_a_click_on_a_joint_or_a_body_lists_its_columns(self):
        joint = "page.stage.px(page.stage.motion.place(page.stage.model.%s.b, page.stage.now))"
        between = "page.stage.px(page.stage.motion.place(page.stage.model.joints[%d].b, page.stage.now))"
        for run, mobile, place, name in (("worn", False, joint % "contacts[0]", "gudgeon pin"), ("worn", False, joint % "joints[1]", "crank pin"),
                                         ("worn", False, "page.stage.px(page.stage.now[1])", "coupler"),
                                         ("plate", True, f"((a, b) => [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2])({between % 1}, {between % 2})", "coupler"),
                                         ("plate", True, joint % "joints[3]", "D")):
            with self.subTest(name):
                self.open(run, *((390, 844) if mobile else ()), mobile=mobile)
                browser.click(browser.place("#scrub", 0.3))
                plots = browser.get("page.panels.length")
                left, top = browser.place("#canvas", 0, 0)
                x, y = browser.get(place)
                browser.click((left + x, top + y))
                listed = browser.get("[...document.querySelectorAll('#picker-list button')].map((one) => one.firstChild.textContent)")
                self.assertEqual(listed, [column for file in ("trajectory", "ledger") for column in table(f"{run}/{file}.csv")[0]
                                          if column.startswith(name + ".")])
                browser.click("#picker-list button")
                self.assertEqual(browser.get("[page.panels.length, page.panels.at(-1).names]"), [plots + 1, listed[:1]])

    def test_a_drag_of_the_picture_or_a_click_beside_it_lists_none(self):
        self.open("worn")
        x, y = browser.get("page.stage.px(page.stage.now[1])")
        left, top = browser.place("#canvas", 0, 0)
        centre = browser.get("page.stage.centre.x")
        browser.drag((left + x, top + y), (left + x + 50, top + y))
        self.assertLess(browser.get("page.stage.centre.x"), centre)
        browser.click((left + 20, top + 60))
        self.assertFalse(browser.get("byId('picker').open"))


class Forces(Driven):
    drawn = """((time) => {
      const arrows = [], couples = [], texts = [], names = {drawArrow, drawCouple, write};
      page.clock.set(time);
      drawArrow = (stage, ...one) => (arrows.push(one), names.drawArrow(stage, ...one));
      drawCouple = (stage, ...one) => (couples.push(one), names.drawCouple(stage, ...one));
      write = (stage, text, ...more) => (texts.push(text), names.write(stage, text, ...more));
      page.stage.draw(time);
      ({drawArrow, drawCouple, write} = names);
      return {arrows, couples, texts, width: page.stage.width, height: page.stage.height};
    })"""

    def test_arrows_and_arcs_are_as_long_as_the_scale_says(self):
        self.open("plate")
        names, rows = table("plate/trajectory.csv")
        for row in rows[100], rows[700]:
            now = dict(zip(names, row))
            drawn = browser.get(f"{self.drawn}({row[0]!r})")
            *arrows, scale = drawn["arrows"]
            couple, unit = drawn["couples"]
            force_text, couple_text = (next(t for t in drawn["texts"] if t.endswith(end)) for end in (" N", " N m"))
            newton, newton_metre = scale[3] / float(force_text.split()[0]), unit[1] / float(couple_text.split()[0])
            sizes = [math.hypot(now[f"{joint} on {body}"], now[f"{joint.replace('fx', 'fy')} on {body}"])
                     for joint, body in (("A.fx", "crank"), ("B.fx", "coupler"), ("C.fx", "rocker"), ("D.fx", "rocker"))]
            self.assertEqual(len(arrows), 4)
            for (_, ux, uy, length, colour), size in zip(arrows, sizes):
                self.assertAlmostEqual(length, newton * size, delta=1e-9 * length)
            self.assertAlmostEqual(couple[1], newton_metre * now["motor.torque on crank"], delta=1e-9 * abs(couple[1]))
            self.assertIn("→ joint", drawn["texts"])

    def test_a_couple_of_rounding_is_none(self):
        self.open("worn")  # of the guide, 1e-17 N m
        self.assertEqual(browser.get("page.stage.usualCouple"), 0)

    def test_no_arrow_leaves_the_picture_of_a_phone(self):
        self.open("plate", 390, mobile=True)
        browser.get("(byId('arrows').value = 2, byId('arrows').dispatchEvent(new Event('input')))")
        for share in range(0, 51):
            ends = browser.get("""(() => {
              const ends = [], plain = arrowHead;
              arrowHead = (stage, ...one) => (ends.push(one.slice(0, 2)), plain(stage, ...one));
              page.stage.draw(%r);
              arrowHead = plain;
              return ends.map(([x, y]) => [x / page.stage.width, y / page.stage.height]);
            })()""" % (1e-3 * share))
            for x, y in ends:
                self.assertTrue(0 <= x <= 1 and 0 <= y <= 1, (x, y))


class Plots(Driven):
    def test_all_outputs_come_first_and_rounding_not_at_all(self):
        self.open("worn")
        plots = browser.get("""(() => {
          const columns = new Map([["a", "m", [0, 1]], ["b", "N", [0, 0]], ["c", "m", [0, 2]], ["d", "rad", [0, 3]], ["e", "", [5, 5]],
                                   ["pin.fx on rod", "N", [1e-27, -1e-27]], ["pin.fy on rod", "N", [981e3, 981e3]], ["rod.vx", "m/s", [0, 1e-12]],
                                   ["rod.vy", "m/s", [0, 1]]].map(([name, unit, y]) => [name, {name, unit, y}]));
          const model = {outputs: ["a", "b", "c", "d", "e"], contacts: [], forces: [], joints: [{name: "pin", on: "rod"}], bodies: [{name: "rod"}]};
          return firstPlots(model, {columns}).map(({names}) => names);
        })()""")
        self.assertEqual(plots, [["a", "b", "c"], ["d", "e"], ["rod.vy"]])

    def test_a_drag_zooms_all_and_two_clicks_show_all_again(self):
        self.open("worn")
        ranges = "[...page.panels.filter((panel) => !panel.against), page.ledger].map(({plot}) => [plot.scales.x.min, plot.scales.x.max])"
        whole = browser.get(ranges)
        browser.drag(browser.place("#panels .u-over", 0.3), browser.place("#panels .u-over", 0.6))
        zoomed = browser.get(ranges)
        self.assertEqual(len({tuple(r) for r in zoomed}), 1)
        for got, wanted in zip(zoomed[0], (0.3, 0.6)):
            self.assertAlmostEqual(got / whole[0][1], wanted, delta=5e-3)
        browser.click("#panels .u-over", 2)
        self.assertEqual(browser.get(ranges), whole)

    def test_a_click_at_a_peak_takes_the_peak(self):
        self.open("worn")
        names, rows = table("worn/trajectory.csv")
        column = names.index("gudgeon pin.normal")
        highest = max(rows, key=lambda row: row[column])
        left, top = browser.place("#panels .u-over", 0, 0)
        at = browser.get("(({plot, shown}) => [plot.valToPos(%r, 'x'), plot.valToPos(%r, 'y N')])(page.panels[0])" % (highest[0], highest[column]))
        for off in (0, 2, 4):
            browser.key("End")
            browser.click((left + at[0] + off, top + at[1] + 2))
            self.assertEqual(browser.get("page.clock.time"), highest[0])
        # far from a curve it is the time under the pointer
        browser.click((left + at[0] + 100, top + at[1] + 2))
        self.assertAlmostEqual(browser.get("page.panels[0].plot.valToPos(page.clock.time, 'x')"), at[0] + 100, delta=1)

    def test_a_column_against_another_is_of_rows_of_the_table(self):
        self.open("worn")
        names, rows = table("worn/trajectory.csv")
        by_time = {row[0]: row for row in rows}
        self.assertFalse(browser.get("page.table.whole"))
        self.assertEqual(browser.get("page.panels.filter((panel) => panel.against).map((panel) => [panel.against, ...panel.names])"),
                         [["gudgeon pin.ex", "gudgeon pin.ey"], ["gudgeon pin.fx on slider", "gudgeon pin.fy on slider"]])
        browser.get("(page.addPlot(['gudgeon pin.sliding', 'coupler.alpha'], 'slider.vx').draw(), page.addPlot(['gudgeon pin.normal'], 'gudgeon pin.depth').draw())")
        plots = browser.get("page.panels.filter((panel) => panel.against).flatMap(({against, names, pairs}) =>"
                            "pairs.map(({t, x, y}, i) => [against, names[i], [...t], [...x], [...y]]))")
        self.assertEqual(len(plots), 5)
        for across, up, *pairs in plots:
            self.assertGreater(len(pairs[0]), 1000 if "gudgeon pin.sliding" != up and "coupler.alpha" != up else 10)
            for t, x, y in zip(*pairs):
                self.assertEqual([x, y], [by_time[t][names.index(across)], by_time[t][names.index(up)]], f"{up} against {across} at {t}")

    def test_a_gap_reaches_from_value_to_value(self):
        self.open("worn")
        gap = browser.get("joined([{t: [0, 1, 4], y: [5, NaN, 6]}, {t: [0, 2, 3, 4], y: [7, 8, 9, 7]}])[1].map((y) => (y === undefined ? 'bridged' : y))")
        self.assertEqual(gap, [5, None, None, None, 6])

    def test_axes_of_a_column_against_another_are_their_own(self):
        self.open("plate")
        axes = browser.get("""(() => {
          const panel = page.addPlot(["crank.speed", "A.fx on crank"], "crank.angle");
          panel.draw();
          return panel.plot.axes.map((axis) => axis.label(panel.plot)).concat(panel.plot.axes.map((axis) => axis.scale));
        })()""")
        self.assertEqual(axes, ["crank.angle [rad]", "crank.speed [rad/s]", "A.fx on crank [N]", "x", "y rad/s", "y N"])

    def test_columns_of_both_tables_are_picked_by_parts_of_their_names(self):
        self.open("worn")
        for part, name in (("der.x", "slider.x"), ("lost hyst", "gudgeon pin.lost to hysteresis")):
            browser.click("#panels .panel:first-child .tools button:nth-child(2)")
            browser.type(part)
            browser.key("Enter")
            self.assertEqual(browser.get("page.panels[0].names.at(-1)"), name)
        browser.click(browser.place("#scrub", 0.5))
        self.expect_values_of("worn")

    def test_the_ledger_closes(self):
        """Its highest area is the sum of the table's entries; what it lacks of the dashed line is the unexplained energy."""
        for name in "worn", "plate":
            self.open(name)
            names, rows = table(f"{name}/ledger.csv")
            by_time = {row[0]: row for row in rows}
            t, top, line, lifted = browser.get("(({plot, parts}) => [plot.data[0], plot.data[1], plot.data.at(-1), ledgerStack(parts).lifted].map("
                                               "(x) => x.length ? [...x] : x))(page.ledger)")
            self.assertGreater(len(t), 100)
            for time, high, wanted in zip(t, top, line):
                row = by_time[time]
                parts = [x for x, column in zip(row, names) if column not in ("t", "stored", "unexplained") and not column.endswith(".work in")]
                rounding = 2**-52 * len(row) * (abs(lifted) + sum(map(abs, row[1:])) + abs(high) + sum(map(abs, rows[0][1:])))
                self.assertAlmostEqual(high, lifted + math.fsum(parts), delta=rounding)
                self.assertAlmostEqual(wanted - high, -row[names.index("unexplained")], delta=2 * rounding)


class Errors(unittest.TestCase):
    def test_are_kept_by_the_page_and_told_to_the_browser(self):
        browser.screen(1400, 1000)
        browser.open(folder / "sweep/report.html")
        browser.get("(console.error('first', 1), Promise.reject(new Error('second')), setTimeout(() => { throw new Error('third'); }), 0)")
        browser.wait("errors.length > 2")
        self.assertEqual(sorted(browser.get("errors")), ["Uncaught Error: third", "first 1", "unhandled: Error: second"])
        self.assertEqual(len(browser.troubles()), 3)


class Notice(unittest.TestCase):
    def test_the_licence_of_the_plots_library_is_in_the_page(self):
        licence = source / "app/report/vendor/uplot/LICENSE"
        self.assertIn(licence.read_text(), (folder / "sweep/report.html").read_text())


class Study(Driven):
    def test_the_table_is_the_tables_without_empty_columns(self):
        self.open("sweep")
        with open(folder / "sweep/sweep.csv", newline="") as text:
            names, *rows = zip(*(column for column in zip(*csv.reader(text)) if any(column[1:])))
        self.assertNotIn("reason", names)
        self.assertEqual(browser.get("page.columns.map(({name}) => name)"), [name.partition(" [")[0] for name in names])
        shown = browser.get("[...document.querySelectorAll('#study-table tbody tr')].map((row) => [...row.cells].map((cell) => cell.title))")
        self.assertEqual(len(shown), len(rows))
        for got, wanted in zip(shown, rows):
            for a, b in zip(got, wanted):
                self.assertTrue(a == b or float(a) == float(b), (a, b))

    def test_each_axis_keeps_its_choices_together(self):
        self.open("sweep", 390, mobile=True)
        across, up = (browser.get(f"byId('study-{axis}').parentElement.getBoundingClientRect().left") for axis in "xy")
        self.assertEqual(across, up)

    def test_a_band_on_an_axis_keeps_the_rows_that_cross_it(self):
        self.open("sweep")
        browser.drag(browser.place("#study-parallel .handle", y=0.4), browser.place("#study-parallel .handle", y=0.02))
        speeds = browser.get("[...document.querySelectorAll('#study-table tbody tr')].map((row) => Number(row.cells[1].title))")
        self.assertEqual(speeds, [150, 200])
        browser.click("#study-clear")
        self.assertEqual(browser.get("document.querySelectorAll('#study-table tbody tr').length"), 4)


class OneRow(Driven):
    def test_is_said_and_its_values_are_listed(self):
        self.open("begun")
        self.assertIn("one row, at 0 s: its values are below", browser.get("byId('summary').textContent"))
        self.assertEqual(browser.get("[byId('plots').hidden, byId('ledger').hidden, byId('transport').hidden]"), [True] * 3)
        for index, file in enumerate(("trajectory", "ledger")):
            names, (row,) = table(f"begun/{file}.csv")
            browser.get(f"((byId('study-table-name').value = {index}), byId('study-table-name').onchange())")
            shown = browser.get("[...byId('study-table').tBodies[0].rows].map((row) => [...row.cells].map(({title}) => title))")
            self.assertEqual({name.partition(" [")[0]: float(value) for name, value in shown},
                             {name: value for name, value in zip(names[1:], row[1:]) if not math.isnan(value)})


class Screens(Driven):
    def test_words_in_the_tables_of_facts_stay_whole(self):
        for width, mobile in (1400, False), (390, True):
            self.open("plate", width, mobile=mobile)
            lines = browser.get("""[...document.querySelectorAll('#facts th, #facts td > span')].map((cell) => {
              const range = document.createRange();
              range.selectNodeContents(cell);
              const tops = new Set([...range.getClientRects()].map((r) => Math.round(r.top)));
              return [cell.textContent, tops.size];
            })""")
            self.assertGreater(len(lines), 10)
            for text, count in lines:
                self.assertLessEqual(count, max(1, len(text.split())), text)

    def test_buttons_of_a_plot_stay_whole_beside_a_long_name(self):
        self.open("worn", 1240)
        cut = browser.get("[...document.querySelectorAll('.tools button:not(:first-child)')].filter((one) => one.scrollWidth > one.clientWidth).length")
        self.assertEqual(cut, 0)

    def test_warnings_are_whole_on_a_phone(self):
        self.open("warned", 390, 844, mobile=True)
        high, seen = browser.get("[byId('warnings').scrollHeight, byId('warnings').clientHeight]")
        self.assertEqual(high, seen)

    def test_names_of_events_stand_right_of_their_lines(self):
        self.open("events")
        names = browser.get("""(() => {
          const written = [], plain = CanvasRenderingContext2D.prototype.fillText;
          CanvasRenderingContext2D.prototype.fillText = function(...words) {
            if (words[0] === "trip") written.push(this.textAlign);
            return plain.apply(this, words);
          };
          page.panels.forEach((panel) => panel.draw());
          return new Promise((done) => setTimeout(() => (CanvasRenderingContext2D.prototype.fillText = plain, done(written))));
        })()""")
        self.assertEqual(set(names), {"left"})

    def test_no_page_is_wider_than_its_window(self):
        for name, schemes in ("worn", ("light", "dark")), ("warned", ("light",)), ("plate", ("light",)), ("sweep", ("dark",)):
            for scheme in schemes:
                for width, height, mobile in (1400, 1000, False), (1020, 760, False), (390, 844, True):
                    with self.subTest(page=name, scheme=scheme, width=width):
                        self.open(name, width, height, scheme=scheme, mobile=mobile)
                        self.assertLessEqual(browser.get("document.documentElement.scrollWidth"), width)
                        if "PINTLE_PICTURES" in os.environ:  # to look at
                            browser.picture(Path(os.environ["PINTLE_PICTURES"]) / f"{name}_{scheme}_{width}.png")


if __name__ == "__main__":
    unittest.main()
