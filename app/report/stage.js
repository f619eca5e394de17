"use strict";

// The picture of the mechanism: what it looks at, and what is drawn from the motion.

class Stage {
  constructor(canvas, motion) {
    this.canvas = canvas;
    this.context = canvas.getContext("2d");
    this.motion = motion;
    this.model = motion.model;
    this.meshes = this.model.bodies.map((body) => (body.mesh ? new BentMesh(body.mesh) : null));
    this.clearances = this.model.contacts.filter(({name, radius}) => radius && motion.column(`${name}.ex`) && motion.column(`${name}.ey`));
    this.show = {forces: true, paths: false, names: false, stress: false};
    this.exaggeration = this.model.exaggeration;
    this.deformation = this.model.deformation;
    this.arrows = 1;
    this.followed = -1;
    this.colours = palette(this.model.palette);
    this.measure();
    this.show.forces = this.motion.forces(motion.t[0], motion.poses(motion.t[0])).length > 0;
    this.paths = this.makePaths();
  }

  /// What of the whole motion is needed to scale the picture: its box, usual force and couple, kinds of forces.
  measure() {
    const box = [Infinity, Infinity, -Infinity, -Infinity];
    const [all, forces, couples] = [[], [], []];
    this.greatestDeflection = 0;
    for (const time of this.sampledTimes(60)) {
      const poses = this.motion.poses(time);
      this.widen(box, poses);
      const now = this.motion.forces(time, poses);
      all.push(...now);
      forces.push(Math.max(0, ...now.map(({force}) => Math.hypot(force.x, force.y))));
      couples.push(Math.max(0, ...now.map(({couple}) => Math.abs(couple))));
      this.meshes.forEach((mesh, b) => {
        if (mesh) this.greatestDeflection = Math.max(this.greatestDeflection, mesh.deflection(poses[b].eta));
      });
    }
    const usual = (sizes) => (sizes.sort((a, b) => a - b), sizes[Math.floor(0.9 * (sizes.length - 1))] || sizes.at(-1) || 0);
    const [force, couple, rounding] = [usual(forces), usual(couples) / this.model.length, 1e-9];
    this.usualForce = force > rounding * couple ? force : 0;
    this.usualCouple = couple > rounding * force ? couple * this.model.length : 0;
    const least = rounding * Math.max(force, couple);
    const acting = all.filter((one) => Math.hypot(one.force.x, one.force.y, one.couple / this.model.length) > least);
    this.kinds = [...new Set(acting.map(({kind}) => kind))];
    this.tips = this.usualForce > 0 ? acting.map(({at, force}) => [at, force.x, force.y, Math.max(Math.hypot(force.x, force.y), this.usualForce)]) : [];
    this.box = box[0] <= box[2] ? box : [-1, -1, 1, 1];
  }

  /// Of all rows; sought when it is first asked for.
  get greatestStress() {
    return this.stressFound ??= Math.max(0, ...this.meshes.map((mesh, b) => mesh?.greatestStress(this.motion.bodies[b].modes) ?? 0));
  }

  sampledTimes(most) {
    const {t} = this.motion;
    const count = Math.min(most, t.length);
    return Array.from({length: count}, (_, i) => t[Math.round((i * (t.length - 1)) / Math.max(count - 1, 1))]);
  }

  widen(box, poses) {
    const add = ({x, y}) => {
      box[0] = Math.min(box[0], x);
      box[1] = Math.min(box[1], y);
      box[2] = Math.max(box[2], x);
      box[3] = Math.max(box[3], y);
    };
    this.model.bodies.forEach((body, b) => {
      for (let i = 0; i < body.outline.length; i += 2) add(toWorld(poses[b], body.outline[i], body.outline[i + 1]));
      for (const profile of body.profiles) this.profilePoints(profile, poses).forEach(add);
      const mesh = this.meshes[b];
      if (!mesh) return;
      mesh.bend(poses[b], 1);
      for (let i = 0; i < mesh.world.length; i += 2) add({x: mesh.world[i], y: mesh.world[i + 1]});
    });
    for (const {marker, radius} of this.model.wheels) {
      const {x, y} = this.motion.place(marker, poses);
      add({x: x - radius, y: y - radius});
      add({x: x + radius, y: y + radius});
    }
    for (const joint of [...this.model.joints, ...this.model.actuators])
      for (const marker of [joint.a, joint.b])
        if (this.model.markers[marker].body >= 0 || joint.symbol !== "guide") add(this.motion.place(marker, poses));
  }

  profilePoints({marker, points}, poses) {
    const at = this.motion.place(marker, poses);
    const frame = {x: at.x, y: at.y, c: Math.cos(at.angle), s: Math.sin(at.angle)};
    return Array.from({length: points.length / 2}, (_, i) => toWorld(frame, points[2 * i], points[2 * i + 1]));
  }

  /// Paths of the points that the scene asks for, else of the pins that move.
  makePaths() {
    const {points, joints, markers} = this.model;
    if (points.length > 0)
      return points.map((name) => ({t: this.motion.t, x: this.motion.column(`${name}.x`), y: this.motion.column(`${name}.y`)}))
          .filter((p) => p.x && p.y);
    const pins = joints.filter((j) => j.symbol.startsWith("pin") && markers[j.a].body >= 0 && markers[j.b].body >= 0);
    if (pins.length === 0) return this.motion.bodies.map(({x, y}) => ({t: this.motion.t, x, y}));
    const t = this.sampledTimes(800);
    const poses = t.map((time) => this.motion.poses(time));
    return pins.map((j) => {
      const places = poses.map((p) => this.motion.place(j.b, p));
      return {t, x: places.map((p) => p.x), y: places.map((p) => p.y)};
    });
  }

  // The view: `centre` is where the middle of the picture looks, from the followed body if there is one.

  resize() {
    const [x0, y0, x1, y1] = this.box;
    const wanted = 90 + (1.1 * this.canvas.clientWidth * (y1 - y0)) / (x1 - x0 || 1);
    this.canvas.parentElement.style.height = `${Math.round(Math.min(Math.max(wanted, 300), 620))}px`;
    const ratio = window.devicePixelRatio || 1;
    const {clientWidth, clientHeight} = this.canvas;
    if (clientWidth === 0) return;
    this.canvas.width = Math.round(clientWidth * ratio);
    this.canvas.height = Math.round(clientHeight * ratio);
    this.ratio = ratio;
    this.width = clientWidth;
    this.height = clientHeight;
    if (!this.scale || this.fitted) this.fit();
  }

  fit() {
    const below = this.kinds.length > 0 ? 60 : 30;  // of the picture, for what is written there
    const margin = 1.18;
    const least = 0.02 * this.model.length;
    let box = this.box;
    for (let pass = 0; pass < 4; ++pass) {  // the smaller the scale, the longer are arrows beside the bodies
      const [x0, y0, x1, y1] = box;
      this.scale =
          Math.min(this.width / (margin * Math.max(x1 - x0, least)), (this.height - below) / (margin * Math.max(y1 - y0, least)));
      this.centre = {x: (x0 + x1) / 2, y: (y0 + y1) / 2 - (below - 30) / 2 / this.scale};
      box = this.withArrows();
    }
    this.fitted = true;
    this.followed = -1;
  }

  /// The box and the tips of usual arrows at the present scale; longer ones reach as far.
  withArrows() {
    const [x0, y0, x1, y1] = this.box;
    const length = usualLength(this) / this.scale / 1.1;  // part of the margin is theirs
    const [x, y] = [0, 1].map((axis) => this.tips.map(([at, fx, fy, size]) => (axis ? at.y : at.x) + ((axis ? fy : fx) / size) * length));
    return [x.reduce((a, b) => Math.min(a, b), x0), y.reduce((a, b) => Math.min(a, b), y0),
            x.reduce((a, b) => Math.max(a, b), x1), y.reduce((a, b) => Math.max(a, b), y1)];
  }

  zoom(factor, px = this.width / 2, py = this.height / 2) {
    const before = this.toWorld(px, py);
    this.scale *= factor;
    const after = this.toWorld(px, py);
    this.centre.x += before.x - after.x;
    this.centre.y += before.y - after.y;
    this.fitted = false;
  }

  pan(dx, dy) {
    this.centre.x -= dx / this.scale;
    this.centre.y += dy / this.scale;
    this.fitted = false;
  }

  follow(body) {
    this.followed = body;
    this.fitted = false;
    this.centre = body < 0 ? {x: (this.box[0] + this.box[2]) / 2, y: (this.box[1] + this.box[3]) / 2} : {x: 0, y: 0};
  }

  middle() {
    const pose = this.followed >= 0 ? this.now[this.followed] : {x: 0, y: 0};
    return {x: pose.x + this.centre.x, y: pose.y + this.centre.y};
  }

  toWorld(px, py) {
    const {x, y} = this.middle();
    return {x: x + (px - this.width / 2) / this.scale, y: y - (py - this.height / 2) / this.scale};
  }

  px({x, y}) {
    return [this.width / 2 + (x - this.looked.x) * this.scale, this.height / 2 - (y - this.looked.y) * this.scale];
  }

  draw(time) {
    this.now = this.motion.poses(time);
    if (!this.scale) this.resize();
    if (!this.scale) return;
    this.looked = this.middle();
    this.time = time;
    this.context.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    this.context.clearRect(0, 0, this.width, this.height);
    this.context.lineJoin = this.context.lineCap = "round";
    drawMechanism(this);
  }
}
