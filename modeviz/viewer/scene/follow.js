// Lets a page's camera glide after another's, until whoever looks takes hold of it: that switches the widget of
// following off, and what was sent while it was on is left out.
() => {
  const SOON = 50; // ms between two looks for the camera of a page that is still being built
  let newest;
  let waiting = 0;

  window.__modevizFollow = (...said) => {
    newest = said;
    clearTimeout(waiting);
    follow();
  };

  function follow() {
    const [position, target, widget, number] = newest;
    const viewer = window.__viserMutable;
    const controls = viewer?.cameraControl;
    const root = window.__viserSceneTree?.getState()[""];
    if (!controls || !root) return (waiting = setTimeout(follow, SOON));
    if (number === controls.modevizLeft) return;
    if (controls.modevizNumber === undefined) controls.addEventListener("controlstart", leave);
    Object.assign(controls, { modevizNumber: number, modevizWidget: widget });
    const [w, x, y, z] = root.wxyz;
    controls.setLookAt(...turned(position), ...turned(target), true);

    function leave() {
      const { modevizNumber, modevizLeft, modevizWidget } = controls;
      if (modevizNumber === modevizLeft) return;
      controls.modevizLeft = modevizNumber;
      viewer.sendMessage({ type: "GuiUpdateMessage", uuid: modevizWidget, updates: { value: false } });
    }

    function turned([a, b, c]) {
      const [i, j, k] = [y * c - z * b + w * a, z * a - x * c + w * b, x * b - y * a + w * c];
      return [a + 2 * (y * k - z * j), b + 2 * (z * i - x * k), c + 2 * (x * j - y * i)];
    }
  }
}
