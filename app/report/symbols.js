"use strict";

// Wheels and belts

/// A pitch circle, pulley or disc in the colour of its body, with a spoke that turns with it where it is not the ground's.
function drawWheel(stage, {marker, radius}) {
  const at = stage.motion.place(marker, stage.now);
  const body = stage.model.markers[marker].body;
  circle(stage, at, radius * stage.scale);
  const colour = body < 0 ? stage.colours.ink : bodyColour(stage, body);
  stroke(stage, colour, 1.75);
  if (body < 0) return;
  trace(stage, [at, {x: at.x + radius * Math.cos(at.angle), y: at.y + radius * Math.sin(at.angle)}], false);
  stroke(stage, colour, 1.25);
}

/// A belt along two pulleys, radii > 0 where it goes round counter-clockwise; null where they touch, as gears do.
function beltEnds(a, b, [radiusA, radiusB]) {
  const touching = 1e-2;  // of a radius
  const apart = Math.hypot(b.x - a.x, b.y - a.y);
  if (!(apart - Math.abs(radiusB - radiusA) >= touching * Math.abs(radiusA))) return null;
  const angle = Math.atan2(b.y - a.y, b.x - a.x) - Math.asin((radiusB - radiusA) / apart);
  const end = (centre, radius) => ({x: centre.x + radius * Math.sin(angle), y: centre.y - radius * Math.cos(angle)});
  return [end(a, radiusA), end(b, radiusB)];
}

function drawBelt(stage, {a, b, radii}) {
  const ends = beltEnds(stage.motion.place(a, stage.now), stage.motion.place(b, stage.now), radii);
  if (!ends) return;
  trace(stage, ends, false);
  stroke(stage, stage.colours.ink, 2);
}

// Springs and cylinders

function drawActuator(stage, {kind, a: first, b: second, width}) {
  const a = stage.motion.place(first, stage.now);
  const b = stage.motion.place(second, stage.now);
  const draw = {coil: drawCoil, cylinder: drawCylinder, spiral: drawSpiral}[kind];
  draw(stage, a, b, width);
}

/// A barrel from a, a rod from b into it.
function drawCylinder(stage, a, b, width) {
  const length = Math.hypot(b.x - a.x, b.y - a.y);
  if (length === 0) return;
  const half = Math.max(width, 4 / stage.scale) / length;
  const at = (share, side) =>
      ({x: a.x + share * (b.x - a.x) - side * half * (b.y - a.y), y: a.y + share * (b.y - a.y) + side * half * (b.x - a.x)});
  trace(stage, [at(0.4, 0), b], false);
  stroke(stage, stage.colours.faint, 4);
  trace(stage, [at(0, -1), at(0.55, -1), at(0.55, 1), at(0, 1)], true);
  fill(stage, stage.colours.line, 1);
  stroke(stage, stage.colours.ink, 1.5);
}

/// Two turns about b, from the one body's direction to the other's.
function drawSpiral(stage, a, b, radius) {
  const points = Array.from({length: 65}, (_, i) => {
    const angle = a.angle + (i / 64) * (4 * Math.PI + b.angle - a.angle);
    const r = radius * (1 + (1.2 * i) / 64);
    return {x: b.x + r * Math.cos(angle), y: b.y + r * Math.sin(angle)};
  });
  trace(stage, points, false);
  stroke(stage, stage.colours.spring, 1.5);
}

function drawCoil(stage, a, b) {
  const [x0, y0] = stage.px(a);
  const [x1, y1] = stage.px(b);
  const length = Math.hypot(x1 - x0, y1 - y0) || 1;
  const width = Math.min(Math.max(stage.model.pin * stage.scale, 4), 12);
  const [nx, ny] = [(-width * (y1 - y0)) / length, (width * (x1 - x0)) / length];
  const turns = 14;
  const {context} = stage;
  context.beginPath();
  for (let i = 0; i <= turns; ++i) {
    const side = i < 2 || i > turns - 2 ? 0 : i % 2 ? 1 : -1;
    context.lineTo(x0 + ((x1 - x0) * i) / turns + side * nx, y0 + ((y1 - y0) * i) / turns + side * ny);
  }
  stroke(stage, stage.colours.spring, 1.5);
}
