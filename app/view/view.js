"use strict";

// A scene as the server assembles it. The server finds every pose; this page draws what it is told, and tells what is dragged where.

const parts = {link: 0, joint: 1, journal: 2, bearing: 3, spring: 4, guide: 5, trace: 6, cylinder: 7, hatch: 8};
const element = (id) => document.getElementById(id);
const canvas = element("stage");
const context = canvas.getContext("2d");

let scene = null;          // what the server said last
let version = 0;           // of it
let freedom = -1;          // the one that is shown by arrows
let camera = null;         // {x, y, scale}: the middle [m], pixels a metre
let grabbed = null;        // {body, point, to} of a body, or {pan} of the background
let asking = false;        // a drag is on its way
const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(name);

// Talking with the server

async function ask(path, body) {
  const answer = await fetch(path, body === undefined ? {} : {method: "POST", body: JSON.stringify(body)});
  if (!answer.ok) throw new Error(`${answer.status}`);
  return answer.json();
}

function take(news) {
  if (news.version === undefined || news.error === undefined) return;
  const first = scene === null;
  version = news.version;
  element("error").textContent = news.error;
  element("error").hidden = news.error === "";
  if (news.lines) scene = news;
  if (scene) tell();
  if (scene && (first || !camera)) showAll();
  draw();
}

async function watch() {
  try {
    if (!grabbed) take(await ask(`now?known=${version}`));
  } catch {
    element("error").textContent = "the server has ended; start pintle view again";
    element("error").hidden = false;
  }
  setTimeout(watch, 400);
}

async function sendDrag() {
  if (asking || !grabbed || !grabbed.to) return;
  asking = true;
  const {body, point, to} = grabbed;
  grabbed.to = null;
  try {
    take(await ask("drag", {version, body, point, to}));
  } finally {
    asking = false;
    sendDrag();
  }
}

function tell() {
  element("title").textContent = scene.title || scene.file;
  document.title = scene.title || scene.file;
  element("mobility").textContent = scene.mobility === 0 ? "no degree of freedom" : scene.mobility === 1 ? "1 degree of freedom" : `${scene.mobility} degrees of freedom`;
  if (freedom >= scene.freedoms.length) freedom = -1;
  element("freedoms").replaceChildren(...scene.freedoms.map((_, k) => {
    const button = document.createElement("button");
    button.textContent = `${k + 1}`;
    button.title = `show degree of freedom ${k + 1} as velocities`;
    button.setAttribute("aria-pressed", `${k === freedom}`);
    button.onclick = () => {
      freedom = k === freedom ? -1 : k;
      tell();
      draw();
    };
    return button;
  }));
  element("drivers").textContent = scene.drivers.length > 0 ? `let go: ${scene.drivers.join(", ")}` : "";
  element("warnings").replaceChildren(...scene.warnings.map((text) => {
    const item = document.createElement("li");
    item.textContent = text;
    return item;
  }));
}

// Places

function showAll() {
  const box = [Infinity, Infinity, -Infinity, -Infinity];
  const moving = scene.lines.filter((l) => l.part !== parts.guide && l.part !== parts.hatch);
  for (const line of moving.length > 0 ? moving : scene.lines)
    for (let i = 0; i < line.points.length; i += 2) {
      box[0] = Math.min(box[0], line.points[i]), box[2] = Math.max(box[2], line.points[i]);
      box[1] = Math.min(box[1], line.points[i + 1]), box[3] = Math.max(box[3], line.points[i + 1]);
    }
  if (!(box[0] <= box[2])) return;
  const size = Math.max(box[2] - box[0], box[3] - box[1], 1e-9);
  const scale = Math.min(canvas.clientWidth / (box[2] - box[0] + 0.8 * size), canvas.clientHeight / (box[3] - box[1] + 0.8 * size));
  camera = {x: (box[0] + box[2]) / 2, y: (box[1] + box[3]) / 2, scale};
}

const px = (x, y) => [canvas.clientWidth / 2 + camera.scale * (x - camera.x), canvas.clientHeight / 2 - camera.scale * (y - camera.y)];
const metres = (event) => {
  const rect = canvas.getBoundingClientRect();
  return [camera.x + (event.clientX - rect.left - canvas.clientWidth / 2) / camera.scale,
          camera.y - (event.clientY - rect.top - canvas.clientHeight / 2) / camera.scale];
};

/// The body whose outline is under a place, or whose line is near it; -1.
function bodyAt([x, y]) {
  for (const line of [...scene.lines].reverse()) {
    if (line.part !== parts.link) continue;
    trace(line);
    context.lineWidth = 14;
    const [u, v] = px(x, y).map((p) => p * devicePixelRatio);
    if ((line.closed && context.isPointInPath(u, v)) || context.isPointInStroke(u, v)) return line.owner;
  }
  return -1;
}

// Drawing

function trace({points, closed}) {
  context.beginPath();
  for (let i = 0; i < points.length; i += 2) {
    const [u, v] = px(points[i], points[i + 1]);
    if (i === 0)
      context.moveTo(u, v);
    else
      context.lineTo(u, v);
  }
  if (closed) context.closePath();
}

const bodyColour = (owner) => `rgb(${scene.colours[owner].join(", ")})`;

function stroke(style, width) {
  context.strokeStyle = style;
  context.lineWidth = width;
  context.stroke();
}

function drawLine(line) {
  trace(line);
  if (line.part === parts.link) {
    context.globalAlpha = 0.3;
    context.fillStyle = bodyColour(line.owner);
    if (line.closed) context.fill();
    context.globalAlpha = 1;
    stroke(bodyColour(line.owner), 2);
  } else if (line.part === parts.hatch || line.part === parts.guide || line.part === parts.trace) {
    stroke(colour("--faint"), 1);
  } else {
    if (line.closed && line.part !== parts.joint) context.fillStyle = colour("--paper"), context.fill();
    stroke(colour("--ink"), 1.5);
  }
}

/// Velocities of one freedom, the longest a tenth of the picture.
function drawFreedom(arrows) {
  const longest = Math.max(...arrows.map(([, , vx, vy]) => Math.hypot(vx, vy)), 1e-300);
  const perUnit = (0.1 * Math.min(canvas.clientWidth, canvas.clientHeight)) / longest;
  for (const [x, y, vx, vy] of arrows) {
    const [u, v] = px(x, y);
    const [du, dv] = [perUnit * vx, -perUnit * vy];
    const length = Math.hypot(du, dv);
    if (length < 3) continue;
    const [eu, ev] = [du / length, dv / length];
    context.beginPath();
    context.moveTo(u, v);
    context.lineTo(u + du, v + dv);
    context.moveTo(u + du - 8 * eu - 4 * ev, v + dv - 8 * ev + 4 * eu);
    context.lineTo(u + du, v + dv);
    context.lineTo(u + du - 8 * eu + 4 * ev, v + dv - 8 * ev - 4 * eu);
    stroke("#c8281e", 2);
  }
}

function drawNames() {
  context.font = "12px system-ui, sans-serif";
  context.textAlign = "center";
  for (const body of scene.bodies) {
    const [u, v] = px(body.x, body.y);
    context.lineWidth = 3;
    context.strokeStyle = colour("--paper");
    context.strokeText(body.name, u, v);
    context.fillStyle = colour("--ink");
    context.fillText(body.name, u, v);
  }
}

function draw() {
  const ratio = devicePixelRatio || 1;
  const [w, h] = [Math.round(canvas.clientWidth * ratio), Math.round(canvas.clientHeight * ratio)];
  if (canvas.width !== w || canvas.height !== h) canvas.width = w, canvas.height = h;
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, canvas.clientWidth, canvas.clientHeight);
  if (!scene || !camera) return;
  const order = [parts.hatch, parts.guide, parts.trace, parts.link, parts.cylinder, parts.spring, parts.joint, parts.bearing, parts.journal];
  for (const part of order)
    for (const line of scene.lines)
      if (line.part === part) drawLine(line);
  drawNames();
  if (freedom >= 0) drawFreedom(scene.freedoms[freedom]);
}

// Hands

canvas.onpointerdown = (event) => {
  if (!scene || !camera) return;
  canvas.setPointerCapture(event.pointerId);
  const at = metres(event);
  const body = bodyAt(at);
  if (body < 0) {
    grabbed = {pan: at};
    return;
  }
  const pose = scene.bodies[body];
  const [dx, dy] = [at[0] - pose.x, at[1] - pose.y];
  const [c, s] = [Math.cos(pose.angle), Math.sin(pose.angle)];
  grabbed = {body, point: [c * dx + s * dy, -s * dx + c * dy], to: null};
};

canvas.onpointermove = (event) => {
  if (!grabbed) return;
  if (grabbed.pan) {
    const [x, y] = metres(event);
    camera.x += grabbed.pan[0] - x, camera.y += grabbed.pan[1] - y;
    draw();
    return;
  }
  grabbed.to = metres(event);
  sendDrag();
};

canvas.onpointerup = canvas.onpointercancel = () => {
  grabbed = null;
};

canvas.onwheel = (event) => {
  event.preventDefault();
  if (!camera) return;
  const before = metres(event);
  camera.scale *= Math.exp(-0.0015 * event.deltaY);
  const after = metres(event);
  camera.x += before[0] - after[0], camera.y += before[1] - after[1];
  draw();
};

element("again").onclick = async () => take(await ask("again", {}));
document.onkeydown = (event) => {
  if (event.key === "0" && scene) showAll(), draw();
  if (event.key === "Home") element("again").click();
};
new ResizeObserver(draw).observe(canvas);
watch();
