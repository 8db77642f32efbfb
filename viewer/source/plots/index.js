/* What pages use of the plots. */

import { decodeArray } from "../arrays.js";
import { Plot } from "./plot.js";

export { LivePlots } from "./live_plots.js";
export { valueText } from "./numbers.js";

/** Makes the plots of a page from their encoded form, see plots.py; links is shared by those over time. */
export function makePlots(descriptions, links) {
  for (const description of descriptions) {
    const element = document.getElementById(description.id);
    if (!element) continue;
    const times = description.times.map(text => decodeArray(text, Float64Array));
    const series = description.series.map(curve => ({
      ...curve, x: times[curve.time], y: decodeArray(curve.values, Float32Array),
    }));
    new Plot(element, { ...description, series }, description.points || description.xLog ? undefined : links);
  }
}
