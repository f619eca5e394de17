"use strict";

// The time that all parts of the page show, and what moves it.

class Clock {
  constructor(t, events, happenings) {
    this.t = t;  // times of rows, which steps go to
    this.begin = t[0] ?? 0;
    this.end = t.at(-1) ?? 0;
    this.time = this.begin;
    this.pointed = null;  // under the pointer, in a plot
    this.events = events;          // times of impacts
    this.happenings = happenings;  // of the scene's events: [name, time, what it did]
    this.plots = new Set();  // those over time, which are zoomed together
    this.listeners = [];
    this.playing = false;
    this.seconds = 8;  // that the whole motion takes to play
    this.repeats = false;
  }

  listen(listener) {
    this.listeners.push(listener);
  }

  tell() {
    for (const listener of this.listeners) listener();
  }

  set(time) {
    this.time = Math.min(Math.max(time, this.begin), this.end);
    this.tell();
  }

  point(time) {
    if (time === this.pointed) return;
    this.pointed = time;
    this.tell();
  }

  /// From the row shown to one so many rows further.
  step(rows) {
    const i = nearestIndex(this.t, this.time) + rows;
    this.set(this.t[Math.min(Math.max(i, 0), this.t.length - 1)]);
  }

  /// "2.500 ms"
  text() {
    const {factor, unit} = scaleFor(this.end, "s");
    return `${(this.time * factor).toFixed(3)} ${unit}`;
  }

  toggle() {
    this.playing = !this.playing;
    if (this.playing && this.time >= this.end) this.time = this.begin;
    this.last = null;
    if (this.playing) requestAnimationFrame((now) => this.advance(now));
    this.tell();
  }

  advance(now) {
    if (!this.playing) return;
    const passed = this.last === null ? 0 : (now - this.last) / 1000;
    this.last = now;
    const time = this.time + (passed * (this.end - this.begin)) / this.seconds;
    if (time >= this.end && !this.repeats) this.playing = false;
    this.set(time >= this.end && this.repeats ? this.begin + ((time - this.begin) % (this.end - this.begin)) : time);
    requestAnimationFrame((next) => this.advance(next));
  }

  /// All plots show the times that this one shows.
  zoom(plot) {
    if (this.zooming) return;
    this.zooming = true;
    const {min, max} = plot.scales.x;
    for (const other of this.plots)
      if (other !== plot && (other.scales.x.min !== min || other.scales.x.max !== max)) other.setScale("x", {min, max});
    this.zooming = false;
    this.tell();
  }
}
