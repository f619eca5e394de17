"use strict";

// Forces as arrows, couples as arcs, and what tells their kinds and sizes.

const usualLength = (stage) => 0.16 * Math.min(stage.width, stage.height);
const pixelsPerNewton = (stage) => (stage.usualForce > 0 ? (usualLength(stage) * stage.arrows) / stage.usualForce : 0);
const coupleRadius = 18;
const usualTurn = 0.5 * Math.PI;
const turnPerNewtonMetre = (stage) => (stage.usualCouple > 0 ? (usualTurn * stage.arrows) / stage.usualCouple : 0);

function drawForces(stage) {
  for (const {kind, at, force, couple} of stage.motion.forces(stage.time, stage.now)) {
    const [start, colour] = [stage.px(at), stage.colours[kind]];
    const size = Math.hypot(force.x, force.y);
    const length = size * pixelsPerNewton(stage);
    if (length > 2) drawArrow(stage, start, force.x / size, -force.y / size, length, colour);
    const turn = couple * turnPerNewtonMetre(stage);
    if (Math.abs(turn) > 0.1) drawCouple(stage, start, turn, colour);
  }
  drawForceLegend(stage);
}

/// An arrow that would leave the picture ends at its edge, with a second head.
function drawArrow(stage, [x, y], ux, uy, length, colour) {
  const most = Math.min(roomAlong(stage, x, y, ux, uy) - 3, 0.55 * Math.min(stage.width, stage.height));
  const drawn = Math.max(Math.min(length, most), 0);
  const head = Math.min(9, 0.6 * drawn);
  const {context} = stage;
  context.beginPath();
  context.moveTo(x, y);
  context.lineTo(x + (drawn - 0.8 * head) * ux, y + (drawn - 0.8 * head) * uy);
  stroke(stage, colour, 2);
  arrowHead(stage, x + drawn * ux, y + drawn * uy, ux, uy, head, colour);
  if (length > drawn) arrowHead(stage, x + (drawn - 0.8 * head) * ux, y + (drawn - 0.8 * head) * uy, ux, uy, head, colour);
}

function arrowHead(stage, x, y, ux, uy, size, colour) {
  const {context} = stage;
  context.beginPath();
  context.moveTo(x, y);
  context.lineTo(x - size * ux - 0.4 * size * uy, y - size * uy + 0.4 * size * ux);
  context.lineTo(x - size * ux + 0.4 * size * uy, y - size * uy - 0.4 * size * ux);
  context.closePath();
  fill(stage, colour, 1);
}

/// From a point in the picture to its edge; from one outside as far as one likes.
function roomAlong(stage, x, y, ux, uy) {
  const {width, height} = stage;
  if (x < 0 || x > width || y < 0 || y > height) return Infinity;
  const until = (from, u, size) => (u > 0 ? (size - from) / u : u < 0 ? -from / u : Infinity);
  return Math.min(until(x, ux, width), until(y, uy, height));
}

/// An arc from the upright of so many radians, at most nearly a turn, > 0 counter-clockwise.
function drawCouple(stage, [x, y], turn, colour) {
  const drawn = Math.sign(turn) * Math.min(Math.abs(turn), 1.8 * Math.PI);
  const [from, to] = [-0.5 * Math.PI, -0.5 * Math.PI - drawn];
  const {context} = stage;
  context.beginPath();
  context.arc(x, y, coupleRadius, from, to, drawn > 0);
  stroke(stage, colour, 2);
  const [c, s, way] = [Math.cos(to), Math.sin(to), Math.sign(drawn)];
  const head = Math.min(9, coupleRadius * Math.abs(drawn));
  arrowHead(stage, x + coupleRadius * c + 0.4 * head * way * s, y + coupleRadius * s - 0.4 * head * way * c, way * s, -way * c, head, colour);
}

/// The greatest of 1, 2, 5 × 10ⁿ that is at most x.
function roundBelow(x) {
  const power = 10 ** Math.floor(Math.log10(x));
  return [5, 2, 1].map((n) => n * power).find((n) => n <= x) ?? power;
}

/// Above the bar of lengths: how long a round force and how wide a round couple are drawn, and the colours of the kinds that occur.
function drawForceLegend(stage) {
  const {ink} = stage.colours;
  let [x, y] = [16, stage.height - 42];
  const say = (text, colour) => (write(stage, text, x, y, colour), x += stage.context.measureText(text).width + 14);
  if (stage.usualForce > 0) {
    const force = roundBelow(stage.usualForce / stage.arrows);
    const length = force * pixelsPerNewton(stage);
    drawArrow(stage, [x, y], 1, 0, length, ink);
    x += length + 6;
    say(engineering(force, "N"), ink);
  }
  if (stage.usualCouple > 0) {
    const couple = roundBelow(stage.usualCouple / stage.arrows);
    x += coupleRadius + 4;
    drawCouple(stage, [x, y + coupleRadius / 2 - 2], couple * turnPerNewtonMetre(stage), ink);
    x += 6;
    say(engineering(couple, "N m"), ink);
  }
  const kinds = stage.kinds.map((kind) => [`→ ${kind}`, stage.colours[kind]]);
  if (x + 60 * kinds.length > stage.width) [x, y] = [16, y - 22];
  for (const [text, colour] of kinds) say(text, colour);
}
