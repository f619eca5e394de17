"use strict";

// The page of tables: sweeps, fits, trade-offs, sections, modes. The rows of one table as lines, as points and as rows, which point to each other.

class StudyPage {
  constructor(data) {
    this.data = data;
    this.use(data.tables[0]);
  }

  /// Shows this table.
  use(table) {
    const filled = table.columns.map((_, c) => c).filter((c) => table.rows.length === 0 || table.rows.some((row) => row[c] !== null));
    this.written = table.rows.map((row) => filled.map((c) => row[c]));
    const isRounding = (x, {whole}) => typeof x === "number" && Math.abs(x) < 1e-9 * (whole ?? 0);
    this.rows = table.rows.map((row) => filled.map((c) => (isRounding(row[c], table.columns[c]) ? 0 : row[c])));
    this.all = table.all;
    this.noun = table.noun ?? "rows";
    this.columns = filled.map((c, index) => ({...table.columns[c], index, numeric: this.isNumeric(index)}));
    this.varying = this.columns.filter((column) => new Set(this.rows.map((row) => row[column.index])).size > 1);
    this.brushes = new Map();
    this.sorted = {index: -1, ascending: true};  // as in the file
    const numeric = this.varying.filter((column) => column.numeric && column.name !== "case");
    const named = (name, otherwise) => this.columns.find((column) => column.name === name) ?? otherwise ?? this.columns[0];
    this.x = named(table.x, numeric[0]);
    this.y = named(table.y, numeric.find((column) => column !== this.x));
    this.colour = named(table.colour, numeric.at(-1));
    this.logarithmic = {x: table.logarithmic, y: table.logarithmic};
  }

  isNumeric(index) {
    return this.rows.some((row) => typeof row[index] === "number") &&
        this.rows.every((row) => row[index] === null || typeof row[index] === "number");
  }

  start() {
    document.querySelector("main").hidden = true;
    byId("help-button").hidden = true;
    showHead(this.data.title, this.data.run);
    showFacts(this.data.run);
    this.show();
  }

  show() {
    byId("study").hidden = false;
    this.tableChooser();
    byId("study-clear").onclick = () => (this.brushes.clear(), this.draw());
    byId("study").addEventListener("pointerover", ({target}) => this.point(target.closest("[data-row]")?.dataset.row));
    window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.draw());
    new ResizeObserver(() => this.width !== byId("study").clientWidth && this.draw()).observe(byId("study"));
    this.choose();
  }

  tableChooser() {
    const select = byId("study-table-name");
    select.append(...this.data.tables.map(({file}, index) => element("option", {value: index, textContent: file})));
    select.parentElement.hidden = this.data.tables.length < 2;
    select.onchange = () => (this.use(this.data.tables[select.value]), this.choose());
  }

  /// Fills what chooses from this table, and draws.
  choose() {
    const plotted = this.varying.filter(({numeric}) => numeric).length > 1;
    byId("study-parallel").hidden = byId("study-hint").hidden = byId("study-scatter").parentElement.hidden = !plotted;
    byId("study-count").textContent = this.rows.length < this.all ?
        `${this.rows.length} of ${this.all} rows: evenly spaced ones, and those with an extreme value` :
        `${this.rows.length} ${this.noun}`;
    for (const which of ["x", "y", "colour"]) this.chooser(which);
    for (const which of ["x", "y"]) this.logChooser(which);
    this.draw();
  }

  chooser(which) {
    const select = byId(`study-${which}`);
    select.replaceChildren(...this.columns.map(({name, index}) => element("option", {value: index, textContent: name})));
    select.value = this[which].index;
    select.onchange = () => ((this[which] = this.columns[select.value]), this.draw());
  }

  logChooser(which) {
    const box = byId(`study-log-${which}`);
    box.checked = this.logarithmic[which];
    box.onchange = () => ((this.logarithmic[which] = box.checked), this.draw());
  }

  /// The rows with their numbers, and whether a brush leaves them out.
  marked() {
    const scales = [...this.brushes].map(([index, range]) => ({scale: new ColumnScale(this.columns[index], this.rows), range}));
    return this.rows.map((row, number) => ({
                           row,
                           number,
                           out: scales.some(({scale, range}) => {
                             const at = scale.at(row[scale.column.index]);
                             return at === null || at < range[0] || at > range[1];
                           }),
                         }));
  }

  draw() {
    this.width = byId("study").clientWidth;
    const rows = this.marked();
    const colours = new ColumnScale(this.colour, this.rows);
    const colourOf = (row) => {
      const at = colours.at(row[this.colour.index]);
      return at === null ? css("--faint") : colours.words ? seriesColour(colours.words.indexOf(row[this.colour.index])) : scaleColour(at);
    };
    const most = 10;
    const scales =
        this.varying
            .filter((column) => column.name !== "case" && (column.numeric || new Set(this.rows.map((row) => row[column.index])).size <= 12))
            .slice(0, most)
            .map((column) => new ColumnScale(column, this.rows));
    const parallel = byId("study-parallel");
    const width = Math.max(parallel.clientWidth, 96 * scales.length);
    parallel.replaceChildren(
        scales.length > 1 ? parallelPlot(width, 300, scales, rows, colourOf, this.brushes, (index, range) => this.brush(index, range)) :
                            "");
    const scatter = byId("study-scatter");
    scatter.replaceChildren(scatterPlot(
        scatter.clientWidth, 340, new ColumnScale(this.x, this.rows, this.logarithmic.x),
        new ColumnScale(this.y, this.rows, this.logarithmic.y), rows, colourOf));
    this.fillTable(rows);
  }

  brush(index, range) {
    if (range)
      this.brushes.set(index, range);
    else
      this.brushes.delete(index);
    this.draw();
  }

  fillTable(marked) {
    const scales = this.columns.map(
        ({index, numeric, unit}) => (numeric ? scaleFor(unit ? rangeOf(this.rows.map((row) => Math.abs(row[index] ?? 0)))[1] : 1, unit) : null));
    const {index, ascending} = this.sorted;
    const order = (a, b) => (a === b ? 0 : a === null ? 1 : b === null ? -1 : a < b === ascending ? -1 : 1);
    const rows = marked.filter((one) => !one.out).sort((a, b) => (index < 0 ? a.number - b.number : order(a.row[index], b.row[index])));
    const heading = this.columns.map((column, c) => {
      const unit = scales[c]?.unit ?? "";
      const button = element("button", {
        type: "button",
        className: "quiet",
        textContent: column.name + (unit ? ` [${unit}]` : "") + (c === index ? (ascending ? " ↑" : " ↓") : "")
      });
      button.onclick = () => ((this.sorted = {index: c, ascending: c === index ? !ascending : true}), this.draw());
      return element("th", {scope: "col", className: scales[c] ? "number" : ""}, button);
    });
    const most = 1000;
    const body = rows.slice(0, most).map(({row, number}) => {
      const out =
          element("tr", {}, ...row.map((x, c) => element("td", {
                                         className: scales[c] ? "number" : "",
                                         title: String(this.written[number][c] ?? ""),
                                         textContent: typeof x === "number" ? plain(scales[c] ? x * scales[c].factor : x, 6) : (x ?? "–")
                                       })));
      out.dataset.row = number;
      return out;
    });
    byId("study-table").replaceChildren(element("thead", {}, element("tr", {}, ...heading)), element("tbody", {}, ...body));
    byId("study-left").textContent = rows.length < this.rows.length ? `${rows.length} of them selected by the bands on the axes` : "";
    byId("study-clear").hidden = this.brushes.size === 0;
  }

  /// The same row everywhere, while the pointer is on one.
  point(number) {
    if (number === this.pointed) return;
    for (const old of byId("study").querySelectorAll(".current")) old.classList.remove("current");
    if (number !== undefined)
      for (const one of byId("study").querySelectorAll(`[data-row="${number}"]`)) one.classList.add("current");
    this.pointed = number;
  }
}
