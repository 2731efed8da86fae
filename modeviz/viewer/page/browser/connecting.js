// Says what is wrong while nothing comes through the page's websocket, and keeps its address whole behind a proxy.
//
// viser opens the websocket in a worker, which says "connected" and "closed", and hands over what comes: all
// there is, as soon as the page is connected. It leaves out the last slash of
// the page's address, without which a proxy may not know the page's place, and writes the websocket's address
// into the page's own, which the server then refuses. What is wrong is asked of the server, which sees what a
// proxy has made of the request. A page that shows this one in a frame is told whether there is a server.
(why, subprotocol, scheme) => {
  const PATIENCE = 3000; // ms until a page that is not connected says so
  const LONGEST = 1500; // ms of it that an answer to what is wrong may take: a proxy may hold it back, too
  const PACE = 1000; // ms between two attempts
  const DRAWN = 100; // ms until what has come is drawn
  const AGAIN = 3500; // ms from one answer to the next question

  const OURS = ["vehicle", "session", "review", "view"]; // of the page's address, for its websocket

  const BLOCKED =
    "the page is served, but its live connection, a WebSocket, does not get through: a proxy or firewall in " +
    "between has to let it, and pass the headers Upgrade and Connection on";
  const SILENT =
    "the live connection, a WebSocket, is open, but nothing has come through it yet: a proxy in between holds it " +
    "back, or the server is busy";
  const GONE = "the server does not answer: start modeviz again, and this page goes on, or open the link it prints";

  const UNSAID = ["Connection closed", "WebSocket construction failed"]; // viser's, where there is no reason

  let waiting = 0;
  let trying = null;
  let worker = null; // viser's
  let isTrying = true; // viser opens the first one itself
  let isOpen = false;
  let ended = ""; // why the server closed the connection, if it said so
  let notice = null;

  const address = () => location.href.split(/[?#]/)[0];
  const pause = (ms) => new Promise((resolve) => setTimeout(resolve, ms));
  const tell = (modeviz) => parent !== window && parent.postMessage({ modeviz }, "*");

  function ours() {
    return [...new URLSearchParams(location.search)].filter(([name]) => OURS.includes(name));
  }

  function visit() {
    return `?${new URLSearchParams([...ours(), ...Object.entries(visitor())])}`;
  }

  // Who looks: a key by which the server knows this browser again and nobody else does, and a name.
  function visitor() {
    const random = () => String.fromCharCode(...crypto.getRandomValues(new Uint8Array(18)));
    try {
      const key = localStorage.getItem("modeviz-visitor") ?? btoa(random()).replace(/[+/]/g, "-");
      localStorage.setItem("modeviz-visitor", key);
      return { visitor: key, name: localStorage.getItem("modeviz-name") ?? "" };
    } catch {
      return {}; // a browser that keeps nothing is a new visitor every time
    }
  }

  function show(text) {
    notice ??= document.createElement("div");
    notice.id = "modeviz-connection";
    notice.setAttribute("role", "alert");
    notice.textContent = `Not connected: ${text}.`;
    notice.style.cssText =
      "position:fixed;top:12px;left:50%;transform:translateX(-50%);z-index:10000;padding:8px 14px;" +
      "max-width:min(640px,90vw);background:#c2452d;color:#fff;font:13px sans-serif;border-radius:4px";
    document.body?.append(notice);
    document.documentElement.dataset.modevizConnected = "no";
  }

  function heard() {
    clearTimeout(waiting);
    waiting = 0;
    ended = "";
    notice?.remove();
    setTimeout(() => cover.remove(), DRAWN);
    delete document.documentElement.dataset.modevizConnected;
    tell("here");
  }

  function closed(reason) {
    isOpen = isTrying = false;
    if (reason && !UNSAID.includes(reason)) show((ended = reason));
    if (!waiting) waiting = setTimeout(explain, PATIENCE - LONGEST);
    trying ??= setInterval(tryAgain, PACE);
  }

  function connected() {
    isOpen = true;
    isTrying = false;
    clearInterval(trying);
    trying = null;
  }

  // viser would begin anew every second and give the attempt before up, in the tab that has the focus alone.
  // That never ends where the server has been away: browsers make who failed often wait for seconds.
  async function tryAgain() {
    if (isTrying) return;
    isTrying = true;
    const { isGone, text } = await obstacle();
    isTrying = !isOpen && !isGone && !text;
    if (isTrying) worker.retry();
  }

  // What stands against the websocket, and whether there is no server; "": nothing that the server knows of.
  async function obstacle() {
    const query = new URLSearchParams([["origin", location.origin], ["subprotocol", subprotocol], ...ours()]);
    try {
      const answer = await fetch(`${new URL(why, address())}?${query}`, {
        cache: "no-store",
        signal: AbortSignal.timeout(LONGEST),
      });
      if ((answer.headers.get("Content-Type") ?? "").startsWith("text/plain")) return { text: await answer.text() };
      return answer.status < 500 ? { text: "" } : { isGone: true }; // a proxy says that there is nobody
    } catch (error) {
      return error.name === "TimeoutError" ? { text: ended || GONE } : { isGone: true };
    }
  }

  async function explain() {
    const asked = waiting;
    const [{ isGone, text }] = await Promise.all([obstacle(), pause(LONGEST)]);
    if (waiting !== asked) return; // it has been connected meanwhile
    show(isGone ? ended || GONE : text || ended || (isOpen ? SILENT : BLOCKED));
    if (isGone) tell("gone");
    waiting = setTimeout(explain, AGAIN);
  }

  window.Worker = class extends window.Worker {
    constructor(...given) {
      super(...given);
      this.addEventListener("message", ({ data }) => {
        if (data?.type === "connected") connected();
        if (data?.type === "message_batch" && waiting) heard();
        if (data?.type === "closed") closed(data.closeReason);
      });
    }

    postMessage(message, ...rest) {
      if (message?.type === "set_server") message = { ...message, server: address().replace(/^http/, "ws") + visit() };
      if (message?.type === "set_server") worker = this;
      if (message?.type !== "retry") super.postMessage(message, ...rest);
    }

    retry() {
      super.postMessage({ type: "retry" });
    }
  };

  // In place of viser's own page, which is empty, until the first word of ours comes.
  const cover = document.createElement("div");
  cover.textContent = "Opening …";
  cover.style.cssText =
    "position:fixed;inset:0;z-index:9999;display:grid;place-items:center;font:14px sans-serif;" +
    `color-scheme:${scheme};background:Canvas;color:CanvasText`;
  document.documentElement.append(cover);

  const replace = history.replaceState.bind(history);
  history.replaceState = (state, title, url) => {
    const whole = new URL(url ?? location.href, location.href);
    if (whole.searchParams.has("websocket")) {
      whole.searchParams.delete("websocket");
      url = whole.href;
    }
    replace(state, title, url);
  };

  waiting = setTimeout(explain, PATIENCE - LONGEST);
}
