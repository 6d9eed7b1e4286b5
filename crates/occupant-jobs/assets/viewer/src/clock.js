// The time of the page: one clock that the scene, the plots and the tables follow.

import { nearest } from "./data.js";

export const SPEEDS = [0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.25, 0.5, 1];

/** Playing the whole run should take about this long, s. */
const PLAY_S = 6;

export class Clock {
  constructor(runs) {
    this.times = runs[0].times;
    this.start = Math.min(...runs.map((run) => run.times[0]));
    this.end = Math.max(...runs.map((run) => run.times[run.times.length - 1]));
    this.time = this.start;
    this.playing = false;
    this.repeat = false;
    this.speed = this.fittingSpeed();
    this.listeners = [];
    this.lastFrame = 0;
    this.advance = this.advance.bind(this);
  }

  fittingSpeed() {
    const wanted = (this.end - this.start) / PLAY_S;
    const off = (speed) => Math.abs(Math.log(speed / Math.max(wanted, 1e-9)));
    return SPEEDS.reduce((best, speed) => (off(speed) < off(best) ? speed : best));
  }

  /** Calls `listener` now and at every change. */
  listen(listener) {
    this.listeners.push(listener);
    listener(this);
  }

  changed() {
    for (const listener of this.listeners) listener(this);
  }

  seek(time) {
    this.time = Math.min(Math.max(time, this.start), this.end);
    this.changed();
  }

  /** Goes to the output `count` after the present one. */
  step(count) {
    this.pause();
    const at = nearest(this.times, this.time) + count;
    this.seek(this.times[Math.min(Math.max(at, 0), this.times.length - 1)]);
  }

  play() {
    if (this.playing) return;
    if (this.time >= this.end) this.time = this.start;
    this.playing = true;
    this.lastFrame = performance.now();
    requestAnimationFrame(this.advance);
    this.changed();
  }

  pause() {
    if (!this.playing) return;
    this.playing = false;
    this.changed();
  }

  toggle() {
    if (this.playing) this.pause();
    else this.play();
  }

  setSpeed(speed) {
    this.speed = speed;
    this.changed();
  }

  /** The next faster (1) or slower (-1) speed. */
  shiftSpeed(by) {
    const at = SPEEDS.indexOf(this.speed) + by;
    this.setSpeed(SPEEDS[Math.min(Math.max(at, 0), SPEEDS.length - 1)]);
  }

  setRepeat(repeat) {
    this.repeat = repeat;
    this.changed();
  }

  advance(now) {
    if (!this.playing) return;
    const passed = Math.max(now - this.lastFrame, 0) / 1000;
    this.lastFrame = now;
    this.time += passed * this.speed;
    if (this.time >= this.end) {
      this.time = this.repeat ? this.start : this.end;
      this.playing = this.repeat;
    }
    if (this.playing) requestAnimationFrame(this.advance);
    this.changed();
  }
}
