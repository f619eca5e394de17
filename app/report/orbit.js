"use strict";

// One column against another: a joint's orbit, a load over a path.

/// The rows of which the page holds both columns: all of the table, else evenly spaced ones if they have both, and those kept of either.
function pairOf(table, first, second) {
  if (first.t === second.t) return {t: first.t, x: first.y, y: second.y};
  const evenly = [first, second].map(({name}) => table.poses.columns.get(name));
  const rows = new Map();
  for (const [a, b] of [evenly, [first, second]])
    for (let i = 0, k = 0; i < a?.t.length && k < b?.t.length;) {
      if (a.t[i] === b.t[k])
        rows.set(a.t[i], [a.y[i++], b.y[k++]]);
      else
        a.t[i] < b.t[k] ? ++i : ++k;
    }
  const t = [...rows.keys()].sort((a, b) => a - b);
  return {t, x: t.map((time) => rows.get(time)[0]), y: t.map((time) => rows.get(time)[1])};
}

function orbitPlot(panel, columns, width, height) {
  const abscissa = panel.table.columns.get(panel.against);
  const units = [...new Set(columns.map(({unit}) => unit))];
  panel.pairs = columns.map((column) => ({...pairOf(panel.table, abscissa, column), scale: `y ${column.unit}`}));
  const around = (lists) => padded(...rangeOf(lists.flatMap(rangeOf)));
  let x = around(panel.pairs.map((pair) => pair.x));
  const ranges = units.map((unit) => around(panel.pairs.filter(({scale}) => scale === `y ${unit}`).map(({y}) => y)));
  if (columns.every(({unit}) => unit === abscissa.unit)) [x, ranges[0]] = equalScales(x, ranges[0], (width - 80) / (height - 60));
  const scales = {x: {time: false, auto: false, range: x}};
  units.forEach((unit, i) => (scales[`y ${unit}`] = {auto: false, range: ranges[i]}));
  const namesOf = (unit) => columns.filter((column) => column.unit === unit).map(({name}) => name);
  const axes = units.map((unit, i) => axisOf(unit, namesOf(unit).length === 1 ? namesOf(unit)[0] : "", `y ${unit}`, {
                           side: i % 2 ? 1 : 3,
                           size: 58,
                           grid: {show: i === 0, stroke: css("--line"), width: 1}
                         }));
  const curve = (i) => ({
    stroke: seriesColour(i),
    width: 1.25,
    paths: orbitPath,
    label: columns[i].name,
    points: {show: false},
    facets: [{scale: "x", auto: false, sorted: 0}, {scale: panel.pairs[i].scale, auto: false, sorted: 0}],
  });
  const options = {
    mode: 2,
    width,
    height,
    legend: {show: false},
    scales,
    series: [null, ...columns.map((_, i) => curve(i))],
    axes: [axisOf(abscissa.unit, abscissa.name, "x", {size: 34, labelSize: 18}), ...axes],
    cursor: {x: false, y: false, points: {show: false}, drag: {setScale: false, x: false, y: false}},
    hooks: {ready: [(u) => orbitClicks(u, panel)]},
  };
  return new uPlot(options, [null, ...panel.pairs.map(({x: px, y: py}) => [px, py])], panel.area);
}

const padded = (least, most) => paddedRange(null, least, most);

/// The same length of both axes a unit, so that circles are round.
function equalScales([x0, x1], [y0, y1], aspect) {
  const unit = Math.max((x1 - x0) / aspect, y1 - y0);
  const around = (a, b, size) => [(a + b - size) / 2, (a + b + size) / 2];
  return [around(x0, x1, unit * aspect), around(y0, y1, unit)];
}

function orbitPath(u, seriesIndex) {
  const [xs, ys] = u.data[seriesIndex];
  const {scale} = u.series[seriesIndex].facets[1];
  const path = new Path2D();
  let drawing = false;
  for (let i = 0; i < xs.length; ++i) {
    const there = isFinite(xs[i]) && isFinite(ys[i]);
    if (there) path[drawing ? "lineTo" : "moveTo"](u.valToPos(xs[i], "x", true), u.valToPos(ys[i], scale, true));
    drawing = there;
  }
  const {ctx} = u;
  ctx.save();
  ctx.beginPath();
  ctx.rect(u.bbox.left, u.bbox.top, u.bbox.width, u.bbox.height);
  ctx.clip();
  ctx.strokeStyle = seriesColour(seriesIndex - 1);
  ctx.lineWidth = 1.25 * (window.devicePixelRatio || 1);
  ctx.stroke(path);
  ctx.restore();
  return null;
}

function orbitPlace({plot, pairs, clock}) {
  const {t, x, y, scale} = pairs[0];
  const i = nearestIndex(t, clock.time);
  return [plot.valToPos(x[i], "x"), plot.valToPos(y[i], scale)];
}

/// A click goes to the time of the nearest point of a curve.
function orbitClicks(u, {pairs, clock}) {
  u.over.addEventListener("click", (event) => {
    const box = u.over.getBoundingClientRect();
    let best = {distance: Infinity, time: clock.time};
    for (const {t, x, y, scale} of pairs)
      for (let i = 0; i < t.length; ++i) {
        const distance = Math.hypot(u.valToPos(x[i], "x") - event.clientX + box.left, u.valToPos(y[i], scale) - event.clientY + box.top);
        if (distance < best.distance) best = {distance, time: t[i]};
      }
    clock.set(best.time);
  });
}
