"use strict";

// Numbers and units as people read them.

const prefixes = new Map([[-12, "p"], [-9, "n"], [-6, "µ"], [-3, "m"], [0, ""], [3, "k"], [6, "M"], [9, "G"]]);
const takesPrefix = new Set(["m", "s", "N", "J", "Pa", "W", "Hz", "N m", "N s"]);
const superscripts = "⁰¹²³⁴⁵⁶⁷⁸⁹";

const superscript = (n) => (n < 0 ? "⁻" : "") + [...String(Math.abs(n))].map((digit) => superscripts[digit]).join("");
const prettyUnit = (unit) => unit.replace(/\^(-?\d+(\.5)?)/g, (all, n) => (n.includes(".") ? all : superscript(Number(n))));

/// How numbers up to `greatest` are best written: value × factor, in `unit`.
function scaleFor(greatest, unit) {
  const power = greatest > 0 && isFinite(greatest) ? 3 * Math.floor(Math.log10(greatest) / 3 + 1e-9) : 0;
  if (power === 0 || (power === 3 && greatest < 1e4) || (power === -3 && greatest >= 0.1 && !takesPrefix.has(unit)))
    return {factor: 1, unit: prettyUnit(unit)};
  if (takesPrefix.has(unit) && prefixes.has(power)) return {factor: 10 ** -power, unit: prefixes.get(power) + prettyUnit(unit)};
  return {factor: 10 ** -power, unit: `10${superscript(power)} ${prettyUnit(unit)}`.trim()};
}

/// A number with so many digits, without zeros at its end.
function plain(x, digits = 6) {
  if (x === null || Number.isNaN(x)) return "–";
  if (x === 0) return "0";
  const size = Math.abs(x);
  const text = size >= 1e6 || size < 1e-4 ? x.toExponential(digits - 1) : x.toPrecision(digits);
  const [digitsPart, exponent] = text.split("e");
  const short = digitsPart.includes(".") ? digitsPart.replace(/\.?0+$/, "") : digitsPart;
  return (exponent === undefined ? short : `${short}e${Number(exponent)}`).replace("-", "−").replace("e-", "e−");
}

const withUnit = (x, unit, digits) => `${plain(x, digits)} ${prettyUnit(unit)}`.trim();

/// The same with a prefix where the unit takes one.
function engineering(x, unit, digits = 4) {
  const scale = scaleFor(Math.abs(x), unit);
  if (scale.unit.startsWith("10")) return withUnit(x, unit, digits);
  return `${plain(x * scale.factor, digits)} ${scale.unit}`.trim();
}

/// An element with properties and children; text is never read as HTML.
function element(tag, properties = {}, ...children) {
  const out = Object.assign(document.createElement(tag), properties);
  out.append(...children);
  return out;
}

const byId = (id) => document.getElementById(id);
const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const seriesColour = (i) => css(`--series-${i % 8}`);
