"use strict";
/* Line plots in SVG: hover values, zoom in time, series that switch on and off. Shared by all reports. */

/** Decodes base64 into a typed array; the data is little-endian, as every browser's machine is. */
function decodeArray(text, Type) {
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let k = 0; k < binary.length; k++) bytes[k] = binary.charCodeAt(k);
  return new Type(bytes.buffer);
}

/** Index of the last element not greater than the value, in ascending numbers; 0 if there is none. */
function lastNotAfter(values, value) {
  let low = 0, high = values.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (values[middle] <= value) low = middle; else high = middle - 1;
  }
  return low;
}

/** Round tick positions within a range. */
function linearTicks(low, high, count) {
  const raw = (high - low) / Math.max(1, count);
  if (!(raw > 0) || !isFinite(raw)) return [low];
  const power = Math.pow(10, Math.floor(Math.log10(raw)));
  const step = [1, 2, 5, 10].map(f => f * power).find(s => s >= raw * 0.999);
  const ticks = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + step * 1e-9; k++) ticks.push(k * step);
  return ticks;
}

/** Powers of ten within a range of positive numbers, thinned to about the count; with 2 and 5 if there are few. */
function logTicks(low, high, count) {
  const first = Math.ceil(Math.log10(low) - 1e-9), last = Math.floor(Math.log10(high) + 1e-9);
  const every = Math.max(1, Math.ceil((last - first + 1) / Math.max(1, count)));
  const ticks = [];
  if (last - first < 2) {
    for (let p = first - 1; p <= last + 1; p++) {
      for (const f of [1, 2, 5]) {
        const value = f * Math.pow(10, p);
        if (value >= low * 0.999 && value <= high * 1.001) ticks.push(value);
      }
    }
    return ticks;
  }
  for (let p = first; p <= last; p += every) ticks.push(Math.pow(10, p));
  return ticks;
}

/** Text of a number at an axis with ticks that far apart. */
function tickText(value, step) {
  const size = Math.max(Math.abs(value), step || 0);
  if (Math.abs(value) < (step || 0) * 1e-6) return "0";
  if (size >= 1e5 || size < 1e-3) return value.toExponential(2).replace(/\.?0+e/, "e").replace("e+", "e");
  if (!step) return String(Number(value.toPrecision(4)));
  return value.toFixed(Math.max(0, Math.min(10, -Math.floor(Math.log10(step) + 1e-9))));
}

/** Text of a value to six digits. */
function valueText(value) {
  if (!isFinite(value)) return String(value);
  const size = Math.abs(value);
  if (size !== 0 && (size >= 1e7 || size < 1e-4)) return value.toExponential(4);
  return String(Number(value.toPrecision(6)));
}

/** Points of a polyline with at most four a pixel column: first, least, greatest, last; so that no spike is lost. */
function pixelPath(x, y, from, to, toX, toY) {
  const parts = [];
  let column = NaN, first = 0, least = 0, greatest = 0, last = 0, pen = false;
  const put = k => {
    const px = toX(x[k]), py = toY(y[k]);
    if (!isFinite(px) || !isFinite(py)) { pen = false; return; }
    parts.push((pen ? "L" : "M") + px.toFixed(1) + " " + py.toFixed(1));
    pen = true;
  };
  const flush = () => {
    if (isNaN(column)) return;
    const order = [...new Set([first, least, greatest, last])].sort((a, b) => a - b);
    order.forEach(put);
  };
  for (let k = from; k <= to; k++) {
    if (!isFinite(y[k])) { flush(); column = NaN; pen = false; continue; }
    const c = Math.floor(toX(x[k]));
    if (c !== column) { flush(); column = c; first = least = greatest = last = k; continue; }
    last = k;
    if (y[k] < y[least]) least = k;
    if (y[k] > y[greatest]) greatest = k;
  }
  flush();
  return parts.join("");
}

/**
 * A plot in an element.
 * spec: {title, xLabel, yLabel, xLog, yLog, points, series: [{name, x, y, dashed, color}]}, x and y typed arrays.
 * links: {plots, onPick}; plots that share an array zoom together, onPick gets the x that was clicked.
 */
class Plot {
  constructor(element, spec, links) {
    this.element = element;
    this.spec = spec;
    this.links = links || {plots: []};
    this.links.plots.push(this);
    this.hidden = new Set();
    this.cursor = null;
    const all = spec.series.flatMap(s => s.x.length ? [s.x[0], s.x[s.x.length - 1]] : []);
    const extremes = spec.points || spec.xLog ? spec.series.flatMap(s => Array.from(s.x)) : all;
    const usable = extremes.filter(v => isFinite(v) && (!spec.xLog || v > 0));
    this.full = usable.length ? [Math.min(...usable), Math.max(...usable)] : [0, 1];
    if (spec.xLog) this.full = [this.full[0] / 1.6, this.full[1] * 1.6];
    else if (this.full[0] === this.full[1]) this.full = [this.full[0] - 0.5, this.full[1] + 0.5];
    this.range = this.full.slice();
    this.build();
    this.draw();
    if (typeof ResizeObserver !== "undefined") {
      let width = 0;
      new ResizeObserver(() => {
        if (this.svg.clientWidth !== width) { width = this.svg.clientWidth; this.draw(); }
      }).observe(this.svg);
    }
  }

  build() {
    const el = this.element;
    el.classList.add("plot");
    const head = document.createElement("div");
    head.className = "head";
    const title = document.createElement("h3");
    title.textContent = this.spec.title;
    const reset = document.createElement("button");
    reset.type = "button";
    reset.textContent = "Show all";
    reset.onclick = () => this.zoom(this.full);
    head.append(title, reset);
    this.svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
    this.svg.setAttribute("role", "img");
    this.svg.setAttribute("aria-label", this.spec.title);
    this.bubble = document.createElement("div");
    this.bubble.className = "bubble";
    this.bubble.hidden = true;
    el.append(head, this.svg, this.bubble);
    const legend = document.createElement("div");
    legend.className = "legend";
    this.spec.series.forEach((series, k) => {
      const button = document.createElement("button");
      button.type = "button";
      button.setAttribute("aria-pressed", "true");
      button.title = "click: show or hide; double-click: this one alone";
      const mark = document.createElement("i");
      mark.style.color = this.color(k);
      if (series.dashed) mark.className = "dashed";
      const name = document.createElement("span");
      name.textContent = series.name;
      button.append(mark, name);
      button.onclick = () => this.toggle(k);
      button.ondblclick = () => this.only(k);
      legend.append(button);
    });
    this.buttons = [...legend.children];
    el.append(legend);
    this.listen();
  }

  color(k) {
    const series = this.spec.series[k];
    return `var(--c${(series.color === undefined ? k : series.color) % 8})`;
  }

  toggle(k) {
    if (this.hidden.has(k)) this.hidden.delete(k); else this.hidden.add(k);
    this.refreshLegend();
  }

  only(k) {
    this.hidden = new Set(this.spec.series.map((_, i) => i).filter(i => i !== k));
    this.refreshLegend();
  }

  refreshLegend() {
    this.buttons.forEach((b, i) => b.setAttribute("aria-pressed", String(!this.hidden.has(i))));
    this.draw();
  }

  zoom(range) {
    for (const plot of this.links.plots) {
      plot.range = [Math.max(range[0], plot.full[0]), Math.min(range[1], plot.full[1])];
      if (!(plot.range[1] > plot.range[0])) plot.range = plot.full.slice();
      plot.element.classList.toggle("zoomed", plot.range[0] > plot.full[0] || plot.range[1] < plot.full[1]);
      plot.draw();
    }
  }

  setCursor(x) {
    this.cursor = x;
    if (!this.cursorLine) return;
    const inside = x !== null && x >= this.range[0] && x <= this.range[1];
    this.cursorLine.setAttribute("visibility", inside ? "visible" : "hidden");
    if (inside) for (const a of ["x1", "x2"]) this.cursorLine.setAttribute(a, this.toX(x).toFixed(1));
  }

  valueRange() {
    let low = Infinity, high = -Infinity;
    this.spec.series.forEach((s, i) => {
      if (this.hidden.has(i)) return;
      const [from, to] = this.visible(s);
      for (let k = from; k <= to; k++) {
        const v = s.y[k];
        if (!isFinite(v) || (this.spec.yLog && v <= 0)) continue;
        if (v < low) low = v;
        if (v > high) high = v;
      }
    });
    if (!(low <= high)) return this.spec.yLog ? [0.1, 10] : [0, 1];
    if (this.spec.yLog) return [low / 1.8, high * 1.8];
    if (low === high) { const pad = Math.abs(low) * 0.1 || 1; return [low - pad, high + pad]; }
    const pad = (high - low) * 0.06;
    return [low === 0 ? 0 : low - pad, high + pad];
  }

  visible(series) {
    if (this.spec.points || this.spec.xLog) return [0, series.x.length - 1];
    const from = Math.max(0, lastNotAfter(series.x, this.range[0]) - 1);
    const to = Math.min(series.x.length - 1, lastNotAfter(series.x, this.range[1]) + 1);
    return [from, to];
  }

  draw() {
    const width = this.svg.clientWidth || 900, height = this.svg.clientHeight || 270;
    const spec = this.spec, [y0, y1] = this.valueRange(), [x0, x1] = this.range;
    const yTicks = spec.yLog ? logTicks(y0, y1, height / 45) : linearTicks(y0, y1, height / 48);
    const yStep = yTicks.length > 1 ? yTicks[1] - yTicks[0] : 0;
    const yTexts = yTicks.map(t => tickText(t, spec.yLog ? 0 : yStep));
    const left = 34 + 7.2 * Math.max(3, ...yTexts.map(t => t.length)), right = 14, top = 8, bottom = 44;
    this.box = {left, top, right: width - right, bottom: height - bottom};
    const box = this.box, log = Math.log10;
    this.toX = spec.xLog
      ? v => box.left + (log(v) - log(x0)) / (log(x1) - log(x0)) * (box.right - box.left)
      : v => box.left + (v - x0) / (x1 - x0) * (box.right - box.left);
    this.toY = spec.yLog
      ? v => box.bottom - (log(v) - log(y0)) / (log(y1) - log(y0)) * (box.bottom - box.top)
      : v => box.bottom - (v - y0) / (y1 - y0) * (box.bottom - box.top);
    const parts = [];
    const xTicks = spec.xLog ? logTicks(x0, x1, width / 90) : linearTicks(x0, x1, width / 110);
    const xStep = xTicks.length > 1 ? xTicks[1] - xTicks[0] : 0;
    for (const t of xTicks) {
      const px = this.toX(t).toFixed(1);
      parts.push(`<line class="gridline" x1="${px}" x2="${px}" y1="${box.top}" y2="${box.bottom}"/>`);
      parts.push(`<text x="${px}" y="${box.bottom + 17}" text-anchor="middle">${tickText(t, spec.xLog ? 0 : xStep)}</text>`);
    }
    yTicks.forEach((t, k) => {
      const py = this.toY(t).toFixed(1);
      const kind = t === 0 && y0 < 0 ? "zero" : "gridline";
      parts.push(`<line class="${kind}" x1="${box.left}" x2="${box.right}" y1="${py}" y2="${py}"/>`);
      parts.push(`<text x="${box.left - 7}" y="${+py + 4}" text-anchor="end">${yTexts[k]}</text>`);
    });
    const clip = this.clip || (this.clip = `clip${Math.floor(Plot.count++)}`);
    parts.push(`<clipPath id="${clip}"><rect x="${box.left}" y="${box.top}" width="${Math.max(0, box.right - box.left)}" height="${box.bottom - box.top}"/></clipPath>`);
    parts.push(`<g clip-path="url(#${clip})">`);
    spec.series.forEach((s, i) => {
      if (this.hidden.has(i) || !s.x.length) return;
      const [from, to] = this.visible(s);
      const y = spec.yLog ? Float64Array.from(s.y, v => v > 0 ? v : NaN) : s.y;
      const path = spec.points || spec.xLog ? this.joined(s.x, y) : pixelPath(s.x, y, from, to, this.toX, this.toY);
      if (path) parts.push(`<path class="curve${s.dashed ? " dashed" : ""}" style="stroke:${this.color(i)}" d="${path}"/>`);
      if (spec.points) {
        for (let k = 0; k < s.x.length; k++) {
          if (isFinite(y[k])) parts.push(`<circle r="4" style="fill:${this.color(i)}" cx="${this.toX(s.x[k]).toFixed(1)}" cy="${this.toY(y[k]).toFixed(1)}"/>`);
        }
      }
    });
    parts.push("</g>");
    parts.push(`<rect class="frame" x="${box.left}" y="${box.top}" width="${Math.max(0, box.right - box.left)}" height="${box.bottom - box.top}"/>`);
    parts.push(`<line class="cursor" y1="${box.top}" y2="${box.bottom}" visibility="hidden"/>`);
    parts.push(`<line class="cross" y1="${box.top}" y2="${box.bottom}" visibility="hidden"/>`);
    parts.push(`<rect class="brush" y="${box.top}" height="${box.bottom - box.top}" width="0" x="0" visibility="hidden"/>`);
    this.svg.innerHTML = parts.join("");
    const text = (value, x, y, turn) => {
      const node = document.createElementNS("http://www.w3.org/2000/svg", "text");
      node.setAttribute("class", "label");
      node.setAttribute("text-anchor", "middle");
      node.setAttribute("transform", `translate(${x} ${y})${turn ? " rotate(-90)" : ""}`);
      node.textContent = value;
      this.svg.append(node);
    };
    text(spec.xLabel, (box.left + box.right) / 2, height - 6, false);
    text(spec.yLabel, 14, (box.top + box.bottom) / 2, true);
    this.cursorLine = this.svg.querySelector(".cursor");
    this.cross = this.svg.querySelector(".cross");
    this.brush = this.svg.querySelector(".brush");
    this.setCursor(this.cursor);
  }

  joined(x, y) {
    const order = Array.from(x.keys()).filter(k => isFinite(y[k]) && isFinite(x[k]));
    return order.map((k, i) => `${i ? "L" : "M"}${this.toX(x[k]).toFixed(1)} ${this.toY(y[k]).toFixed(1)}`).join("");
  }

  fromX(px) {
    const share = (px - this.box.left) / (this.box.right - this.box.left);
    return this.range[0] + share * (this.range[1] - this.range[0]);
  }

  listen() {
    const svg = this.svg;
    let start = null;
    const place = event => event.clientX - svg.getBoundingClientRect().left;
    const inside = px => Math.min(this.box.right, Math.max(this.box.left, px));
    svg.addEventListener("pointerdown", event => {
      if (event.button !== 0 || this.spec.points || this.spec.xLog) return;
      start = inside(place(event));
      svg.setPointerCapture(event.pointerId);
    });
    svg.addEventListener("pointermove", event => {
      const px = place(event);
      if (start !== null && Math.abs(px - start) > 4) {
        const a = Math.min(start, inside(px)), b = Math.max(start, inside(px));
        this.brush.setAttribute("visibility", "visible");
        this.brush.setAttribute("x", a);
        this.brush.setAttribute("width", b - a);
      }
      this.hover(px);
    });
    svg.addEventListener("pointerup", event => {
      if (start === null) return;
      const from = start, to = inside(place(event));
      start = null;
      this.brush.setAttribute("visibility", "hidden");
      if (Math.abs(to - from) > 6) this.zoom([this.fromX(Math.min(from, to)), this.fromX(Math.max(from, to))]);
      else if (this.links.onPick) this.links.onPick(this.fromX(to));
    });
    svg.addEventListener("pointercancel", () => { start = null; this.brush.setAttribute("visibility", "hidden"); });
    svg.addEventListener("pointerleave", () => { this.bubble.hidden = true; this.cross.setAttribute("visibility", "hidden"); });
    svg.addEventListener("dblclick", () => this.zoom(this.full));
    svg.addEventListener("wheel", event => {
      if (!event.ctrlKey && !event.shiftKey) return;
      event.preventDefault();
      const at = this.fromX(inside(place(event))), factor = Math.exp((event.deltaY || event.deltaX) * 0.002);
      this.zoom([at + (this.range[0] - at) * factor, at + (this.range[1] - at) * factor]);
    }, {passive: false});
  }

  hover(px) {
    if (px < this.box.left || px > this.box.right) { this.bubble.hidden = true; return; }
    const rows = [];
    let where = "";
    if (this.spec.points || this.spec.xLog) {
      let best = null;
      this.spec.series.forEach((s, i) => {
        if (this.hidden.has(i)) return;
        for (let k = 0; k < s.x.length; k++) {
          const d = Math.abs(this.toX(s.x[k]) - px);
          if (isFinite(s.y[k]) && (!best || d < best.d)) best = {d, i, k};
        }
      });
      if (!best) return;
      const s = this.spec.series[best.i];
      where = valueText(s.x[best.k]);
      rows.push([s.note ? s.note[best.k] : s.name, valueText(s.y[best.k]), best.i]);
    } else {
      const x = this.fromX(px);
      where = valueText(x);
      this.spec.series.forEach((s, i) => {
        if (this.hidden.has(i) || !s.x.length) return;
        const k = lastNotAfter(s.x, x);
        const next = Math.min(k + 1, s.x.length - 1);
        const nearest = Math.abs(s.x[next] - x) < Math.abs(x - s.x[k]) ? next : k;
        rows.push([s.name, valueText(s.y[nearest]), i]);
      });
      this.cross.setAttribute("visibility", "visible");
      this.cross.setAttribute("x1", px);
      this.cross.setAttribute("x2", px);
    }
    this.bubble.replaceChildren();
    const head = document.createElement("b");
    head.textContent = `${this.spec.xLabel.replace(/ in .*/, "")} ${where}`;
    this.bubble.append(head);
    for (const [name, value, i] of rows.slice(0, 14)) {
      const row = document.createElement("div"), a = document.createElement("span"), b = document.createElement("span");
      a.textContent = name;
      a.style.color = this.color(i);
      b.textContent = value;
      row.append(a, b);
      this.bubble.append(row);
    }
    this.bubble.hidden = false;
    const width = this.bubble.offsetWidth, full = this.element.clientWidth;
    this.bubble.style.left = `${px + 16 + width > full ? Math.max(0, px - 16 - width) : px + 16}px`;
    const top = this.svg.getBoundingClientRect().top - this.element.getBoundingClientRect().top;
    this.bubble.style.top = `${top + 14}px`;
  }
}
Plot.count = 0;

/** Makes the plots of a page from their encoded form; links is shared by those of one time axis. */
function makePlots(descriptions, links) {
  for (const description of descriptions) {
    const element = document.getElementById(description.id);
    if (!element) continue;
    const times = description.times.map(t => decodeArray(t, Float64Array));
    const series = description.series.map(s => ({
      name: s.name, dashed: s.dashed, color: s.color, note: s.note,
      x: times[s.time], y: decodeArray(s.values, Float32Array),
    }));
    new Plot(element, {...description, series}, description.points || description.xLog ? undefined : links);
  }
}

if (typeof module !== "undefined") {
  module.exports = {decodeArray, lastNotAfter, linearTicks, logTicks, tickText, valueText, pixelPath};
}
