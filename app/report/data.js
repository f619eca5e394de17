"use strict";

// The data of the page: numbers come as base64 of little-endian arrays.

function bytesOf(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

const doublesOf = (base64) => new Float64Array(bytesOf(base64).buffer);
const floatsOf = (base64) => new Float32Array(bytesOf(base64).buffer);
const integersOf = (base64) => new Int32Array(bytesOf(base64).buffer);

/// Index of the number in ascending `t` that is nearest to x.
function nearestIndex(t, x) {
  const i = intervalOf(t, x);
  return i + 1 < t.length && t[i + 1] - x < x - t[i] ? i + 1 : i;
}

/// The last index with t[i] <= x, at least 0.
function intervalOf(t, x) {
  let low = 0;
  let high = t.length;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (t[middle] <= x)
      low = middle;
    else
      high = middle;
  }
  return low;
}

/// Some columns at the same times.
function readSheet(json) {
  const t = doublesOf(json.t);
  const columns = new Map();
  for (const {name, unit, values} of json.columns) columns.set(name, {name, unit, t, y: doublesOf(values)});
  return {t, columns};
}

/// A table of results: columns by name, each with its own times, and the sheet that places the bodies.
function readTable(json) {
  const sheets = json.sheets.map(readSheet);
  const columns = new Map(sheets.flatMap((sheet) => [...sheet.columns]));
  return {rows: json.rows, whole: json.whole, columns, poses: json.poses ? readSheet(json.poses) : sheets[0]};
}

function valueAt(column, time) {
  return column.y[nearestIndex(column.t, time)];
}

/// Least and greatest of numbers, those that are not finite left out.
function rangeOf(values) {
  let least = Infinity;
  let most = -Infinity;
  for (const x of values) {
    if (x < least && x > -Infinity) least = x;
    if (x > most && x < Infinity) most = x;
  }
  return least <= most ? [least, most] : [0, 0];
}
