// Keeps the labels of the scene apart: gives each a place beside its mark where it covers no other label and
// nothing of the floating panel, or takes it out of sight where there is none.
//
// A label belongs to its parent node, which stands at what it names. Earlier names have the first choice; a
// label whose parent has a visible ring has it before all but the card. The card hangs on a line that is one
// metre along x where it is made. A click on a label of a mount is one on its rubber.
// Where the labels are, and whether they have been drawn so, is in window.__modevizLabels, where the browser
// tests and whoever takes pictures read it.
(names, cardName, lineName, colors) => {
  const FONT = '-apple-system, BlinkMacSystemFont, "Segoe UI", "Roboto", "Helvetica Neue", Arial, sans-serif';
  const EM = 12; // px, of viser's labels at a scale of one
  const GAP = 9; // px between a mark's middle and its label
  const CARD_DISTANCES = [60, 100, 150, 210];
  const MARGIN = 6; // px to the picture's borders and to the floating panel
  const STEADY = 4; // px: a pointer that moved less has clicked

  const page = (window.__modevizLabels = { places: {}, areDrawn: false });
  const pen = document.createElement("canvas").getContext("2d");
  let drawn = "";
  let pressed = null;

  function size({ text, font_screen_scale: scale }) {
    pen.font = `${EM * scale}px ${FONT}`;
    const lines = text.split("\n");
    const { fontBoundingBoxAscent: ascent, fontBoundingBoxDescent: descent } = pen.measureText("x");
    const line = ascent + descent;
    const width = Math.max(...lines.map((each) => pen.measureText(each).width));
    return [width + 0.4 * line, (lines.length + 0.4) * line];
  }

  const box = (x, y, [width, height]) => ({
    left: x - width / 2,
    right: x + width / 2,
    top: y - height / 2,
    bottom: y + height / 2,
  });
  const overlap = (a, b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;

  // Offsets of a label's middle from its mark, the best first.
  function offsets([width, height], isCard) {
    const around = (gap, [across, down]) => [across * (gap + width / 2), down * (gap + height / 2)];
    if (isCard) {
      const directions = [[1, 1], [0.3, 1], [1, 0], [-0.3, 1], [-1, 1], [1, -1], [-1, 0], [-1, -1], [0, -1]];
      return CARD_DISTANCES.flatMap((gap) => directions.map((direction) => around(gap, direction)));
    }
    const directions = [[0, -1], [1, 0], [-1, 0], [0, 1], [0.6, -1], [-0.6, -1], [0.6, 1], [-0.6, 1]];
    return [GAP, 2.2 * GAP].flatMap((gap) => directions.map((direction) => around(gap, direction)));
  }

  // What floats over the picture, from its top left corner.
  function panel(canvas) {
    let found = document.querySelector(".mv .title");
    while (found?.parentElement && found.parentElement.offsetWidth < 0.9 * canvas.width) found = found.parentElement;
    if (!found) return [];
    const { left, right, top, bottom } = found.getBoundingClientRect();
    return [{
      left: left - canvas.left - MARGIN,
      right: right - canvas.left + MARGIN,
      top: top - canvas.top - MARGIN,
      bottom: bottom - canvas.top + MARGIN,
    }];
  }

  const parentOf = (name) => name.slice(0, name.lastIndexOf("/"));

  // The labels that want a place, those with the first choice first.
  function wanted(viewer, nodes) {
    const rank = (name) => (name === cardName ? 0 : nodes[`${parentOf(name)}/ring`]?.visibility ? 1 : 2);
    return [cardName, ...names]
      .filter((name) => nodes[name]?.effectiveVisibility && viewer.nodeRefFromName[parentOf(name)])
      .sort((a, b) => rank(a) - rank(b));
  }

  function place(viewer, nodes, canvas) {
    const { camera, nodePoseData, nodeRefFromName } = viewer;
    const taken = panel(canvas);
    const behind = camera.position.clone().multiplyScalar(2).sub(viewer.cameraControl.getTarget(camera.position.clone()));
    page.places = {};
    for (const name of wanted(viewer, nodes)) {
      const parent = nodeRefFromName[parentOf(name)];
      const mark = parent.getWorldPosition(camera.position.clone()).project(camera);
      const [x, y] = [((mark.x + 1) / 2) * canvas.width, ((1 - mark.y) / 2) * canvas.height];
      const extent = size(nodes[name].message.props);
      const inside = ({ left, right, top, bottom }) =>
        left > MARGIN && top > MARGIN && right < canvas.width - MARGIN && bottom < canvas.height - MARGIN;
      const free = offsets(extent, name === cardName).find(([across, down]) => {
        const there = box(x + across, y + down, extent);
        return inside(there) && !taken.some((other) => overlap(there, other));
      });
      let position = behind.clone();
      if (free && Math.abs(mark.z) < 1) {
        position = mark.clone();
        position.x += (2 * free[0]) / canvas.width;
        position.y -= (2 * free[1]) / canvas.height;
        position.unproject(camera);
        page.places[name] = box(x + free[0], y + free[1], extent);
        taken.push(page.places[name]);
      }
      if (name === cardName) hang(viewer, parent, position, !!page.places[name]);
      nodePoseData[name].position = parent.worldToLocal(position).toArray();
    }
  }

  // Draws the card's line from its mount to the middle of the card, which covers the line's end.
  function hang(viewer, parent, position, isShown) {
    const line = viewer.nodeRefFromName[lineName];
    if (!line) return;
    const along = parent.worldToLocal(position.clone());
    line.scale.setScalar(isShown ? along.length() : 1e-6);
    line.quaternion.setFromUnitVectors(along.clone().set(1, 0, 0), along.normalize());
  }

  // viser's labels are black on white; in the dark they are the other way round.
  function paint(viewer) {
    viewer.scene.traverse(({ material }) => {
      if (!material?.uniforms?.uLabelData || material.userData.painted) return;
      material.userData.painted = true;
      material.fragmentShader = material.fragmentShader
        .replace("vec4(1.0, 1.0, 1.0, 0.85", `vec4(${colors.paper.join()}, 0.85`)
        .replace("vec4(0.0, 0.0, 0.0, a)", `vec4(${colors.ink.join()}, a)`);
      material.needsUpdate = true;
      redraw(viewer);
    });
  }

  function redraw(viewer) {
    page.areDrawn = false;
    viewer.scene.onAfterRender = () => {
      // viser draws a picture before it has moved the labels
      if (viewer.getRenderRequestState !== "capture") page.areDrawn = true;
    };
    viewer.requestRender();
  }

  function frame() {
    if (window.__modevizLabels !== page) return;
    requestAnimationFrame(frame);
    const viewer = window.__viserMutable;
    if (!viewer?.scene || !viewer.camera || !viewer.cameraControl || !window.__viserSceneTree) return;
    paint(viewer); // viser makes the meshes of labels when it has drawn their letters
    const nodes = window.__viserSceneTree.getState();
    const canvas = viewer.canvas.getBoundingClientRect();
    const { camera } = viewer;
    const looks = [cardName, ...names].map((name) => {
      const ring = nodes[`${parentOf(name)}/ring`]?.visibility;
      const mark = viewer.nodePoseData[parentOf(name)]?.position;
      return [nodes[name]?.message.props.text, nodes[name]?.effectiveVisibility, ring, mark];
    });
    const isComplete = !!viewer.nodeRefFromName[lineName];
    const view = [isComplete, camera.matrixWorld.elements, camera.projectionMatrix.elements, panel(canvas), canvas];
    const now = JSON.stringify([looks, view]);
    if (now === drawn) return;
    drawn = now;
    place(viewer, nodes, canvas);
    redraw(viewer);
  }

  function at({ clientX, clientY }) {
    const canvas = window.__viserMutable.canvas.getBoundingClientRect();
    const point = [clientX - canvas.left, clientY - canvas.top, [0, 0]];
    return Object.keys(page.places).find((name) => overlap(page.places[name], box(...point)));
  }

  function press(event) {
    if (window.__modevizLabels !== page) return window.removeEventListener("pointerdown", press, true);
    pressed = event.target === window.__viserMutable?.canvas ? [event.clientX, event.clientY] : null;
  }

  function release(event) {
    if (window.__modevizLabels !== page) return window.removeEventListener("pointerup", release, true);
    if (!pressed || Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) > STEADY) return;
    const name = at(event);
    const rubber = name && `${parentOf(name)}/rubber`;
    if (!rubber || !window.__viserSceneTree.getState()[rubber]) return;
    window.__viserMutable.sendMessage({
      type: "SceneNodeClickMessage",
      name: rubber,
      instance_index: null,
      ray_origin: [0, 0, 0],
      ray_direction: [0, 0, 1],
      screen_pos: [0, 0],
      modifier: null,
      owner: "",
    });
  }

  window.addEventListener("pointerdown", press, true);
  window.addEventListener("pointerup", release, true);
  frame();
}
