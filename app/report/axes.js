"use strict";

// SVG pictures of a table's columns: axes, points, lines from axis to axis.

const svgSpace = "http://www.w3.org/2000/svg";

function svgElement(tag, attributes = {}, ...children) {
  const out = document.createElementNS(svgSpace, tag);
  for (const [name, value] of Object.entries(attributes)) out.setAttribute(name, value);
  out.append(...children);
  return out;
}

/// Round numbers between two ends, about so many.
function ticksBetween(least, most, wanted) {
  const rough = (most - least) / wanted;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((n) => n * power).find((s) => s >= rough);
  const out = [];
  for (let k = Math.ceil(least / step - 1e-9); k * step <= most * (1 + 1e-12) + 1e-9 * step; ++k) out.push(k * step);
  return out;
}

const shortened = (text) => (text.length > 26 ? `${text.slice(0, 12)}…${text.slice(-12)}` : text);

/// A column as places from 0 to 1: numbers straight or by their logarithm, words in their order.
class ColumnScale {
  constructor(column, rows, logarithmic = false) {
    this.column = column;
    this.words = column.numeric ? null : [...new Set(rows.map((row) => row[column.index]))];
    if (this.words) return;
    const values = rows.map((row) => row[column.index]).filter((x) => typeof x === "number");
    this.logarithmic = logarithmic && values.every((x) => x > 0);
    const [least, most] = rangeOf(values.map((x) => this.bend(x)));
    const margin = 0.04 * (most - least) || 0.5 * Math.abs(most) || 1;
    [this.least, this.most] = [least - margin, most + margin];
    this.fitted = scaleFor(rangeOf(values.map(Math.abs))[1], column.unit);
  }

  bend(x) {
    return this.logarithmic ? Math.log10(x) : x;
  }

  /// Where a value is, null if it is none.
  at(value) {
    if (this.words) return (this.words.indexOf(value) + 0.5) / this.words.length;
    return typeof value === "number" ? (this.bend(value) - this.least) / (this.most - this.least) : null;
  }

  title() {
    const unit = this.words || this.logarithmic ? prettyUnit(this.column.unit) : this.fitted.unit;
    return this.column.name + (unit ? ` [${unit}]` : "");
  }

  /// [place, text] of each tick.
  ticks(wanted) {
    if (this.words) return this.words.slice(0, 30).map((word) => [this.at(word), shortened(String(word ?? "–"))]);
    const all = ticksBetween(this.least, this.most, wanted);
    if (this.logarithmic) {
      const whole = all.filter((x) => Math.abs(x - Math.round(x)) < 1e-9);
      return (whole.length > 1 ? whole : all).map((x) => [(x - this.least) / (this.most - this.least), plain(10 ** x, 2)]);
    }
    const texts = axisNumbers(all, this.fitted.factor);
    return all.map((x, i) => [(x - this.least) / (this.most - this.least), texts[i]]);
  }
}

/// Two columns as points. `colourOf` gives the colour of a row.
function scatterPlot(width, height, xScale, yScale, rows, colourOf) {
  const [left, right, top, bottom] = [74, 16, 10, 46];
  const px = (share) => left + share * (width - left - right);
  const py = (share) => height - bottom - share * (height - top - bottom);
  const out = svgElement("svg", {viewBox: `0 0 ${width} ${height}`, width, height, role: "img"});
  out.setAttribute("aria-label", `${yScale.title()} against ${xScale.title()}`);
  for (const [share, text] of xScale.ticks(7))
    out.append(
        svgElement("line", {x1: px(share), x2: px(share), y1: top, y2: height - bottom, class: "grid"}),
        svgElement("text", {x: px(share), y: height - bottom + 17, class: "middle"}, text));
  for (const [share, text] of yScale.ticks(6))
    out.append(
        svgElement("line", {x1: left, x2: width - right, y1: py(share), y2: py(share), class: "grid"}),
        svgElement("text", {x: left - 8, y: py(share) + 4, class: "end"}, text));
  out.append(
      svgElement("text", {x: px(0.5), y: height - 8, class: "middle"}, xScale.title()),
      svgElement("text", {transform: `translate(14 ${py(0.5)}) rotate(-90)`, class: "middle"}, yScale.title()));
  rows.forEach(({row, number, out: left_out}) => {
    const [x, y] = [xScale.at(row[xScale.column.index]), yScale.at(row[yScale.column.index])];
    if (x !== null && y !== null)
      out.append(svgElement(
          "circle", {cx: px(x), cy: py(y), r: 4.5, fill: colourOf(row), class: left_out ? "mark out" : "mark", "data-row": number}));
  });
  return out;
}

/// A line a row through upright axes. Dragging along an axis keeps the rows that cross it there: `brushed(index, [low, high] or null)`.
function parallelPlot(width, height, scales, rows, colourOf, brushes, brushed) {
  const [side, top, bottom] = [70, 40, 14];
  const px = (i) => side + (i * (width - 2 * side)) / Math.max(scales.length - 1, 1);
  const py = (share) => height - bottom - share * (height - top - bottom);
  const out = svgElement("svg", {viewBox: `0 0 ${width} ${height}`, width, height, role: "img"});
  out.setAttribute("aria-label", "Every row as a line through all columns");
  for (const {row, number, out: left_out} of rows) {
    const points = scales.map((scale, i) => [px(i), scale.at(row[scale.column.index])]).filter(([, y]) => y !== null);
    out.append(svgElement("polyline", {
      points: points.map(([x, y]) => `${x},${py(y)}`).join(" "),
      stroke: colourOf(row),
      class: left_out ? "row out" : "row",
      "data-row": number
    }));
  }
  scales.forEach((scale, i) => {
    const axis = svgElement("g", {transform: `translate(${px(i)} 0)`});
    axis.append(svgElement("line", {y1: top, y2: height - bottom, class: "axis"}));
    for (const [share, text] of scale.ticks(4)) axis.append(svgElement("text", {x: -6, y: py(share) + 4, class: "end tick"}, text));
    const side_class = i === 0 ? "start" : i === scales.length - 1 ? "end" : "middle";
    axis.append(svgElement(
        "text",
        {x: i === 0                  ? -side + 4 :
             i === scales.length - 1 ? side - 4 :
                                       0,
         y: i % 2 ? 13 : 28,
         class: `title ${side_class}`},
        scale.title()));
    const brush = brushes.get(scale.column.index);
    if (brush) axis.append(svgElement("rect", {x: -9, width: 18, y: py(brush[1]), height: py(brush[0]) - py(brush[1]), class: "brush"}));
    const handle = svgElement("rect", {x: -14, width: 28, y: top, height: height - top - bottom, class: "handle"});
    const shareAt = (event) =>
        Math.min(Math.max((height - bottom - (event.clientY - out.getBoundingClientRect().top)) / (height - top - bottom), 0), 1);
    handle.addEventListener("pointerdown", (event) => {
      const from = shareAt(event);
      handle.setPointerCapture(event.pointerId);
      handle.addEventListener("pointerup", (end) => {
        const to = shareAt(end);
        brushed(scale.column.index, Math.abs(to - from) < 0.01 ? null : [Math.min(from, to), Math.max(from, to)]);
      }, {once: true});
    });
    axis.append(handle);
    out.append(axis);
  });
  return out;
}
