// Has every widget heard. viser's page sends at most one message of widgets in 50 ms, and of those between
// only the last, whichever widget it is of: what one widget said is lost if another speaks right after it.
// Here each widget has a pause of its own, and its last value always goes out, before any of another widget.
//
// viser starts its pause with setTimeout right after it has sent; that one is over as it begins.
() => {
  const PAUSE = 50; // ms, of viser and of ours
  const SOON = 20; // ms between two looks for viser's page

  const resting = new Map(); // of the widgets in their pause, the message to send after it, or none

  function start() {
    const viewer = window.__viserMutable;
    if (!viewer?.sendMessage) return setTimeout(start, SOON);
    const send = viewer.sendMessage;

    function say(message) {
      resting.set(message.uuid, null);
      send(message);
      setTimeout(() => {
        const newest = resting.get(message.uuid);
        resting.delete(message.uuid);
        if (newest) say(newest);
      }, PAUSE);
    }

    function sayHeldBack() {
      const held = [...resting.values()].filter((message) => message);
      for (const message of held) {
        resting.set(message.uuid, null);
        send(message);
      }
    }

    viewer.sendMessage = (message) => {
      if (message.type !== "GuiUpdateMessage") return send(message);
      if (resting.has(message.uuid)) resting.set(message.uuid, message);
      else {
        sayHeldBack();
        say(message);
      }
      endPause();
    };
  }

  // Lets the pause that viser starts next, in this same task, be none.
  function endPause() {
    const ours = window.setTimeout;
    const restore = () => (window.setTimeout = ours);
    window.setTimeout = (done, delay, ...rest) => {
      restore();
      if (delay !== PAUSE) return ours(done, delay, ...rest);
      done();
    };
    queueMicrotask(restore);
  }

  start();
}
