/* The controls of a viewer: what is drawn, cues of depth, cameras, outputs and lengths. */

import { CAMERAS, LENGTHS } from "./eyes.js";
import { Headset } from "./headset.js";
import { OUTPUTS } from "./outputs.js";

const DRAWN = { edges: "edges", floor: "floor", forces: "forces" };
const CUES = { perspective: "perspective", shading: "shading", shadows: "shadows", aerial: "haze", texture: "texture of the floor",
  knownSizes: "known sizes", headMotion: "motion by mouse" };
const LENGTH_NAMES = { eyeDistance: "eyes apart", convergenceDistance: "converge at", screenWidth: "screen width",
  viewingDistance: "screen at" };

/** Fills an element with the controls of a viewer; hasForces: whether there are forces to switch. */
export function makeViewControls(element, viewer, hasForces) {
  element.replaceChildren();
  const check = (id, text, on, change) => {
    const label = document.createElement("label"), input = document.createElement("input");
    label.className = "check";
    Object.assign(input, { type: "checkbox", id, checked: on });
    input.onchange = () => {
      change(input.checked);
      viewer.draw();
    };
    label.append(input, text);
    return label;
  };
  const shown = (id, name, text) => check(id, text, viewer.shown[name], on => { viewer.shown[name] = on; });
  element.append(check("follow", "follow", viewer.follow, on => { viewer.follow = on; }));
  for (const [name, text] of Object.entries(DRAWN)) if (name !== "forces" || hasForces) element.append(shown(name, name, text));
  const reset = button("view", "Reset view", () => viewer.reset());
  const details = document.createElement("details"), summary = document.createElement("summary");
  summary.textContent = "Views and cues of depth";
  details.className = "views";
  details.append(summary, row("Cues", Object.entries(CUES).map(([name, text]) => shown(`cue-${name}`, name, text))),
    row("Camera", cameras(viewer, check)), row("In m", Object.keys(LENGTHS).map(name => length(name, viewer))));
  if (viewer.world.known.name) details.querySelector("#cue-knownSizes").parentElement.append(` (${viewer.world.known.name})`);
  else details.querySelector("#cue-knownSizes").disabled = true;
  element.append(reset, details);
  offerHeadset(details, viewer);
}

function cameras(viewer, check) {
  const { view } = viewer;
  const choose = (id, label, options, name) => {
    const select = document.createElement("select");
    select.id = id;
    select.setAttribute("aria-label", label);
    select.append(...options.map(([value, text]) => new Option(text, value)));
    select.onchange = () => {
      view[name] = select.value;
      viewer.draw();
    };
    return select;
  };
  return [
    choose("camera", "camera", CAMERAS.map(name => [name, name === "central" ? "one, central" : `two, ${name} axes`]), "camera"),
    choose("output", "output", Object.entries(OUTPUTS), "output"),
    check("swapped", "swap eyes", view.swapped, on => { view.swapped = on; }),
  ];
}

function length(name, viewer) {
  const label = document.createElement("label"), input = document.createElement("input");
  label.className = "length";
  Object.assign(input, { type: "number", id: name, step: "any", min: 0, value: LENGTHS[name] ?? "", placeholder: "auto" });
  input.oninput = () => {
    const value = Number(input.value), good = value > 0 || name === "eyeDistance" && input.value !== "" && value === 0;
    input.setCustomValidity(good || input.value === "" ? "" : "a positive length in m");
    viewer.view.lengths[name] = good ? value : LENGTHS[name];
    viewer.draw();
  };
  label.append(`${LENGTH_NAMES[name]} `, input);
  return label;
}

async function offerHeadset(element, viewer) {
  if (!await Headset.isThere()) return;
  const enter = button("headset", "View in headset", async () => {
    try {
      await viewer.wear(() => { enter.textContent = "View in headset"; });
      if (viewer.headset.session) enter.textContent = "Leave headset";
    } catch (error) {
      enter.textContent = `The headset cannot be used: ${error.message}`;
    }
  });
  element.append(row("Headset", [enter]));
}

function row(name, members) {
  const box = document.createElement("div"), title = document.createElement("span");
  box.className = "controls";
  title.className = "soft";
  title.textContent = name;
  box.append(title, ...members);
  return box;
}

function button(id, text, action) {
  const made = document.createElement("button");
  Object.assign(made, { type: "button", id, textContent: text, onclick: action });
  return made;
}
