"use strict";
/* Plots of the newest seconds of chosen signals, one a unit, drawn by the report's Plot. */

const LIVE_SECONDS = 20;
const LIVE_PERIOD = 100;

class LivePlots {
  constructor(element, units) {
    this.element = element;
    this.units = units;
    this.names = [];
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
      if (!groups.has(unit)) groups.set(unit, []);
      groups.get(unit).push(k);
    });
    this.plots = [...groups].map(([unit, members]) => {
      const box = document.createElement("div");
      this.element.append(box);
      const empty = new Float64Array(0);
      const plot = new Plot(box, {title: "", xLabel: "time in s", yLabel: unit ? `value in ${unit}` : "value",
        series: members.map(k => ({name: names[k], x: empty, y: empty}))}, {plots: []});
      return {plot, members};
    });
  }

  clear() {
    this.time = [];
    this.values = this.names.map(() => []);
  }

  /** Takes a sample of the signals; a time that goes back clears what came after it. */
  add(time, signals) {
    if (signals.length !== this.names.length || time === this.time[this.time.length - 1]) return;
    while (this.time.length && this.time[this.time.length - 1] > time) {
      this.time.pop();
      for (const values of this.values) values.pop();
    }
    this.time.push(time);
    this.values.forEach((values, k) => values.push(signals[k]));
    const old = lastNotAfter(this.time, time - LIVE_SECONDS);
    if (old > 200) {
      this.time.splice(0, old);
      for (const values of this.values) values.splice(0, old);
    }
    if (!this.timer) this.timer = setTimeout(() => { this.timer = null; this.draw(); }, LIVE_PERIOD);
  }

  draw() {
    if (!this.time.length) return;
    const time = Float64Array.from(this.time), last = time[time.length - 1];
    for (const {plot, members} of this.plots || []) {
      plot.spec.series.forEach((series, i) => {
        series.x = time;
        series.y = Float64Array.from(this.values[members[i]]);
      });
      plot.full = [Math.max(time[0], last - LIVE_SECONDS), last];
      if (!(plot.full[1] > plot.full[0])) plot.full = [last - 1, last];
      plot.range = plot.full.slice();
      plot.draw();
    }
  }
}
