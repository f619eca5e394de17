"use strict";

// The ledger as areas that fill what there is to account for: energy stored at the start and all work put in.

/// The columns of ledger.csv by what they are.
function ledgerParts(table) {
  const all = [...table.columns.values()];
  const summed = new Set(["stored", "unexplained"]);
  const isWork = ({name}) => name.endsWith(".work in");
  const hasAny = ({y}) => y.some((x) => x !== 0);
  return {
    t: table.poses.t,
    work: all.filter(isWork),
    parts: all.filter((column) => !summed.has(column.name) && !isWork(column) && hasAny(column)),
    stored: table.columns.get("stored"),
    unexplained: table.columns.get("unexplained"),
  };
}

/// Areas one above the other, each from its lowest value, and the line that they have to reach.
function ledgerStack({t, work, parts, stored}) {
  const tops = [];
  let below = new Float64Array(t.length);
  let lifted = 0;
  for (const part of parts) {
    const lowest = Math.min(0, rangeOf(part.y)[0]);
    lifted -= lowest;
    below = below.map((x, i) => x + part.y[i] - lowest);
    tops.push(below);
  }
  const line = t.map((_, i) => stored.y[0] + lifted + work.reduce((sum, column) => sum + column.y[i] - column.y[0], 0));
  return {tops, line, lifted};
}

class LedgerPanel {
  constructor(clock, table, run) {
    this.clock = clock;
    this.parts = ledgerParts(table);
    this.area = byId("ledger-plot");
    byId("ledger").hidden = false;
    byId("ledger-text").textContent = ledgerText(run, this.parts);
    clock.listen(() => this.showNow());
  }

  draw() {
    this.plot?.destroy();
    const {t, parts} = this.parts;
    const {tops, line} = ledgerStack(this.parts);
    const legend = element("ul", {className: "values"});
    this.area.replaceChildren(legend);
    this.shown = [];
    const list = (name, colour, column, dashed) => {
      const value = element("output", {});
      const swatch = element("i", {className: dashed ? "swatch" : "swatch area-swatch"});
      swatch.style.color = colour;
      legend.append(element("li", {}, swatch, element("span", {textContent: name}), value));
      this.shown.push({column, value});
    };
    const colours = parts.map((_, i) => areaColour(i));
    parts.forEach((part, i) => list(part.name, colours[i], part, false));
    const {work, stored, unexplained} = this.parts;
    const given = t.map((_, i) => stored.y[0] + work.reduce((sum, column) => sum + column.y[i] - column.y[0], 0));
    list(work.length > 0 ? "at the start and put in" : "at the start", css("--ink"), {t, y: given, unit: "J"}, true);
    list("unexplained", "transparent", unexplained, true);
    // The highest area is drawn first, so that each covers the part of it that belongs to those below.
    const order = tops.map((_, i) => i).reverse();
    const options = {
      width: this.area.clientWidth || 600,
      height: 260,
      legend: {show: false},
      scales: {x: {time: false}, y: {range: (u, least, most) => [0, 1.06 * (most || 1)]}},
      series: [
        {}, ...order.map((i) => ({stroke: colours[i], fill: colours[i], width: 0, points: {show: false}})),
        {stroke: css("--ink"), width: 1.75, dash: [7, 4], points: {show: false}}
      ],
      axes: [axisOf("s", "time", "x", {size: 34, labelSize: 18}), axisOf("J", "energy", "y", {size: 62})],
      cursor: {y: false, sync: {key: "time"}, drag: {x: true, y: false}, points: {show: false}},
      hooks: timeHooks(this.clock),
    };
    this.marker = element("div", {className: "now"});
    this.plot = new uPlot(options, [t, ...order.map((i) => tops[i]), line], this.area);
    this.plot.over.append(this.marker);
    this.showNow();
  }

  resize() {
    if (this.area.clientWidth > 0 && this.area.clientWidth !== this.plot.width)
      this.plot.setSize({width: this.area.clientWidth, height: 260});
    this.showNow();
  }

  showNow() {
    if (!this.plot) return;
    const time = this.clock.pointed ?? this.clock.time;
    for (const {column, value} of this.shown) value.textContent = engineering(valueAt(column, time), column.unit, 5);
    const place = this.plot.valToPos(this.clock.time, "x");
    this.marker.style.transform = `translateX(${place}px)`;
    this.marker.hidden = place < 0 || place > this.plot.over.clientWidth;
  }
}

const areaColour = (i) => css(`--area-${i % 8}`);

function ledgerText(run, {parts}) {
  const worst = Math.abs(run["worst unexplained [J]"] ?? 0);
  const play = run["energy in play [J]"] ?? 0;
  const raised = parts.filter(({y}) => rangeOf(y)[0] < 0).map(({name}) => name);
  return "The areas are energies and losses; the dashed line is the energy at the start plus the work put in since. They agree except for at most " +
      `${engineering(worst, "J", 3)} unexplained${play > 0 ? `, ${plain(worst / play, 2)} of the energy in play` : ""}.` +
      (raised.length > 0 ? ` Drawn from its lowest value: ${raised.join(", ")}.` : "");
}
