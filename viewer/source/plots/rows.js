/* Curves with x of their own as rows of a common x, as uPlot needs them. */

/**
 * Columns: the common x, ascending, and each curve's y: `undefined` where a curve has no point there, `null` where it has a gap
 * (not a number, or not positive on a logarithmic axis). An x that a curve has twice, as at a jump, keeps both rows.
 */
export function commonRows(series, { xLog, yLog } = {}) {
  const usable = (value, log) => isFinite(value) && (!log || value > 0);
  const points = series.map(curve => {
    const order = Array.from(curve.x.keys()).filter(k => usable(curve.x[k], xLog));
    return order.every((k, i) => !i || curve.x[order[i - 1]] <= curve.x[k]) ? order : order.sort((a, b) => curve.x[a] - curve.x[b]);
  });
  const first = series[0]?.x;
  if (series.every((curve, i) => curve.x === first && points[i].length === first.length)) {
    return [points.length ? points[0].map(k => first[k]) : [], ...series.map((curve, i) => points[i].map(k => valid(curve.y[k])))];
  }
  const next = series.map(() => 0), columns = [[], ...series.map(() => [])];
  for (;;) {
    let x = Infinity;
    series.forEach((curve, i) => { if (next[i] < points[i].length) x = Math.min(x, curve.x[points[i][next[i]]]); });
    if (x === Infinity) return columns;
    columns[0].push(x);
    series.forEach((curve, i) => {
      const k = points[i][next[i]], here = next[i] < points[i].length && curve.x[k] === x;
      columns[i + 1].push(here ? valid(curve.y[k]) : undefined);
      if (here) next[i] += 1;
    });
  }

  function valid(value) {
    return usable(value, yLog) ? value : null;
  }
}
