"use strict";
/* Inputs and parameters: sliders, keys and gamepad axes; what changed is sent together, sixty times a second at most. */

/** Value of a control for a gamepad axis between -1 and 1; within the dead zone that of the middle. */
function axisValue(binding, position) {
  const size = Math.abs(position), zone = binding.dead_zone;
  const share = size <= zone ? 0 : Math.sign(position) * Math.min(1, (size - zone) / (1 - zone));
  return binding.low + (share + 1) / 2 * (binding.high - binding.low);
}

class DriveControls {
  /** controls, keyMap: as the server says hello; element: for the sliders; send: takes name to value. */
  constructor(element, controls, keyMap, send) {
    this.keyMap = keyMap;
    this.send = send;
    this.rows = new Map();
    this.pending = {};
    this.held = new Map();
    this.enabled = true;
    this.moved = new Set();
    element.replaceChildren();
    for (const control of controls) this.rows.set(control.name, this.row(element, control));
    window.addEventListener("keydown", event => this.key(event, true));
    window.addEventListener("keyup", event => this.key(event, false));
    window.addEventListener("blur", () => this.letGo());
    window.addEventListener("gamepaddisconnected", () => this.gamepadGone());
  }

  row(element, control) {
    const box = document.createElement("div"), label = document.createElement("label"), output = document.createElement("output");
    const input = document.createElement("input");
    box.className = "slider";
    input.type = "range";
    input.min = control.low;
    input.max = control.high;
    input.step = control.kind === "Real" ? "any" : 1;
    input.value = control.start;
    input.id = `control-${this.rows.size}`;
    label.htmlFor = input.id;
    label.textContent = control.name + (control.unit ? ` in ${control.unit}` : "") + (control.is_input ? "" : " (parameter)");
    output.textContent = contactPlots.valueText(control.start);
    input.oninput = () => this.set(control.name, Number(input.value));
    input.ondblclick = () => this.set(control.name, control.start);
    box.append(label, output, input);
    element.append(box);
    return {control, input, output};
  }

  set(name, value) {
    const row = this.rows.get(name);
    if (!row || !this.enabled) return;
    this.display(row, value);
    this.pending[name] = value;
    if (this.timer) return;
    this.timer = setTimeout(() => {
      this.timer = null;
      const values = this.pending;
      this.pending = {};
      this.send(values);
    }, 0);
  }

  display(row, value) {
    row.input.value = value;
    row.output.textContent = contactPlots.valueText(value);
  }

  /** Values as the machine has them: where time went back. */
  show(values) {
    for (const [name, value] of Object.entries(values)) {
      if (this.rows.has(name)) this.display(this.rows.get(name), value);
    }
  }

  /** All controls at their start: after a reset. */
  rest() {
    for (const row of this.rows.values()) this.display(row, row.control.start);
  }

  enable(on) {
    this.enabled = on;
    for (const row of this.rows.values()) row.input.disabled = !on;
    if (!on) this.held.clear();
  }

  key(event, down) {
    if (event.target.type === "text" || event.target.tagName === "SELECT" || event.ctrlKey || event.metaKey || event.altKey) return;
    const binding = this.keyMap.keys.find(entry => entry.key === event.code);
    if (!binding || !this.enabled) return;
    event.preventDefault();
    if (down === this.held.has(event.code)) return;
    if (down) {
      this.held.set(event.code, binding);
      this.set(binding.control, binding.value);
    } else {
      this.held.delete(event.code);
      this.release(binding);
    }
  }

  release(binding) {
    const other = [...this.held.values()].reverse().find(entry => entry.control === binding.control);
    if (other) this.set(other.control, other.value);
    else if (binding.rest !== null) this.set(binding.control, binding.rest);
  }

  /** Keys count as let go when the page is left. */
  letGo() {
    const held = [...this.held.values()];
    this.held.clear();
    for (const binding of held) this.release(binding);
  }

  /** Reads the first gamepad; to be called with every picture. An axis counts from its first motion on. */
  poll() {
    if (!navigator.getGamepads || !this.enabled || !this.keyMap.axes.length) return;
    const pad = [...navigator.getGamepads()].find(entry => entry && entry.connected);
    if (!pad) return;
    for (const binding of this.keyMap.axes) {
      const position = pad.axes[binding.axis];
      if (position === undefined) continue;
      if (Math.abs(position) > binding.dead_zone) this.moved.add(binding.axis);
      if (!this.moved.has(binding.axis)) continue;
      const value = axisValue(binding, position);
      if (Math.abs(Number(this.rows.get(binding.control).input.value) - value) > 1e-3 * Math.abs(binding.high - binding.low)) {
        this.set(binding.control, value);
      }
    }
  }

  /** A gamepad that was unplugged stands in the middle. */
  gamepadGone() {
    for (const binding of this.keyMap.axes) {
      if (this.moved.has(binding.axis)) this.set(binding.control, axisValue(binding, 0));
    }
    this.moved.clear();
  }
}

if (typeof module !== "undefined") module.exports = {axisValue};
