/* Numbers as text. */

/** Text of a number at an axis with ticks that far apart. */
export function tickText(value, step) {
  const size = Math.max(Math.abs(value), step || 0);
  if (Math.abs(value) < (step || 0) * 1e-6) return "0";
  if (size >= 1e5 || size < 1e-3) return value.toExponential(2).replace(/\.?0+e/, "e").replace("e+", "e");
  if (!step) return String(Number(value.toPrecision(4)));
  return value.toFixed(Math.max(0, Math.min(10, -Math.floor(Math.log10(step) + 1e-9))));
}

/** Text of a value to six digits. */
export function valueText(value) {
  if (!isFinite(value)) return String(value);
  const size = Math.abs(value);
  if (size !== 0 && (size >= 1e7 || size < 1e-4)) return value.toExponential(4);
  return String(Number(value.toPrecision(6)));
}
