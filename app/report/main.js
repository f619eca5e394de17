"use strict";

// The page put together.

/// In their order, at most four columns and two units a plot.
function inPlots(names, table) {
  const out = [];
  for (const name of names) {
    const last = out.at(-1)?.names ?? [];
    const units = new Set([...last, name].map((one) => table.columns.get(one).unit));
    if (last.length > 0 && last.length < 4 && units.size <= 2)
      last.push(name);
    else
      out.push({names: [name]});
  }
  return out;
}

/// Columns that a first look should show: the scene's own outputs, all of them; what happens in clearances and contacts, else joint
/// forces, a joint's orbit and the polar of its force, and how the mechanism moves.
function firstPlots(model, table) {
  const known = (names) => names.filter((name) => table.columns.has(name));
  const greatest = new Map();  // of each unit: what is far below it is rounding
  for (const {unit, y} of table.columns.values()) greatest.set(unit, Math.max(greatest.get(unit) ?? 0, ...rangeOf(y).map(Math.abs)));
  const varies = (name) => {
    const {unit, y} = table.columns.get(name);
    const [least, most] = rangeOf(y);
    return most - least > 1e-9 * greatest.get(unit);
  };
  const outputs = inPlots(known(model.outputs), table);
  const out = [];
  const [clearance] = model.contacts.filter((c) => c.radius);
  const contacts = model.contacts.map(({name}) => name);
  const normal = known(contacts.map((name) => `${name}.normal`)).filter(varies).slice(0, 4);
  const joints = model.joints.flatMap(({name, on}) => [`${name}.fx on ${on}`, `${name}.fy on ${on}`, `${name}.torque on ${on}`]);
  const springs = model.forces.flatMap(({name, on}) => [`${name}.fx on ${on}`, `${name}.fy on ${on}`]);
  const motion = known(model.bodies.flatMap(({name}) => [`${name}.vx`, `${name}.vy`, `${name}.speed`])).filter(varies);
  if (normal.length > 0)
    out.push({names: normal});
  else
    out.push({names: known([...joints, ...springs]).filter(varies).slice(0, 2)});
  if (clearance && known([`${clearance.name}.ex`, `${clearance.name}.ey`]).filter(varies).length === 2)
    out.push({names: [`${clearance.name}.ey`], against: `${clearance.name}.ex`});
  const polar = [...(clearance ? [clearance] : []), ...model.joints].map(({name, on}) => [`${name}.fx on ${on}`, `${name}.fy on ${on}`])
                    .find((pair) => known(pair).filter(varies).length === 2);
  if (polar) out.push({names: [polar[1]], against: polar[0]});
  const [stress] = [...table.columns.keys()].filter((name) => /\.(stress|von Mises|uy)$/.test(name) && varies(name));
  if (stress) out.push({names: [stress]});
  out.push({names: motion.slice(-2)});
  return [...outputs, ...out.filter(({names}) => names.length > 0)].slice(0, Math.max(4, outputs.length));
}

/// The values of a table of one row, below each other.
function asValues(file, columns) {
  const rows = [...columns.values()].map(({name, unit, y}) => [unit ? `${name} [${unit}]` : name, Number.isNaN(y[0]) ? null : y[0]]);
  return {file, rows, all: rows.length, noun: "values", columns: ["quantity", "value"].map((name) => ({name, unit: ""}))};
}

class Page {
  constructor(data) {
    this.data = data;
    this.table = readTable(data.trajectory);
    const events = data.events?.rows ?? [];
    const {t} = this.table.poses;
    this.clock = data.modes ? new ModeClock(t) : new Clock(t, events.map((row) => row[1]), data.actions?.rows ?? []);
    this.motion = new Motion(data.model, this.table.poses);
    this.stage = new Stage(byId("canvas"), this.motion);
    this.events = data.events ? new EventTable(this.clock, data.events, "impact", "strongest") : null;
    this.actions = data.actions ? new EventTable(this.clock, data.actions, "action", "first") : null;
    this.panels = [];
    this.stage.show.stress = t.length === 1 && this.stage.meshes.some((mesh) => mesh);
    this.overTime = t.length > 1 && !data.modes;  // else there is nothing to plot
    this.onlyRow = t.length === 1 && !data.tables ? t[0] : null;
    if (this.onlyRow !== null) data.tables = [asValues("trajectory.csv", this.table.columns)];
    if (this.overTime)
      for (const {names, against} of firstPlots(data.model, this.table)) this.addPlot(names, against);
    if (!(data.ledger?.rows > 0)) return;
    const ledger = readTable(data.ledger);
    if (!this.overTime) return void data.tables?.push(asValues("ledger.csv", ledger.columns));
    this.ledger = new LedgerPanel(this.clock, ledger, data.run);
    for (const [name, column] of ledger.columns)
      if (!this.table.columns.has(name)) this.table.columns.set(name, column);
  }

  start() {
    showHead(this.data.title, this.data.run, this.onlyRow);
    showFacts(this.data.run);
    byId("decimation").textContent = this.table.whole ?
        `All ${this.table.rows} rows of trajectory.csv.` :
        `${this.table.rows} rows of trajectory.csv: for each short stretch, the least and greatest values of every column.`;
    byId("add-plot").onclick = () => pickColumn("Plot a column", this.table.columns, (name) => this.addPlot([name]).draw());
    byId("plots").hidden = !this.overTime;
    byId("transport").hidden = byId("speed").parentElement.hidden = this.table.poses.t.length < 2;
    if (this.data.modes) listModes(this.clock, this.data.modes);
    if (this.data.tables) new StudyPage(this.data).show();
    listenToTransport(this);
    listenToOptions(this);
    listenToPointer(this);
    listenToKeys(this);
    this.clock.listen(() => this.redraw());
    window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.drawAll());
    new ResizeObserver(() => this.resize()).observe(document.body);
    this.drawAll();
  }

  addPlot(names, against = null) {
    const panel = new PlotPanel(this.clock, this.table, names, against);
    panel.onclose = () => {
      panel.plot?.destroy();
      panel.root.remove();
      this.panels.splice(this.panels.indexOf(panel), 1);
    };
    this.panels.push(panel);
    byId("panels").append(panel.root);
    return panel;
  }

  /// Lets one choose among the columns of a joint, a clearance or a body.
  plotOf(name) {
    const columns = new Map([...this.table.columns].filter(([column]) => column.startsWith(`${name}.`)));
    if (columns.size > 0) pickColumn(`Plot a column of ${name}`, columns, (column) => this.addPlot([column]).draw());
  }

  drawAll() {
    this.stage.colours = palette(this.data.model.palette);
    for (const panel of [...this.panels, this.ledger]) panel?.draw();
    this.resize();
  }

  resize() {
    this.stage.resize();
    for (const panel of [...this.panels, this.ledger]) panel?.resize();
    drawScrubMarks(this.clock);
    this.clock.tell();
  }

  /// Once a frame, however often it is asked for.
  redraw() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.stage.happening = happeningAt(this.clock);
      this.stage.draw(this.clock.time);
    });
  }
}

/// With #check in its address the page tells what it shows, for tests to compare: values at some rows, errors.
function reportShown(page) {
  if (!page.clock) return tellShown([]);
  const {clock, panels, ledger} = page;
  const rows = [0, 0.37, 0.71, 1].map((share) => Math.round(share * (clock.t.length - 1)));
  const shown = rows.map((row) => {
    clock.set(clock.t[row]);
    page.stage.draw(clock.time);
    const values = [...panels, ledger].flatMap(
        (panel) => (panel?.shown ?? []).map(({column, value}) => [column.name, value.textContent, value.title]));
    return {t: clock.time, clock: byId("clock").textContent, values};
  });
  const marks = (box) => [...box.querySelectorAll(".happening")].map(({title, style}) => [title, style.left]);
  tellShown(shown, {
    rims: page.stage.model.wheels.map((wheel) => isInked(page.stage, wheel)),
    outlines: page.stage.meshes.map((mesh) => mesh?.loops?.length ?? 0),
    "scrubber marks": marks(byId("scrub-box")),
    "plot marks": panels.filter((panel) => !panel.against).map((panel) => marks(panel.area)),
    steps: [-1, -1, -1, 1].map((way) => (page.actions?.step(way), clock.time)),
  });
}

/// Whether something is drawn on a wheel's rim, half a right angle up to the right.
function isInked(stage, {marker, radius}) {
  const {x, y} = stage.motion.place(marker, stage.now);
  const at = stage.px({x: x + radius * Math.SQRT1_2, y: y + radius * Math.SQRT1_2}).map((p) => Math.round(p * stage.ratio));
  return stage.context.getImageData(at[0] - 1, at[1] - 1, 3, 3).data.some((value) => value > 0);
}

const tellShown = (shown, more = {}) =>
    document.body.append(element("script", {type: "application/json", id: "shown", textContent: JSON.stringify({shown, errors, ...more})}));

const errors = [];
window.addEventListener("error", (event) => errors.push(String(event.message)));
window.addEventListener("unhandledrejection", (event) => errors.push(`unhandled: ${event.reason}`));
const consoleError = console.error;
console.error = (...what) => (errors.push(what.join(" ")), consoleError(...what));
window.addEventListener("securitypolicyviolation", (event) => errors.push(`blocked: ${event.violatedDirective}`));
const data = JSON.parse(byId("data").textContent);
const page = data.model ? new Page(data) : new StudyPage(data);
page.start();
if (location.hash === "#check")
  queueMicrotask(() => reportShown(page));  // once plots are drawn
else if (location.hash.startsWith("#t="))
  page.clock.set(Number(location.hash.slice(3)));
