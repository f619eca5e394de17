"use strict";

// The motion in one mode at a time: mode k, counted from 0, has the times from 2k to 2k + 1, which is one period.

class ModeClock extends Clock {
  constructor(t) {
    super(t, [], []);
    this.modes = Math.floor((this.end + 1) / 2);
    this.repeats = true;
    this.seconds = 2;
    this.choose(0);
  }

  choose(mode) {
    this.begin = 2 * mode;
    this.end = this.begin + 1;
    this.set(this.begin);
  }

  step(rows) {
    this.set(Math.min(Math.max(this.t[nearestIndex(this.t, this.time) + rows] ?? this.time, this.begin), this.end));
  }

  text() {
    return `phase ${Math.round(360 * (this.time - this.begin))}°`;
  }
}

function modeText(mode, k) {
  const words = [mode.kind];
  if (mode["frequency [Hz]"] > 0) words.push(engineering(mode["frequency [Hz]"], "Hz", 4), `damping ${plain(mode["damping ratio"], 3)}`);
  return `${k + 1}: ${words.filter((word) => word).join(", ")}`;
}

/// A list of modes, of which the chosen one moves.
function listModes(clock, modes) {
  const select = byId("mode");
  select.parentElement.hidden = false;
  select.append(...modes.slice(0, clock.modes).map((mode, k) => element("option", {value: k, textContent: modeText(mode, k)})));
  select.onchange = () => clock.choose(Number(select.value));
}
