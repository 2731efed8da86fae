// Has the page tell the size of its 3-D view in CSS pixels, as the panels have theirs. viser tells what is
// drawn: more on a fine screen, and fewer while drawing is slow.
() => {
  const SOON = 20; // ms between two looks for viser's page

  function start() {
    const viewer = window.__viserMutable;
    if (!viewer?.sendMessage || !viewer.canvas) return setTimeout(start, SOON);
    const { canvas, sendMessage } = viewer;
    viewer.sendMessage = (message) => {
      if (message.type !== "ViewerCameraMessage") return sendMessage(message);
      sendMessage({ ...message, image_width: canvas.clientWidth, image_height: canvas.clientHeight });
    };
    viewer.sendCamera?.(); // what was told before was in other pixels
  }

  start();
}
