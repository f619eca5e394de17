"use strict";

// What is drawn of the mechanism at `stage.time`, from the ground up to the arrows.

function drawMechanism(stage) {
  const {model} = stage;
  for (const profile of model.ground) drawGround(stage, stage.profilePoints(profile, stage.now), profile.closed);
  for (const joint of model.joints)
    if (joint.symbol.includes("guide")) drawStretch(stage, joint);
  model.bodies.forEach((body, b) => drawBody(stage, body, b));
  if (stage.show.paths) stage.paths.forEach((path, i) => drawPath(stage, path, i));
  for (const line of model["pitch lines"]) drawStretch(stage, line);
  for (const wheel of model.wheels) drawWheel(stage, wheel);
  for (const span of model.spans) drawBelt(stage, span);
  for (const actuator of model.actuators) drawActuator(stage, actuator);
  for (const joint of model.joints) drawJoint(stage, joint);
  for (const contact of stage.clearances) drawClearance(stage, contact);
  if (stage.show.forces) drawForces(stage);
  if (stage.show.names) drawNames(stage);
  drawScaleBar(stage);
  drawNotes(stage);
}

function trace(stage, points, closed) {
  const {context} = stage;
  context.beginPath();
  points.forEach((p, i) => {
    const [x, y] = stage.px(p);
    if (i === 0)
      context.moveTo(x, y);
    else
      context.lineTo(x, y);
  });
  if (closed) context.closePath();
}

function stroke(stage, colour, width, dash = []) {
  const {context} = stage;
  context.strokeStyle = colour;
  context.lineWidth = width;
  context.setLineDash(dash);
  context.stroke();
  context.setLineDash([]);
}

function fill(stage, colour, opacity, rule = "nonzero") {
  const {context} = stage;
  context.globalAlpha = opacity;
  context.fillStyle = colour;
  context.fill(rule);
  context.globalAlpha = 1;
}

function circle(stage, at, pixels) {
  const [x, y] = stage.px(at);
  stage.context.beginPath();
  stage.context.arc(x, y, Math.max(pixels, 0.5), 0, 2 * Math.PI);
}

// Ground

function drawGround(stage, points, closed) {
  const sides = points.map((p, i) => [p, points[i + 1] ?? (closed ? points[0] : null)]).filter(([, to]) => to);
  const {context} = stage;
  context.beginPath();
  for (const [from, to] of sides) hatch(stage, stage.px(from), stage.px(to));
  stroke(stage, stage.colours.faint, 1);
  trace(stage, points, closed);
  stroke(stage, stage.colours.ink, 1.5);
}

/// Short strokes on the left of a side, where the material is; only of what is in the picture.
function hatch(stage, [x0, y0], [x1, y1]) {
  const length = Math.hypot(x1 - x0, y1 - y0);
  const seen = seenPart(stage, x0, y0, x1, y1);
  if (!seen || length === 0) return;
  const [dx, dy] = [(x1 - x0) / length, (y1 - y0) / length];
  const spacing = 9;
  for (let s = spacing * Math.ceil((seen[0] * length) / spacing); s <= seen[1] * length; s += spacing) {
    const [x, y] = [x0 + s * dx, y0 + s * dy];
    stage.context.moveTo(x, y);
    stage.context.lineTo(x + 6 * dy - 5 * dx, y - 6 * dx - 5 * dy);
  }
}

/// Shares of a line between which it is in the picture, null if it is nowhere.
function seenPart(stage, x0, y0, x1, y1) {
  let [from, to] = [0, 1];
  for (const [start, step, limit] of [[x0, x1 - x0, stage.width], [y0, y1 - y0, stage.height]]) {
    if (step === 0) {
      if (start < 0 || start > limit) return null;
      continue;
    }
    const [enter, leave] = [-start / step, (limit - start) / step].sort((a, b) => a - b);
    from = Math.max(from, enter);
    to = Math.min(to, leave);
  }
  return from < to ? [from, to] : null;
}

/// A small support under a pin that the ground holds.
function drawSupport(stage, at, size) {
  const [x, y] = stage.px(at);
  const {context} = stage;
  context.beginPath();
  context.moveTo(x, y);
  context.lineTo(x - size, y + 1.6 * size);
  context.lineTo(x + size, y + 1.6 * size);
  context.closePath();
  fill(stage, stage.colours.faint, 0.25);
  stroke(stage, stage.colours.faint, 1);
  context.beginPath();
  for (let k = -1; k < 1.01; k += 0.5) {
    context.moveTo(x + k * size, y + 1.6 * size);
    context.lineTo(x + (k - 0.45) * size, y + 2.1 * size);
  }
  stroke(stage, stage.colours.faint, 1);
}

// Bodies

const bodyColour = (stage, b) => stage.motion.model.bodies[b]?.colour ?? stage.colours.bodies[b % stage.colours.bodies.length];

function bodyOutlines(stage, body, b) {
  const outlines = body.profiles.map((p) => ({points: stage.profilePoints(p, stage.now), closed: p.closed}));
  if (body.outline.length === 0) return outlines;
  const at = (i) => toWorld(stage.now[b], body.outline[2 * i], body.outline[2 * i + 1]);
  return [...outlines, {points: Array.from({length: body.outline.length / 2}, (_, i) => at(i)), closed: true}];
}

function drawBody(stage, body, b) {
  const colour = bodyColour(stage, b);
  const outlines = bodyOutlines(stage, body, b);
  if (body.profiles.length > 0) drawBars(stage, b, outlines, colour);
  for (const {points, closed} of outlines) {
    trace(stage, points, closed);
    if (closed) fill(stage, colour, 0.22);
    stroke(stage, colour, 1.75);
  }
  if (stage.meshes[b]) drawMesh(stage, stage.meshes[b], stage.now[b], colour);
}

/// What holds the surfaces of a body together: bars from its first joint to the others and to the middle of each surface.
function drawBars(stage, b, outlines, colour) {
  const {model, motion} = stage;
  const markers = new Set(
      [...model.joints, ...model.contacts.filter((c) => c.radius)].flatMap((j) => [j.a, j.b]).filter((m) => model.markers[m].body === b));
  const middle = (points) =>
      ({x: points.reduce((sum, p) => sum + p.x, 0) / points.length, y: points.reduce((sum, p) => sum + p.y, 0) / points.length});
  const [first, ...others] = [...[...markers].map((m) => motion.place(m, stage.now)), ...outlines.map(({points}) => middle(points))];
  for (const other of others) {
    trace(stage, [first, other], false);
    stage.context.globalAlpha = 0.3;
    stroke(stage, colour, Math.min(Math.max(0.5 * model.pin * stage.scale, 3), 10));
    stage.context.globalAlpha = 1;
  }
}

/// The mesh's points in the picture.
function bentPixels(stage, mesh, pose) {
  mesh.bend(pose, stage.deformation);
  const at = new Float64Array(mesh.world.length);
  for (let p = 0; p < at.length; p += 2) {
    at[p] = stage.width / 2 + (mesh.world[p] - stage.looked.x) * stage.scale;
    at[p + 1] = stage.height / 2 - (mesh.world[p + 1] - stage.looked.y) * stage.scale;
  }
  return at;
}

const fillRule = (mesh) => (mesh.loops ? "evenodd" : "nonzero");

/// The outlines of a mesh, else its triangles.
function traceMesh({context}, mesh, at) {
  context.beginPath();
  if (mesh.loops)
    for (const loop of mesh.loops) traceLoop(context, loop, at);
  else
    for (let k = 0; k < mesh.triangles.length; k += 3) traceTriangle(context, mesh.triangles, k, at, 0);
}

function drawMesh(stage, mesh, pose, colour) {
  const {context} = stage;
  const at = bentPixels(stage, mesh, pose);
  if (stage.show.stress) {
    mesh.stress(pose.eta);
    fillByStress(stage, mesh, at);
  } else {
    traceMesh(stage, mesh, at);
    fill(stage, colour, 0.3, fillRule(mesh));
  }
  context.beginPath();
  for (let k = 0; k < mesh.rim.length; k += 2) {
    const [a, b] = [2 * mesh.rim[k], 2 * mesh.rim[k + 1]];
    context.moveTo(at[a], at[a + 1]);
    context.lineTo(at[b], at[b + 1]);
  }
  stroke(stage, stage.show.stress ? stage.colours.ink : colour, stage.show.stress ? 0.8 : 1.5);
}

function traceLoop(context, loop, at) {
  context.moveTo(at[2 * loop[0]], at[2 * loop[0] + 1]);
  for (let k = 1; k < loop.length; ++k) context.lineTo(at[2 * loop[k]], at[2 * loop[k] + 1]);
  context.closePath();
}

/// A triangle whose corners are so many pixels further from its middle.
function traceTriangle(context, [xa, ya, xb, yb, xc, yc], more) {
  const x = (xa + xb + xc) / 3, y = (ya + yb + yc) / 3;
  const corner = (draw, px, py) => {
    const away = 1 + more / (Math.hypot(px - x, py - y) || 1);
    context[draw](x + away * (px - x), y + away * (py - y));
  };
  corner("moveTo", xa, ya), corner("lineTo", xb, yb), corner("lineTo", xc, yc);
}

/// Triangles of one colour are filled together, each a little larger, so that there are no gaps between neighbours. A triangle over which the
/// colour changes much is divided into four, unless there are very many.
function fillByStress(stage, {triangles, mises}, at) {
  const {context} = stage;
  const groups = Array.from({length: scaleSteps}, () => []);
  const steps = stage.greatestStress > 0 ? (scaleSteps - 1) / stage.greatestStress : 0;
  const add = (p, [a, b, c], times) => {
    if (times === 0 || Math.max(a, b, c) - Math.min(a, b, c) < 3)
      return groups[Math.min(Math.round((a + b + c) / 3), scaleSteps - 1)].push(p);
    const [xa, ya, xb, yb, xc, yc] = p;
    const [xd, yd, xe, ye, xf, yf] = [(xb + xc) / 2, (yb + yc) / 2, (xc + xa) / 2, (yc + ya) / 2, (xa + xb) / 2, (ya + yb) / 2];
    const [d, e, f] = [(b + c) / 2, (c + a) / 2, (a + b) / 2];
    add([xa, ya, xf, yf, xe, ye], [a, f, e], times - 1);
    add([xb, yb, xd, yd, xf, yf], [b, d, f], times - 1);
    add([xc, yc, xe, ye, xd, yd], [c, e, d], times - 1);
    add([xd, yd, xe, ye, xf, yf], [d, e, f], times - 1);
  };
  const times = triangles.length < 10_000 ? 4 : 0;
  for (let k = 0; k < triangles.length; k += 3) {
    const [a, b, c] = [triangles[k], triangles[k + 1], triangles[k + 2]];
    add([at[2 * a], at[2 * a + 1], at[2 * b], at[2 * b + 1], at[2 * c], at[2 * c + 1]],
        [steps * mises[a], steps * mises[b], steps * mises[c]], times);
  }
  groups.forEach((members, step) => {
    if (members.length === 0) return;
    context.beginPath();
    for (const p of members) traceTriangle(context, p, 0.7);
    fill(stage, scaleColours[step], 1);
  });
}

// Joints and clearances

const pinPixels = (stage) => Math.min(Math.max(0.6 * stage.model.pin * stage.scale, 3), 9);

/// Of the line through a along its direction what is near b.
function drawStretch(stage, {a: first, b: second}) {
  const a = stage.motion.place(first, stage.now);
  const b = stage.motion.place(second, stage.now);
  const [ux, uy] = [Math.cos(a.angle), Math.sin(a.angle)];
  const along = ux * (b.x - a.x) + uy * (b.y - a.y);
  const half = 0.5 * stage.model.length;
  trace(stage, [along - half, along + half].map((s) => ({x: a.x + s * ux, y: a.y + s * uy})), false);
  stroke(stage, stage.colours.faint, 1, [8, 4, 2, 4]);
}

function drawJoint(stage, joint) {
  const a = stage.motion.place(joint.a, stage.now);
  const b = stage.motion.place(joint.b, stage.now);
  if (joint.symbol === "rod") {
    trace(stage, [a, b], false);
    stroke(stage, stage.colours.ink, 2.5);
  }
  if (!joint.symbol.startsWith("pin")) return;
  const {markers} = stage.model;
  const grounded = joint.symbol === "pin" && (markers[joint.a].body < 0 || markers[joint.b].body < 0);
  if (grounded) drawSupport(stage, b, 1.6 * pinPixels(stage) + 3);
  circle(stage, b, pinPixels(stage));
  fill(stage, stage.colours.paper, 1);
  stroke(stage, stage.colours.ink, 1.5);
}

/// Bearing and journal, the play between them drawn larger than it is.
function drawClearance(stage, contact) {
  const centre = stage.motion.place(contact.b, stage.now);
  const e = stage.motion.point(contact.name, ["ex", "ey"], stage.time);
  const factor = stage.exaggeration;
  const journal = Math.max(contact.radius - factor * contact.clearance, 0.05 * contact.radius);
  circle(stage, centre, contact.radius * stage.scale);
  fill(stage, stage.colours.paper, 1);
  stroke(stage, stage.colours.ink, 1.5);
  circle(stage, {x: centre.x + factor * e.x, y: centre.y + factor * e.y}, journal * stage.scale);
  fill(stage, stage.colours.ink, 0.3);
  stroke(stage, stage.colours.ink, 1.5);
}

// Paths, words

function drawPath(stage, path, i) {
  const colour = stage.colours.bodies[(i + 3) % stage.colours.bodies.length];
  const every = Math.max(1, Math.floor(path.t.length / 1500));
  const points = [];
  const done = [];
  for (let k = 0; k < path.t.length; k += every) {
    const point = {x: path.x[k], y: path.y[k]};
    points.push(point);
    if (path.t[k] <= stage.time) done.push(point);
  }
  stage.context.globalAlpha = 0.35;
  trace(stage, points, false);
  stroke(stage, colour, 1);
  stage.context.globalAlpha = 1;
  trace(stage, done, false);
  stroke(stage, colour, 1.75);
}

function write(stage, text, x, y, colour, align = "left") {
  const {context} = stage;
  context.font = "12px system-ui, sans-serif";
  context.textAlign = align;
  context.textBaseline = "middle";
  context.lineWidth = 3;
  context.strokeStyle = stage.colours.paper;
  context.strokeText(text, x, y);
  context.fillStyle = colour;
  context.fillText(text, x, y);
}

/// Names of bodies in their middle, of joints beside them; what would cover another name is left out.
function drawNames(stage) {
  const taken = [];
  const place = (text, x, y, colour, align) => {
    const width = 7 * text.length;
    const left = align === "center" ? x - width / 2 : x;
    if (taken.some(([l, r, h]) => left < r && left + width > l && Math.abs(h - y) < 14)) return;
    taken.push([left, left + width, y]);
    write(stage, text, x, y, colour, align);
  };
  stage.model.bodies.forEach((body, b) => {
    const [x, y] = stage.px(stage.now[b]);
    place(body.name, x, y, bodyColour(stage, b), "center");
  });
  for (const thing of [...stage.model.joints, ...stage.model.contacts.filter((c) => c.radius)]) {
    const [x, y] = stage.px(stage.motion.place(thing.b, stage.now));
    if (thing.symbol !== "none") place(thing.name, x + 12, y - 12, stage.colours.ink, "left");
  }
}

function drawScaleBar(stage) {
  const length = roundBelow(110 / stage.scale);
  const pixels = length * stage.scale;
  const [x, y] = [16, stage.height - 18];
  const {context} = stage;
  context.beginPath();
  context.moveTo(x, y - 4);
  context.lineTo(x, y);
  context.lineTo(x + pixels, y);
  context.lineTo(x + pixels, y - 4);
  stroke(stage, stage.colours.ink, 1.25);
  write(stage, engineering(length, "m"), x + pixels + 8, y - 2, stage.colours.ink);
}

/// What is not drawn as it is.
function drawNotes(stage) {
  const notes = [];
  if (stage.clearances.length > 0 && stage.exaggeration !== 1)
    notes.push(`clearance drawn ${plain(stage.exaggeration, 3)} times as large`);
  if (stage.meshes.some((m) => m) && stage.deformation !== 1) notes.push(`deformation drawn ${plain(stage.deformation, 3)} times as large`);
  const {happening} = stage;
  if (happening) notes.push(`${happening[0]}: ${happening[2]}`);
  notes.forEach((note, i) => write(stage, note, 16, 18 + 17 * i, stage.colours.faint));
}
