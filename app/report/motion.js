"use strict";

// Where bodies and the points on them are, from the columns of trajectory.csv.

class Motion {
  constructor(model, sheet) {
    this.model = model;
    this.t = sheet.t;
    this.sheet = sheet;
    const column = (name) => this.column(name);
    this.bodies = model.bodies.map(({name, modes}) => ({
                                     x: column(`${name}.x`),
                                     y: column(`${name}.y`),
                                     angle: column(`${name}.angle`),
                                     modes: Array.from({length: modes}, (_, i) => column(`${name}.mode ${i + 1}`)),
                                   }));
  }

  /// The values of a column, null if there is none.
  column(name) {
    return this.sheet.columns.get(name)?.y ?? null;
  }

  /// A function of time that gives the value of a column, straight between its rows.
  value(values, time) {
    const i = intervalOf(this.t, time);
    if (i + 1 >= this.t.length) return values[i];
    const share = Math.min(Math.max((time - this.t[i]) / (this.t[i + 1] - this.t[i]), 0), 1);
    return values[i] + share * (values[i + 1] - values[i]);
  }

  /// Of each body: its mass centre, angle and modal coordinates.
  poses(time) {
    return this.bodies.map((columns, b) => {
      const angle = this.value(columns.angle, time);
      const c = Math.cos(angle);
      const s = Math.sin(angle);
      const [ox, oy] = this.model.bodies[b].origin;
      return {
        x: this.value(columns.x, time) - c * ox + s * oy,
        y: this.value(columns.y, time) - s * ox - c * oy,
        angle,
        c,
        s,
        eta: columns.modes.map((values) => this.value(values, time)),
      };
    });
  }

  /// A marker in the world: its place and direction.
  place(number, poses) {
    const marker = this.model.markers[number];
    let [x, y] = marker.at;
    if (marker.body < 0) return {x, y, angle: marker.angle};
    const pose = poses[marker.body];
    let angle = marker.angle + pose.angle;
    pose.eta.forEach((eta, k) => {
      if (!marker.shape) return;
      x += marker.shape[0][k] * eta;
      y += marker.shape[1][k] * eta;
      angle += marker.slope[k] * eta;
    });
    return {...toWorld(pose, x, y), angle};
  }

  /// A force and a couple by the names of their columns, null where there are none. What the ground takes is shown as what it gives.
  force(name, on, time) {
    const [fx, fy, torque] = ["fx", "fy", "torque"].map((what) => this.column(`${name}.${what} on ${on}`));
    if (!(fx && fy) && !torque) return null;
    const of = (values) => (values ? (on === "ground" ? -1 : 1) * this.value(values, time) : 0);
    return {force: {x: of(fx), y: of(fy)}, couple: of(torque)};
  }

  /// Where a contact's columns put it, null without them.
  point(name, [first, second], time) {
    const x = this.column(`${name}.${first}`);
    const y = this.column(`${name}.${second}`);
    return x && y ? {x: this.value(x, time), y: this.value(y, time)} : null;
  }

  /// Every force and couple of joints, contacts, loads and springs at a time, with the place where it acts.
  forces(time, poses) {
    const out = [];
    const add = (kind, name, on, at) => {
      const force = at && this.force(name, on, time);
      if (force) out.push({kind, name, at, ...force});
    };
    for (const j of this.model.joints) add("joint", j.name, j.on, this.place(j.acts, poses));
    for (const c of this.model.contacts)
      add("contact", c.name, c.on, c.eccentric ? this.place(c.b, poses) : this.point(c.name, ["x", "y"], time));
    for (const f of this.model.forces) add(f.spring ? "spring" : "load", f.name, f.on, this.place(f.b, poses));
    return out;
  }
}

function toWorld(pose, x, y) {
  return {x: pose.x + pose.c * x - pose.s * y, y: pose.y + pose.s * x + pose.c * y};
}

/// A flexible body's mesh, ready to be bent.
class BentMesh {
  constructor(json) {
    this.points = Float64Array.from(json.points);
    this.of = json.of;
    this.triangles = integersOf(json.triangles);
    this.rim = integersOf(json.rim);
    this.shapes = floatsOf(json.shapes);
    this.stresses = floatsOf(json.stresses ?? "");
    this.count = this.points.length / 2;
    this.world = new Float64Array(this.points.length);
    this.mises = new Float64Array(this.count);
    this.loops = loopsOf(this.rim);
  }

  /// Puts the drawn points into `world`, the deformation so many times as large.
  bend(pose, exaggeration) {
    const {points, shapes, world, count} = this;
    for (let p = 0; p < count; ++p) {
      let x = points[2 * p];
      let y = points[2 * p + 1];
      for (let k = 0, at = 2 * p; k < pose.eta.length; ++k, at += 2 * count) {
        x += exaggeration * shapes[at] * pose.eta[k];
        y += exaggeration * shapes[at + 1] * pose.eta[k];
      }
      world[2 * p] = pose.x + pose.c * x - pose.s * y;
      world[2 * p + 1] = pose.y + pose.s * x + pose.c * y;
    }
  }

  /// Puts von Mises' stress of each point into `mises` [Pa]; returns the greatest.
  stress(eta) {
    const {stresses, mises, count} = this;
    let greatest = 0;
    for (let p = 0; p < count; ++p) {
      let xx = 0, yy = 0, xy = 0, zz = 0;
      for (let k = 0, at = 4 * p; k < eta.length; ++k, at += 4 * count) {
        xx += stresses[at] * eta[k];
        yy += stresses[at + 1] * eta[k];
        xy += stresses[at + 2] * eta[k];
        zz += stresses[at + 3] * eta[k];
      }
      mises[p] = Math.sqrt(Math.max(xx * xx + yy * yy + zz * zz - xx * yy - yy * zz - zz * xx + 3 * xy * xy, 0));
      if (mises[p] > greatest) greatest = mises[p];
    }
    return greatest;
  }

  /// The greatest at all rows of the modal coordinates. It is a norm, so a row's is at most that of a row before and what each shape
  /// alone has by the change since; where that is too little the row is passed over.
  greatestStress(modes) {
    const alone = modes.map((_, k) => this.stress(modes.map((_, j) => Number(j === k))));
    let [greatest, last, before] = [0, 0, modes.map(() => 0)];
    for (let row = 0; row < (modes[0]?.length ?? 0); ++row) {
      const eta = modes.map((values) => values[row]);
      if (last + eta.reduce((sum, x, k) => sum + alone[k] * Math.abs(x - before[k]), 0) <= greatest) continue;
      [last, before] = [this.stress(eta), eta];
      greatest = Math.max(greatest, last);
    }
    return greatest;
  }

  /// The greatest displacement of a point [m].
  deflection(eta) {
    let greatest = 0;
    for (let p = 0; p < this.count; ++p) {
      let x = 0, y = 0;
      for (let k = 0, at = 2 * p; k < eta.length; ++k, at += 2 * this.count) {
        x += this.shapes[at] * eta[k];
        y += this.shapes[at + 1] * eta[k];
      }
      greatest = Math.max(greatest, Math.hypot(x, y));
    }
    return greatest;
  }
}

/// Lines, pairs of points, one after another as closed loops; null where some end is loose.
function loopsOf(lines) {
  const at = new Map();  // the lines of a point
  for (let k = 0; k < lines.length; ++k) at.set(lines[k], [...(at.get(lines[k]) ?? []), k >> 1]);
  if ([...at.values()].some((own) => own.length % 2 === 1)) return null;
  const used = new Uint8Array(lines.length / 2);
  const loops = [];
  for (let first = 0; first < used.length; ++first) {
    const loop = [];
    let point = lines[2 * first];
    for (let line = first; line !== undefined && !used[line]; line = at.get(point).find((other) => !used[other])) {
      used[line] = 1;
      loop.push(point);
      point = lines[2 * line] === point ? lines[2 * line + 1] : lines[2 * line];
    }
    if (loop.length > 0) loops.push(loop);
  }
  return loops;
}
