"use strict";

// What happens at an instant, which each row has second: a table, and steps from one row to the next.

class EventTable {
  /// @param name  of its elements in the page   @param kept  which rows there are of more: "strongest"
  constructor(clock, json, name, kept) {
    this.clock = clock;
    this.name = name;
    this.times = json.rows.map((row) => row[1]);
    byId(`${name}s`).hidden = json.rows.length === 0;
    const {length} = json.rows;
    byId(`${name}-count`).textContent = length < json.all ? `the ${kept} ${length} of ${json.all}` : `${length} in all`;
    byId(`${name}-back`).onclick = () => this.step(-1);
    byId(`${name}-on`).onclick = () => this.step(1);
    this.fill(json);
    clock.listen(() => this.mark());
  }

  fill({columns, rows}) {
    const scales = columns.map(({unit}, c) => scaleFor(rangeOf(rows.map((row) => Math.abs(row[c] ?? 0)))[1], unit));
    const heading = columns.map(
        ({name, unit}, c) =>
            element("th", {scope: "col", className: typeof rows[0]?.[c] === "string" ? "" : "number", textContent: name}, ...(unit ? [element("small", {textContent: ` [${scales[c].unit}]`})] : [])));
    this.rows = rows.map((row) => {
      const cells = row.map((x, c) => (typeof x === "string" ? element("td", {textContent: x}) : element("td", {
                              className: "number",
                              textContent: x === null ? (c === 2 ? "goes on" : "–") : plain(x * scales[c].factor, c < 3 ? 7 : 4),
                              title: x === null ? "" : String(x)
                            })));
      const out = element("tr", {tabIndex: 0}, ...cells);
      out.onclick = () => this.clock.set(row[1]);
      out.addEventListener("keydown", ({key}) => key === "Enter" && this.clock.set(row[1]));
      return out;
    });
    byId(`${this.name}-table`).append(element("thead", {}, element("tr", {}, ...heading)), element("tbody", {}, ...this.rows));
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
    const box = byId(`${this.name}-table`).parentElement;
    if (i >= 0) box.scrollTop = this.rows[i].offsetTop - box.clientHeight / 2;
    this.marked = i;
  }
}

/// Marks with a name at their times, in a box as wide as the time from `begin` to `end`; a click goes there.
function markHappenings(box, clock, begin, end) {
  const marks = clock.happenings.filter(([, t]) => t >= begin && t <= end).map((happening) => {
    const [name, t, did] = happening;
    const mark = element("button", {type: "button", className: "happening", title: `${name}: ${did}, at ${engineering(t, "s", 7)}`, tabIndex: -1});
    mark.style.left = `${(100 * (t - begin)) / (end - begin || 1)}%`;
    mark.onclick = () => clock.set(t);
    return mark;
  });
  box.replaceChildren(...marks);
}

/// What happened last, if that was just before the time shown.
function happeningAt(clock) {
  const just = (clock.end - clock.begin) / 40;
  const last = clock.happenings.findLast(([, t]) => t <= clock.time);
  return last && clock.time - last[1] <= just ? last : null;
}
