"use strict";

// Impacts: a table, and steps from one to the next.

class EventTable {
  constructor(clock, json) {
    this.clock = clock;
    this.times = json.rows.map((row) => row[1]);
    byId("events").hidden = json.rows.length === 0;
    const kept = json.rows.length;
    byId("event-count").textContent = kept < json.all ? `the ${kept} strongest of ${json.all}` : `${kept} in all`;
    byId("event-back").onclick = () => this.step(-1);
    byId("event-on").onclick = () => this.step(1);
    this.fill(json);
    clock.listen(() => this.mark());
  }

  fill({columns, rows}) {
    const scales = columns.map(({unit}, c) => (c === 0 ? null : scaleFor(rangeOf(rows.map((row) => Math.abs(row[c] ?? 0)))[1], unit)));
    const heading = columns.map(
        ({name, unit}, c) =>
            element("th", {scope: "col", textContent: name}, ...(unit ? [element("small", {textContent: ` [${scales[c].unit}]`})] : [])));
    this.rows = rows.map((row) => {
      const cells = row.map((x, c) => (c === 0 ? element("td", {textContent: x}) : element("td", {
                              className: "number",
                              textContent: x === null ? (c === 2 ? "goes on" : "–") : plain(x * scales[c].factor, c < 3 ? 7 : 4),
                              title: x === null ? "" : String(x)
                            })));
      const out = element("tr", {tabIndex: 0}, ...cells);
      out.onclick = () => this.clock.set(row[1]);
      out.onkeydown = (event) => event.key === "Enter" && this.clock.set(row[1]);
      return out;
    });
    byId("event-table").append(element("thead", {}, element("tr", {}, ...heading)), element("tbody", {}, ...this.rows));
  }

  step(direction) {
    const {time} = this.clock;
    const next = direction > 0 ? this.times.find((t) => t > time) : this.times.findLast((t) => t < time);
    if (next !== undefined) this.clock.set(next);
  }

  /// The impact that the time shown is at.
  mark() {
    const i = this.times.length > 0 && this.clock.time >= this.times[0] ? intervalOf(this.times, this.clock.time) : -1;
    if (i === this.marked) return;
    this.rows[this.marked]?.classList.remove("current");
    this.rows[i]?.classList.add("current");
    const box = byId("event-table").parentElement;
    if (i >= 0) box.scrollTop = this.rows[i].offsetTop - box.clientHeight / 2;
    this.marked = i;
  }
}
