"use strict";

// What of the drawing is under the pointer.

/// The name of the joint or clearance within a few pixels of a place in the picture, else of the body drawn there; null where there is none.
function nameAt(stage, x, y) {
  const {joints, contacts, bodies} = stage.model;
  const away = ({b, radius = 0}) => {
    const [px, py] = stage.px(stage.motion.place(b, stage.now));
    return Math.max(Math.hypot(px - x, py - y) - radius * stage.scale, 0);
  };
  const [nearest] = [...contacts.filter((c) => c.radius), ...joints.filter(({symbol}) => symbol !== "none")]
                        .map((thing) => [away(thing), thing.name])
                        .sort(([a], [b]) => a - b);
  if (nearest?.[0] <= 12) return nearest[1];
  return bodies.findLast((body, b) => isDrawnAt(stage, body, b, x, y))?.name ?? null;
}

/// Within an outline of the body or a few pixels from a line of it.
function isDrawnAt(stage, body, b, x, y) {
  const {context, ratio} = stage;
  const isHit = (closed, rule) => {
    context.lineWidth = 10;
    const at = [x * ratio, y * ratio];
    return context.isPointInStroke(...at) || (closed && context.isPointInPath(...at, rule));
  };
  const mesh = stage.meshes[b];
  if (mesh) {
    traceMesh(stage, mesh, bentPixels(stage, mesh, stage.now[b]));
    return isHit(true, fillRule(mesh));
  }
  return bodyOutlines(stage, body, b).some(({points, closed}) => (trace(stage, points, closed), isHit(closed, "nonzero")));
}
