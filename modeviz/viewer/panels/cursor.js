// Draws where a cursor is as a line in its charts, and puts it where one of them is clicked or the
// line is dragged to.
//
// Leans on viser's list of its charts as zoom.js does, and on the number box of its slider.
(slider, names, kind) => {
  const NEAR = 6; // px from the line within which it is taken, and within which a press is a click
  const cursors = (window.__modevizCursors ??= {}); // by what they move along
  const own = (cursors[kind] = {});
  const lines = new WeakMap();
  let pressed = null; // what a press began: its chart, where, and whether it moves the line

  const box = () => document.getElementById(slider)?.parentElement.querySelector(".mantine-NumberInput-input");

  function place() {
    const thumb = document.getElementById(slider)?.querySelector("[role=slider]");
    return thumb ? Number(thumb.getAttribute("aria-valuenow")) : NaN;
  }

  function put(value) {
    const input = box();
    if (!input || !Number.isFinite(value)) return;
    Object.getOwnPropertyDescriptor(HTMLInputElement.prototype, "value").set.call(input, value.toFixed(2));
    input.dispatchEvent(new Event("input", { bubbles: true }));
  }

  const charts = () => names.map((name) => window.__viserTestpoints?.uplots?.[name]?.chart).filter(Boolean);
  const at = (chart, event) => event.clientX - chart.over.getBoundingClientRect().left;

  function press(event) {
    const chart = charts().find(({ over }) => over.contains(event.target));
    if (!chart || event.button) return;
    const x = at(chart, event);
    const moves = Math.abs(x - chart.valToPos(place(), "x")) < NEAR;
    pressed = { chart, x, moves };
    if (moves) event.stopPropagation(); // else the chart would zoom
  }

  function move(event) {
    if (pressed?.moves) put(pressed.chart.posToVal(at(pressed.chart, event), "x"));
  }

  function release(event) {
    if (!pressed) return;
    const { chart, x } = pressed;
    if (!pressed.moves && Math.abs(at(chart, event) - x) < NEAR / 2) put(chart.posToVal(x, "x"));
    pressed = null;
  }

  function draw() {
    if (cursors[kind] !== own) {
      for (const [type, heard] of listeners) document.removeEventListener(type, heard, true);
      return;
    }
    requestAnimationFrame(draw);
    const value = place();
    for (const chart of charts()) {
      if (!lines.has(chart)) {
        const line = document.createElement("div");
        line.className = "mv-cursor";
        chart.over.append(line);
        lines.set(chart, line);
      }
      const x = chart.valToPos(value, "x");
      const line = lines.get(chart);
      line.style.display = x >= 0 && x <= chart.over.clientWidth ? "" : "none";
      line.style.left = `${x}px`;
    }
  }

  const listeners = [["mousedown", press], ["mousemove", move], ["mouseup", release]];
  for (const [type, heard] of listeners) document.addEventListener(type, heard, true);
  draw();
}
