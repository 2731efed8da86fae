// Puts the live bench in the place of its still, if this browser reaches the server, and else says so.
//
// A notebook that is saved and opened on another day, or one whose kernel is on another machine, runs this too.
(id, { port, query, through, prefix, height, offline }) => {
  const PATIENCE = 4000; // ms for an answer
  const AGAIN = 1500; // ms until VS Code may have forwarded the port
  const LOOPBACK = ["localhost", "127.0.0.1", "[::1]"];

  const LOOKING = "Looking for the bench…";
  const UNREACHED =
    "A still picture, since the bench does not answer. Run the cell again; if it has just run, its kernel is out of " +
    "this browser's reach, and needs jupyter-server-proxy beside the notebook's server.";
  const CLOSED = "A still picture, since the bench was closed. Run the cell again.";

  const cell = [...document.querySelectorAll(`#${id}`)].find((each) => !each.dataset.isBegun);
  if (!cell) return;
  cell.dataset.isBegun = "yes";
  const part = (name) => cell.querySelector(`.mv-${name}`);
  const [still, said, open] = ["still", "said", "open"].map(part);
  const play = document.createElement("button");
  const here = new URL(location.protocol === "about:" ? document.baseURI : location.href);
  const isServed = here.protocol.startsWith("http");

  function notebookBase() {
    const config = document.getElementById("jupyter-config-data")?.textContent;
    return document.body.dataset.baseUrl ?? (config ? JSON.parse(config).baseUrl : prefix);
  }

  function addresses() {
    if (through) return [new URL(through.replace("{port}", port), here).href];
    const isLoopback = LOOPBACK.includes(here.hostname);
    const base = notebookBase();
    return [
      // Under the notebook's own name, where it is this machine, browsers take both for one site.
      ...(isLoopback || !isServed ? [`http://${isLoopback ? here.hostname : "127.0.0.1"}:${port}/`] : []),
      ...(isServed && base ? [new URL(`${base}proxy/${port}/`, here).href] : []),
    ];
  }

  const answers = (address) =>
    new Promise((done) => {
      const picture = new Image();
      setTimeout(() => done(false), PATIENCE);
      picture.onload = () => done(true);
      picture.onerror = () => done(false);
      picture.src = `${address}alive.svg${query}&at=${Date.now()}`;
    });

  async function find() {
    const waits = isServed ? [0] : [0, AGAIN, AGAIN, AGAIN];
    for (const wait of waits) {
      await new Promise((done) => setTimeout(done, wait));
      for (const address of addresses()) if (await answers(address)) return address;
    }
    return null;
  }

  function framed(source) {
    const frame = document.createElement("iframe");
    frame.title = "modeviz";
    frame.allow = "fullscreen; clipboard-write";
    frame.style.cssText = `display:block;width:100%;height:${height}px;border:0`;
    frame.src = source;
    still.before(frame);
    return frame;
  }

  function showStill(text) {
    still.hidden = said.hidden = false;
    said.textContent = text;
    play.hidden = !offline;
    open.hidden = true;
  }

  function showLive(frame) {
    still.hidden = said.hidden = play.hidden = true;
    open.hidden = frame.hidden = false;
  }

  async function playOffline() {
    play.hidden = said.hidden = true;
    const packed = Uint8Array.from(atob(offline), (character) => character.charCodeAt(0));
    const unpacked = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
    const page = new Blob([await new Response(unpacked).arrayBuffer()], { type: "text/html;charset=utf-8" });
    const reader = new FileReader();
    reader.onload = () => {
      framed(reader.result);
      still.hidden = true;
    };
    reader.readAsDataURL(page);
  }

  async function begin() {
    said.textContent = LOOKING;
    const address = await find();
    if (!address) return showStill(UNREACHED);
    const frame = framed(address + query);
    open.querySelector("a").href = address + query;
    showLive(frame);
    addEventListener("message", ({ source, data }) => {
      if (source !== frame.contentWindow) return;
      if (data?.modeviz === "here") showLive(frame);
      if (data?.modeviz === "gone") {
        frame.hidden = true;
        showStill(CLOSED);
      }
    });
  }

  play.type = "button";
  play.className = "mv-play";
  play.textContent = "Play it here";
  play.hidden = true;
  play.addEventListener("click", playOffline);
  said.after(play);
  begin();
}
