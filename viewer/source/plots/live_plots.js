/* Plots of the newest seconds of chosen signals, one a unit. */

import { lastNotAfter } from "../arrays.js";
import { Plot } from "./plot.js";

const SECONDS = 20;
const PERIOD = 100;

export class LivePlots {
  constructor(element, units) {
    this.element = element;
    this.units = units;
    this.names = [];
    this.plots = [];
    this.clear();
  }

  /** The signals plotted from now on. */
  show(names) {
    this.names = names;
    this.clear();
    this.element.replaceChildren();
    const groups = new Map();
    names.forEach((name, k) => {
      const unit = this.units[name] || "";
      groups.set(unit, [...groups.get(unit) ?? [], k]);
    });
    this.plots = [...groups].map(([unit, members]) => {
      const box = document.createElement("div");
      this.element.append(box);
      const plot = new Plot(box, { title: "", xLabel: "time in s", yLabel: unit ? `value in ${unit}` : "value",
        series: members.map(k => ({ name: names[k], x: [], y: [] })) });
      return { plot, members };
    });
  }

  clear() {
    this.time = [];
    this.values = this.names.map(() => []);
  }

  /** Takes a sample of the signals; a time that goes back clears what came after it. */
  add(time, signals) {
    if (signals.length !== this.names.length || time === this.time[this.time.length - 1]) return;
    while (this.time.length && this.time[this.time.length - 1] > time) for (const column of [this.time, ...this.values]) column.pop();
    this.time.push(time);
    this.values.forEach((values, k) => values.push(isFinite(signals[k]) ? signals[k] : null));
    const old = lastNotAfter(this.time, time - SECONDS);
    if (old > 200) for (const column of [this.time, ...this.values]) column.splice(0, old);
    if (!this.timer) this.timer = setTimeout(() => { this.timer = null; this.draw(); }, PERIOD);
  }

  draw() {
    if (!this.time.length) return;
    const last = this.time[this.time.length - 1], first = Math.max(this.time[0], last - SECONDS);
    for (const { plot, members } of this.plots) {
      plot.feed([this.time.slice(), ...members.map(k => this.values[k].slice())], [first < last ? first : last - 1, last]);
    }
  }
}
