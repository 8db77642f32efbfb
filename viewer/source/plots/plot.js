/* Line plots by uPlot: hover values, zoom in time, series that switch on and off. */

import uPlot from "uplot";
import { lastNotAfter } from "../arrays.js";
import { tickText, valueText } from "./numbers.js";
import { commonRows } from "./rows.js";

const FONT = "12px system-ui, sans-serif";
const COLORS = 8;
const MOST_ROWS = 14;

/**
 * A plot in an element.
 * spec: {title, xLabel, yLabel, xLog, yLog, points, series: [{name, x, y, dashed, color, note}]}, x and y typed arrays.
 * links: {plots, onPick}; plots that share one zoom together, onPick gets the x that was clicked.
 */
export class Plot {
  constructor(element, spec, links) {
    this.element = element;
    this.spec = spec;
    this.links = links || { plots: [] };
    this.links.plots.push(this);
    this.single = Boolean(spec.points || spec.xLog);
    this.hidden = new Set();
    this.cursor = null;
    this.full = this.extent();
    this.build();
    this.zoomOne(this.full);
    let width = 0;
    new ResizeObserver(() => {
      if (this.box.clientWidth === width || !this.box.clientWidth) return;
      width = this.box.clientWidth;
      this.uplot.setSize(this.size());
      this.setCursor(this.cursor);
    }).observe(this.box);
  }

  extent() {
    const { xLog, series } = this.spec;
    let low = Infinity, high = -Infinity;
    for (const { x } of series) {
      for (const value of x) {
        if (!isFinite(value) || xLog && value <= 0) continue;
        low = Math.min(low, value);
        high = Math.max(high, value);
      }
    }
    if (!(low <= high)) return xLog ? [0.1, 10] : [0, 1];
    if (xLog) return [low / 1.6, high * 1.6];
    return low === high ? [low - 0.5, low + 0.5] : [low, high];
  }

  build() {
    const { element, spec } = this, head = make("div", "head"), title = make("h3"), reset = make("button");
    element.classList.add("plot");
    title.textContent = spec.title;
    Object.assign(reset, { type: "button", textContent: "Show all", onclick: () => this.zoom(this.full) });
    head.append(title, reset);
    this.box = make("div", "canvas");
    this.box.setAttribute("role", "img");
    this.box.setAttribute("aria-label", spec.title || `${spec.yLabel} over ${spec.xLabel}`);
    this.bubble = make("div", "bubble");
    this.bubble.hidden = true;
    element.append(head, this.box, this.bubble, this.legend());
    this.uplot = new uPlot(this.options(), commonRows(spec.series, spec), this.box);
    this.mark = make("div", "mark");
    this.mark.hidden = true;
    this.uplot.over.append(this.mark);
    this.listen();
    // A new look of the page, or paper, has other colours.
    const redraw = () => this.uplot.redraw(false);
    window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
    for (const moment of ["beforeprint", "afterprint"]) window.addEventListener(moment, redraw);
  }

  legend() {
    const legend = make("div", "legend");
    this.buttons = this.spec.series.map((series, k) => {
      const button = make("button"), mark = make("i", series.dashed ? "dashed" : ""), name = make("span");
      Object.assign(button, { type: "button", title: "click: show or hide; double-click: this one alone" });
      button.setAttribute("aria-pressed", "true");
      mark.style.color = `var(${this.color(k)})`;
      name.textContent = series.name;
      button.append(mark, name);
      button.onclick = () => this.show(i => i === k ? this.hidden.has(k) : !this.hidden.has(i));
      button.ondblclick = () => this.show(i => i === k);
      return button;
    });
    legend.append(...this.buttons);
    return legend;
  }

  options() {
    const { spec } = this, css = name => getComputedStyle(this.element).getPropertyValue(name);
    const ink = () => css("--ink"), grid = { stroke: () => css("--grid"), width: 1 };
    const texts = log => (_, splits) => {
      const step = splits.length > 1 ? splits[1] - splits[0] : 0;
      return splits.map(value => value === null ? "" : tickText(value, log ? 0 : step));
    };
    const axis = (label, log) => ({ label, labelFont: FONT, font: FONT, stroke: ink, grid, ticks: grid, values: texts(log) });
    const wide = (_, values) => 20 + 7 * Math.max(3, ...(values || []).map(text => text.length));
    return {
      ...this.size(),
      legend: { show: false },
      cursor: {
        y: false, points: { show: false }, drag: { x: !this.single, y: false, dist: 6, setScale: false },
        bind: { dblclick: () => () => this.zoom(this.full) },
      },
      scales: {
        x: { time: false, distr: spec.xLog ? 3 : 1, auto: false },
        y: { distr: spec.yLog ? 3 : 1, range: (_, low, high) => this.valueRange(low, high) },
      },
      axes: [{ ...axis(spec.xLabel, spec.xLog), size: 32, labelSize: 18, space: 80 }, { ...axis(spec.yLabel, spec.yLog), size: wide, labelSize: 18 }],
      series: [{}, ...spec.series.map((series, k) => ({
        label: series.name, stroke: () => css(this.color(k)), width: 1.6, dash: series.dashed ? [6, 4] : undefined,
        points: { show: Boolean(spec.points), size: 8, fill: () => css(this.color(k)) },
      }))],
      hooks: { setCursor: [() => this.hover()], setSelect: [() => this.zoomSelected()] },
    };
  }

  size() {
    return { width: this.box.clientWidth || 900, height: this.box.clientHeight || 270 };
  }

  color(k) {
    return `--c${(this.spec.series[k].color ?? k) % COLORS}`;
  }

  /** Shows the series for whose number `wanted` is true. */
  show(wanted) {
    this.hidden = new Set([...this.spec.series.keys()].filter(k => !wanted(k)));
    this.buttons.forEach((button, k) => button.setAttribute("aria-pressed", String(!this.hidden.has(k))));
    this.uplot.batch(() => this.buttons.forEach((_, k) => this.uplot.setSeries(k + 1, { show: !this.hidden.has(k) })));
  }

  /** Other curves of the same names. columns: x and a y for each; range: of x. */
  feed(columns, range) {
    this.spec.series.forEach((series, k) => Object.assign(series, { x: columns[0], y: columns[k + 1] }));
    this.full = this.range = range;
    this.uplot.batch(() => {
      this.uplot.setData(columns, false);
      this.uplot.setScale("x", { min: range[0], max: range[1] });
    });
  }

  /** Shows a range of x in all linked plots. */
  zoom(range) {
    for (const plot of this.links.plots) plot.zoomOne(range);
  }

  zoomOne([from, to]) {
    const { full } = this, range = [Math.max(from, full[0]), Math.min(to, full[1])];
    this.range = range[1] > range[0] ? range : full;
    this.element.classList.toggle("zoomed", this.range[0] > full[0] || this.range[1] < full[1]);
    this.uplot.setScale("x", { min: this.range[0], max: this.range[1] });
    this.setCursor(this.cursor);
  }

  zoomSelected() {
    const { left, width } = this.uplot.select;
    if (!(width > 0)) return;
    this.uplot.setSelect({ left: 0, width: 0, top: 0, height: 0 }, false);
    this.zoom([this.uplot.posToVal(left, "x"), this.uplot.posToVal(left + width, "x")]);
  }

  /** Marks an x; null: none. */
  setCursor(x) {
    this.cursor = x;
    const inside = x !== null && x >= this.range[0] && x <= this.range[1];
    this.mark.hidden = !inside;
    // From the range as told: uPlot carries out its own changes later.
    if (inside) this.mark.style.left = `${100 * (x - this.range[0]) / (this.range[1] - this.range[0])}%`;
  }

  valueRange(low, high) {
    const { yLog } = this.spec;
    if (low === null || !(low <= high)) return yLog ? [0.1, 10] : [0, 1];
    if (yLog) return [low / 1.8, high * 1.8];
    const pad = low === high ? Math.abs(low) * 0.1 || 1 : (high - low) * 0.06;
    return [low === 0 && high > 0 ? 0 : low - pad, high + pad];
  }

  listen() {
    const { over } = this.uplot;
    let start = null;
    over.addEventListener("pointerdown", event => { start = event.button === 0 ? event.offsetX : null; });
    over.addEventListener("pointerup", event => {
      if (start !== null && Math.abs(event.offsetX - start) < 6 && !this.single && this.links.onPick) {
        this.links.onPick(this.uplot.posToVal(event.offsetX, "x"));
      }
      start = null;
    });
    over.addEventListener("wheel", event => {
      if (this.single || !event.ctrlKey && !event.shiftKey) return;
      event.preventDefault();
      const at = this.uplot.posToVal(event.offsetX, "x"), factor = Math.exp((event.deltaY || event.deltaX) * 0.002);
      this.zoom(this.range.map(end => at + (end - at) * factor));
    }, { passive: false });
  }

  /** Values at the pointer: of points the nearest one, else of each series. */
  hover() {
    const { left } = this.uplot.cursor;
    this.bubble.hidden = true;
    if (!(left >= 0)) return;
    const [where, rows] = this.single ? this.nearestPoint(left) : this.valuesAt(this.uplot.posToVal(left, "x"));
    if (!rows.length) return;
    const head = make("b");
    head.textContent = `${this.spec.xLabel.replace(/ in .*/, "")} ${valueText(where)}`;
    this.bubble.replaceChildren(head, ...rows.slice(0, MOST_ROWS).map(([name, value, k]) => {
      const row = make("div"), text = make("span"), number = make("span");
      text.textContent = name;
      text.style.color = `var(${this.color(k)})`;
      number.textContent = valueText(value);
      row.append(text, number);
      return row;
    }));
    this.bubble.hidden = false;
    const at = left + this.uplot.over.offsetLeft, width = this.bubble.offsetWidth;
    this.bubble.style.left = `${at + 16 + width > this.element.clientWidth ? Math.max(0, at - 16 - width) : at + 16}px`;
    this.bubble.style.top = `${this.box.offsetTop + 14}px`;
  }

  valuesAt(x) {
    const shown = [...this.spec.series.entries()].filter(([k, series]) => !this.hidden.has(k) && series.x.length);
    return [x, shown.map(([k, series]) => {
      const before = lastNotAfter(series.x, x), after = Math.min(before + 1, series.x.length - 1);
      const nearest = Math.abs(series.x[after] - x) < Math.abs(x - series.x[before]) ? after : before;
      return [series.name, series.y[nearest] ?? NaN, k];
    })];
  }

  nearestPoint(left) {
    let best = null;
    for (const [k, series] of this.spec.series.entries()) {
      if (this.hidden.has(k)) continue;
      for (let i = 0; i < series.x.length; i++) {
        const off = Math.abs(this.uplot.valToPos(series.x[i], "x") - left);
        if (isFinite(series.y[i]) && (!best || off < best.off)) best = { off, k, series, i };
      }
    }
    if (!best) return [NaN, []];
    const { k, series, i } = best;
    return [series.x[i], [[series.note ? series.note[i] : series.name, series.y[i], k]]];
  }
}

function make(kind, className = "") {
  const element = document.createElement(kind);
  element.className = className;
  return element;
}
