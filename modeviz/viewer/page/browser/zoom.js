// Keeps how far a chart is zoomed when viser makes it anew, as it does for a response with other axes.
//
// Leans on viser's list of its charts as the browser tests do.
() => {
  const known = (window.__modevizZoom = {}); // of each chart: itself, where it began, and where it is

  const rangeOf = ({ scales: { x } }) => (x.min == null || x.max == null ? null : [x.min, x.max]);
  const isSame = (one, other) => one[0] === other[0] && one[1] === other[1];

  function follow(name, chart) {
    const range = rangeOf(chart);
    if (!range) return;
    const last = known[name];
    if (last?.chart === chart) {
      last.range = range;
      return;
    }
    const isKept = last && isSame(last.home, range) && !isSame(last.home, last.range);
    known[name] = { chart, home: range, range: isKept ? last.range : range };
    if (isKept) chart.setScale("x", { min: last.range[0], max: last.range[1] });
  }

  function frame() {
    if (window.__modevizZoom !== known) return;
    requestAnimationFrame(frame);
    const charts = window.__viserTestpoints?.uplots ?? {};
    for (const name in charts) follow(name, charts[name].chart);
  }
  frame();
}
