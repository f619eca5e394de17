"use strict";

// Buttons, sliders, keys and the pointer.

function keysOf(page) {
  const {clock, stage, events, actions} = page;
  const flip = (id) => () => byId(id).click();
  const view = (change) => () => (change(), page.redraw());
  return new Map([
    [" ", () => clock.toggle()],
    ["ArrowLeft", (shift) => clock.step(shift ? -10 : -1)],
    ["ArrowRight", (shift) => clock.step(shift ? 10 : 1)],
    ["Home", () => clock.set(clock.begin)],
    ["End", () => clock.set(clock.end)],
    ["n", () => events?.step(1)],
    ["p", () => events?.step(-1)],
    ["e", () => actions?.step(1)],
    ["E", () => actions?.step(-1)],
    ["+", view(() => stage.zoom(1.25))],
    ["=", view(() => stage.zoom(1.25))],
    ["-", view(() => stage.zoom(0.8))],
    ["0", flip("fit")],
    ["f", flip("show-forces")],
    ["s", flip("show-stress")],
    ["t", flip("show-paths")],
    ["l", flip("show-names")],
    ["?", () => byId("help").showModal()],
  ]);
}

const keyHelp = [
  ["Space", "play, pause"],
  ["← →", "one row back or forward; with Shift ten rows"],
  ["Home End", "first, last row"],
  ["p n", "previous, next impact"],
  ["E e", "previous event of the scene (with Shift), next event"],
  ["+ − 0", "zoom in, zoom out, show all"],
  ["f t l s", "forces, paths, names, stress on or off"],
  ["?", "this list"],
];

/// Keys act everywhere but where they have a meaning of their own.
function listenToKeys(page) {
  const keys = keysOf(page);
  byId("keys").append(...keyHelp.map(
      ([key, what]) => element(
          "tr", {}, element("td", {}, ...key.split(" ").map((k) => element("kbd", {textContent: k}))),
          element("td", {textContent: what}))));
  byId("help-button").onclick = () => byId("help").showModal();
  document.addEventListener("keydown", (event) => {
    const {target, key} = event;
    if (event.ctrlKey || event.metaKey || event.altKey || document.querySelector("dialog[open]")) return;
    if (target.matches("select, input[type=search]") ||
        (target.matches("input[type=range]") && target.id !== "scrub" && key.startsWith("Arrow")))
      return;
    if (key === " " && target.matches("button, summary, input[type=checkbox]")) return;
    const act = keys.get(key);
    if (!act) return;
    event.preventDefault();
    act(event.shiftKey);
  });
}

function listenToPointer(page) {
  const {canvas} = page.stage;
  const pointers = new Map();
  const spread = () => {
    const [a, b] = [...pointers.values()];
    return Math.hypot(a.x - b.x, a.y - b.y);
  };
  let moved = 0;
  canvas.addEventListener("pointerdown", (event) => {
    moved = 0;
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, {x: event.clientX, y: event.clientY});
  });
  for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, (event) => pointers.delete(event.pointerId));
  canvas.addEventListener("click", (event) => moved < 4 && page.plotOf(nameAt(page.stage, event.offsetX, event.offsetY)));
  canvas.addEventListener("pointermove", (event) => {
    const last = pointers.get(event.pointerId);
    if (!last) return;
    moved += Math.hypot(event.clientX - last.x, event.clientY - last.y);
    const before = pointers.size === 2 ? spread() : 0;
    pointers.set(event.pointerId, {x: event.clientX, y: event.clientY});
    if (pointers.size === 2)
      page.stage.zoom(spread() / before);
    else
      page.stage.pan(event.clientX - last.x, event.clientY - last.y);
    page.redraw();
  });
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    page.stage.zoom(Math.exp(-0.0015 * event.deltaY), event.offsetX, event.offsetY);
    page.redraw();
  }, {passive: false});
}

function listenToTransport({clock}) {
  byId("play").onclick = () => clock.toggle();
  byId("step-back").onclick = () => clock.step(-1);
  byId("step-on").onclick = () => clock.step(1);
  const scrub = byId("scrub");
  scrub.oninput = () => clock.set(clock.begin + scrub.value * (clock.end - clock.begin));
  const span = clock.end - clock.begin;
  const speeds = [2, 4, 8, 16, 32, 64].map((seconds) => [seconds, `all in ${seconds} s`]);
  if (span >= 0.5 && span <= 600) speeds.push([span, "as in reality"]);
  byId("speed").append(...speeds.map(([value, textContent]) => element("option", {value, textContent})));
  byId("speed").value = clock.seconds;
  byId("speed").onchange = ({target}) => (clock.seconds = Number(target.value));
  clock.listen(() => showTransport(clock));
}

function showTransport(clock) {
  byId("play").textContent = clock.playing ? "❚❚" : "▶";
  byId("play").ariaLabel = clock.playing ? "Pause" : "Play";
  byId("scrub").value = clock.end > clock.begin ? (clock.time - clock.begin) / (clock.end - clock.begin) : 0;
  byId("scrub").ariaValueText = byId("clock").textContent = clock.text();
}

/// The impacts and the scene's events above the slider.
function drawScrubMarks(clock) {
  markHappenings(byId("scrub-happenings"), clock, clock.begin, clock.end);
  const canvas = byId("scrub-marks");
  const ratio = window.devicePixelRatio || 1;
  canvas.width = canvas.clientWidth * ratio;
  canvas.height = canvas.clientHeight * ratio;
  const context = canvas.getContext("2d");
  context.fillStyle = css("--accent");
  const thumb = 8 * ratio;  // the slider's middle stays so far from its ends
  for (const time of clock.events)
    context.fillRect(
        thumb + ((time - clock.begin) / (clock.end - clock.begin || 1)) * (canvas.width - 2 * thumb) - ratio / 2, 0, ratio, canvas.height);
}

function listenToOptions(page) {
  const {stage} = page;
  const model = stage.model;
  for (const what of ["forces", "paths", "names", "stress"]) {
    const box = byId(`show-${what}`);
    box.checked = stage.show[what];
    box.onchange = () => ((stage.show[what] = box.checked), showColourBar(stage), page.redraw());
  }
  byId("stress-option").hidden = byId("show-stress").disabled = Boolean(page.data.modes) || !stage.meshes.some((mesh) => mesh);  // enlarged modes have none
  if (stage.show.stress) showColourBar(stage);
  byId("show-forces").parentElement.hidden = byId("show-forces").disabled = !stage.show.forces;
  byId("force-option").hidden = stage.usualForce === 0 && stage.usualCouple === 0;
  byId("arrows").oninput = ({target}) => ((stage.arrows = 2 ** target.value), page.redraw());
  slider(
      "clearance", stage.clearances.length > 0, stage.exaggeration, Math.max(4 * stage.exaggeration, 10),
      (x) => ((stage.exaggeration = x), page.redraw()));
  const visible = stage.greatestDeflection > 0 ? Math.max((0.2 * model.length) / stage.greatestDeflection, 10, 2 * stage.deformation) : 1;
  slider("deformation", stage.greatestDeflection > 0, stage.deformation, visible, (x) => ((stage.deformation = x), page.redraw()));
  byId("follow").append(
      element("option", {value: -1, textContent: "nothing"}),
      ...model.bodies.map(({name}, b) => element("option", {value: b, textContent: name})));
  byId("follow").onchange = ({target}) => (stage.follow(Number(target.value)), page.redraw());
  byId("zoom-in").onclick = () => (stage.zoom(1.25), page.redraw());
  byId("zoom-out").onclick = () => (stage.zoom(0.8), page.redraw());
  byId("fit").onclick = () => (stage.fit(), (byId("follow").value = -1), page.redraw());
}

/// A factor from 1 up, the slider even in its logarithm.
function slider(id, wanted, value, most, change) {
  byId(`${id}-option`).hidden = !wanted;
  const input = byId(id);
  const output = input.nextElementSibling;
  input.max = Math.log(most);
  input.value = Math.log(Math.max(value, 1));
  const show = (x) => (output.textContent = `× ${plain(x, 3)}`);
  show(value);
  input.oninput = () => {
    const x = Number(Math.exp(input.value).toPrecision(2));
    show(x);
    change(x);
  };
}

function showColourBar(stage) {
  byId("colour-bar").hidden = !stage.show.stress;
  byId("colour-bar").querySelector("i").style.background = scaleGradient;
  byId("colour-title").textContent = "von Mises";
  byId("colour-least").textContent = "0";
  byId("colour-most").textContent = engineering(stage.greatestStress, "Pa", 3);
}
