"use strict";

// A plot of columns against time or against another column, drawn by uPlot; `clock` has the time shown and tells who asks of changes.

class PlotPanel {
  constructor(clock, table, names, against = null) {
    this.clock = clock;
    this.table = table;
    this.names = names;
    this.against = against;
    this.values = element("ul", {className: "values"});
    this.axis = element("button", {type: "button", className: "quiet", title: "Quantity on the horizontal axis"});
    const add = element("button", {type: "button", className: "quiet", textContent: "+ column"});
    const close = element("button", {type: "button", className: "quiet", textContent: "×", title: "Remove this plot"});
    close.ariaLabel = "Remove this plot";
    this.area = element("div", {className: "area"});
    this.root = element(
        "article", {className: "panel"}, element("header", {}, this.values, element("span", {className: "tools"}, this.axis, add, close)),
        this.area);
    add.onclick = () =>
        pickColumn("Add a column", this.table.columns, (name) => this.change([...this.names.filter((n) => n !== name), name]));
    this.axis.onclick = () => pickColumn("Plot against", this.table.columns, (name) => this.change(this.names, name), "time");
    close.onclick = () => this.onclose?.();
    clock.listen(() => this.showNow());
  }

  change(names, against = this.against) {
    this.names = names;
    this.against = against === "time" ? null : against;
    this.draw();
    this.onchange?.();
  }

  columns() {
    return this.names.map((name) => this.table.columns.get(name)).filter((column) => column);
  }

  draw() {
    this.plot?.destroy();
    this.area.replaceChildren();
    this.marker = element("div", {className: "now"});
    const columns = this.columns();
    this.axis.textContent = `against ${this.against ?? "time"}`;
    this.listValues(columns);
    if (columns.length === 0) return;
    const build = this.against ? orbitPlot : timePlot;
    this.plot = build(this, columns, this.area.clientWidth || 480, 230);
    if (this.against && !this.table.whole) this.values.append(element("li", {className: "hint", textContent: `${this.pairs[0].t.length} rows`}));
    this.plot.over.append(this.marker);
    this.showNow();
  }

  resize() {
    if (this.plot && this.area.clientWidth > 0 && this.area.clientWidth !== this.plot.width)
      this.plot.setSize({width: this.area.clientWidth, height: 230});
    this.showNow();
  }

  /// The columns as a legend that shows their values at the time shown; each can be taken out.
  listValues(columns) {
    this.values.replaceChildren();
    this.shown = columns.map((column, i) => {
      const value = element("output", {});
      const remove = element("button", {type: "button", className: "quiet", textContent: "×"});
      remove.ariaLabel = `Remove ${column.name}`;
      remove.onclick = () => this.change(this.names.filter((name) => name !== column.name));
      const swatch = element("i", {className: `swatch ${i >= 4 ? "dashed" : ""}`});
      swatch.style.color = seriesColour(i);
      this.values.append(element("li", {}, swatch, element("span", {textContent: column.name}), value, remove));
      return {column, value};
    });
    if (columns.length === 0) this.values.append(element("li", {className: "hint", textContent: "no column yet"}));
  }

  /// Values at the time shown, or under the pointer, and where that is in the plot.
  showNow() {
    const time = this.clock.pointed ?? this.clock.time;
    for (const {column, value} of this.shown ?? []) {
      const x = valueAt(column, time);
      value.textContent = takesPrefix.has(column.unit) ? engineering(x, column.unit, 7) : withUnit(x, column.unit, 7);
      value.title = String(x);
    }
    if (!this.plot) return;
    const place = this.against ? orbitPlace(this) : this.plot.valToPos(this.clock.time, "x");
    if (this.against)
      this.marker.style.transform = `translate(${place[0]}px, ${place[1]}px)`;
    else
      this.marker.style.transform = `translateX(${place}px)`;
    this.marker.classList.toggle("dot", this.against !== null);
    this.marker.hidden = this.against === null && (place < 0 || place > this.plot.over.clientWidth);
  }
}

const axisStyle = () => ({
  stroke: css("--ink"),
  grid: {stroke: css("--line"), width: 1},
  ticks: {stroke: css("--line"), width: 1, size: 5},
  font: "12px system-ui, sans-serif",
  labelFont: "12px system-ui, sans-serif"
});

/// An axis whose numbers are written in a fitting multiple of the unit.
function axisOf(unit, title, scaleKey, more = {}) {
  const fitted = (u) => {
    const {min, max} = u.scales[scaleKey];
    return scaleFor(Math.max(Math.abs(min ?? 0), Math.abs(max ?? 0)), unit);
  };
  return {
    ...axisStyle(),
    scale: scaleKey,
    label: (u) => (scaleKey && u.scales[scaleKey] ? `${title ? title + " " : ""}[${fitted(u).unit || "–"}]` : title),
    labelSize: 18,
    labelGap: 2,
    values: (u, splits) => axisNumbers(splits, fitted(u).factor),
    ...more,
  };
}

/// Numbers of an axis with as many decimals as tell them apart.
function axisNumbers(splits, factor) {
  const scaled = splits.map((x) => x * factor);
  const step = scaled.length > 1 ? Math.abs(scaled[1] - scaled[0]) : 1;
  let decimals = 0;
  while (decimals < 8 && scaled.some((x) => Math.abs(Number(x.toFixed(decimals)) - x) > 1e-3 * step)) ++decimals;
  return scaled.map((x) => (Math.abs(x) < 1e-9 * step ? 0 : x).toFixed(decimals).replace("-", "−"));
}

/// Columns with times of their own on all of their times together.
function joined(columns) {
  const withoutNaN = ({y}) => (y.some(Number.isNaN) ? Array.from(y, (x) => (Number.isNaN(x) ? null : x)) : y);
  if (columns.every(({t}) => t === columns[0].t)) return [columns[0].t, ...columns.map(withoutNaN)];
  const [nothing, widened] = [0, 2];  // a gap up to the values before and after it, whatever times the other columns have between
  return uPlot.join(columns.map((column) => [column.t, withoutNaN(column)]), columns.map(() => [nothing, widened]));
}

function timePlot(panel, columns, width, height) {
  const units = [...new Set(columns.map(({unit}) => unit))];
  const scales = {x: {time: false}};
  for (const unit of units) scales[`y ${unit}`] = {range: paddedRange};
  const axes = units.map(
      (unit, i) => axisOf(unit, "", `y ${unit}`, {side: i % 2 ? 1 : 3, size: 58, grid: {show: i === 0, stroke: css("--line"), width: 1}}));
  const series = columns.map(({name, unit}, i) => ({
                               label: name,
                               scale: `y ${unit}`,
                               stroke: seriesColour(i),
                               width: 1.5,
                               dash: i >= 4 ? [6, 3] : undefined,
                               points: {show: false},
                             }));
  const options = {
    width,
    height,
    scales,
    legend: {show: false},
    series: [{label: "t"}, ...series],
    axes: [axisOf("s", "time", "x", {size: 34, labelSize: 18}), ...axes],
    cursor: {y: false, sync: {key: "time"}, drag: {x: true, y: false}, points: {size: 6}},
    hooks: timeHooks(panel.clock),
  };
  return new uPlot(options, joined(columns), panel.area);
}

/// A range a little wider than the data, and not empty.
function paddedRange(u, least, most) {
  if (least === null || most === null) return [0, 1];
  const margin = 0.06 * (most - least) || 0.1 * Math.abs(most) || 1;
  return [least - margin, most + margin];
}

/// What every plot over time does: the pointer shows values, a click goes there, a zoom is one of all plots, impacts and events are
/// marked.
function timeHooks(clock) {
  return {
    ready: [(u) => (clickGoes(u, clock), u.over.append(happeningsOf(u)))],
    setCursor: [(u) => u.cursor.event && clock.point(u.cursor.left >= 0 && u.cursor.idx !== null ? u.data[0][u.cursor.idx] : null)],
    setScale: [(u, key) => key === "x" && clock.zoom(u)],
    drawClear: [(u) => markEvents(u, clock.events)],
    drawAxes: [(u) => markTimes(u, clock.happenings)],
    draw: [(u) => markHappenings(happeningsOf(u), clock, u.scales.x.min, u.scales.x.max)],
  };
}

/// The row that a click means: the peak of the nearest curve if there is one within a few pixels, else the row under the pointer.
function rowClicked(u, left, top) {
  const [t, ...curves] = u.data;
  const [from, to] = [left - 5, left + 5].map((x) => intervalOf(t, u.posToVal(x, "x")));
  let best = {distance: 8, row: u.posToIdx(left)};
  curves.forEach((y, k) => {
    const rows = Array.from({length: to - from + 1}, (_, i) => from + i).filter((row) => Number.isFinite(y[row]));
    if (rows.length === 0) return;
    const off = (row) => u.valToPos(y[row], u.series[k + 1].scale) - top;
    const high = rows.reduce((a, b) => (y[b] > y[a] ? b : a));
    const low = rows.reduce((a, b) => (y[b] < y[a] ? b : a));
    const distance = Math.max(off(high), -off(low), 0);
    const isPeak = (row) => row !== rows[0] && row !== rows.at(-1);
    const [peak] = [high, low].filter(isPeak).sort((a, b) => Math.abs(off(a)) - Math.abs(off(b)));
    if (distance < best.distance) best = {distance, row: peak ?? u.posToIdx(left)};
  });
  return best.row;
}

function clickGoes(u, clock) {
  let pressed = 0;
  u.over.addEventListener("mousedown", (event) => (pressed = event.clientX));
  u.over.addEventListener("mouseup", (event) => {
    const {left, top} = u.over.getBoundingClientRect();
    if (Math.abs(event.clientX - pressed) < 4) clock.set(u.data[0][rowClicked(u, event.clientX - left, event.clientY - top)]);
  });
  u.over.addEventListener("mouseleave", () => clock.point(null));
  clock.plots.add(u);
  (u.hooks.destroy ??= []).push(() => clock.plots.delete(u));
}

function markEvents(u, events) {
  if (events.length === 0) return;
  const {ctx, bbox} = u;
  ctx.save();
  ctx.strokeStyle = css("--accent");
  ctx.globalAlpha = events.length > 60 ? 0.25 : 0.45;
  ctx.lineWidth = 1;
  ctx.beginPath();
  for (const time of events) {
    const x = Math.round(u.valToPos(time, "x", true)) + 0.5;
    if (x < bbox.left || x > bbox.left + bbox.width) continue;
    ctx.moveTo(x, bbox.top);
    ctx.lineTo(x, bbox.top + 7 * (window.devicePixelRatio || 1));
  }
  ctx.stroke();
  ctx.restore();
}

const happeningsOf = (u) => (u.happenings ??= element("div", {className: "happenings"}));

/// A dashed line through the plot at each event of the scene, with its name where there is room.
function markTimes(u, happenings) {
  const {ctx, bbox} = u;
  const ratio = window.devicePixelRatio || 1;
  ctx.save();
  ctx.strokeStyle = ctx.fillStyle = css("--event");
  ctx.globalAlpha = happenings.length > 60 ? 0.25 : 0.7;
  ctx.setLineDash([4 * ratio, 4 * ratio]);
  ctx.font = `${11 * ratio}px system-ui, sans-serif`;
  ctx.textAlign = "left";
  ctx.textBaseline = "top";
  ctx.beginPath();
  let free = bbox.left;
  for (const [name, time] of happenings) {
    const x = Math.round(u.valToPos(time, "x", true)) + 0.5;
    if (x < bbox.left || x > bbox.left + bbox.width) continue;
    ctx.moveTo(x, bbox.top);
    ctx.lineTo(x, bbox.top + bbox.height);
    const end = x + 3 * ratio + ctx.measureText(name).width;
    if (x < free || end > bbox.left + bbox.width) continue;
    ctx.fillText(name, x + 3 * ratio, bbox.top + 2 * ratio);
    free = end + 4 * ratio;
  }
  ctx.stroke();
  ctx.restore();
}

/// A dialogue that lists columns by part of their names.
function pickColumn(title, columns, chosen, also = null) {
  const dialog = byId("picker");
  const filter = byId("picker-filter");
  const list = byId("picker-list");
  const names = [...(also ? [also] : []), ...columns.keys()];
  const most = 300;
  const fillList = () => {
    const words = filter.value.toLowerCase().split(/\s+/).filter(Boolean);
    const fitting = names.filter((name) => words.every((word) => name.toLowerCase().includes(word)));
    list.replaceChildren(...fitting.slice(0, most).map((name) => {
      const button = element("button", {type: "button", textContent: name});
      button.setAttribute("role", "option");
      button.append(element("span", {className: "unit", textContent: prettyUnit(columns.get(name)?.unit ?? "")}));
      button.onclick = () => (dialog.close(), chosen(name));
      return button;
    }));
    if (fitting.length > most) list.append(element("p", {textContent: `… and ${fitting.length - most} more; write part of a name`}));
  };
  byId("picker-title").textContent = title;
  filter.value = "";
  filter.oninput = fillList;
  filter.onkeydown = (event) => {  // returns nothing: a handler that returns false swallows the key
    if (event.key !== "Enter") return;
    event.preventDefault();
    list.querySelector("button")?.click();
  };
  fillList();
  dialog.showModal();
  filter.focus();
}
