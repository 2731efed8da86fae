// The controls of a page without a server: amplitude, speed, phase and a pause, as on the live card.
// They write where driver.js reads: into the pose of its hidden node.
(driverName, isStill) => {
  const form = document.querySelector("form.motion");
  const { amplitude, speed, phase, play } = form.elements;
  let running = true;
  let sought = 0;
  let seeks = 0;

  const pose = () => window.__viserMutable?.nodePoseData[driverName];

  function drive() {
    pose().position = [Number(amplitude.value), running ? Number(speed.value) : 0, sought];
    window.__viserMutable.requestRender();
  }

  function run(wanted) {
    running = wanted;
    play.textContent = running ? "Pause" : "Play";
    drive();
  }

  amplitude.oninput = speed.oninput = drive;
  play.onclick = () => run(!running);
  phase.oninput = () => {
    // driver.js seeks when this number changes; whole turns make it another one
    sought = (Number(phase.value) * Math.PI) / 180 + 2 * Math.PI * (++seeks % 1000);
    run(false);
  };

  function frame() {
    requestAnimationFrame(frame);
    const turns = (window.__modeviz?.phase ?? 0) / (2 * Math.PI);
    if (running) phase.value = 360 * (turns - Math.floor(turns));
  }

  function start() {
    if (!pose() || !(window.__modeviz?.nShown >= 0)) return setTimeout(start, 50);
    [amplitude.value, , sought] = pose().position;
    run(!isStill);
    frame();
  }
  start();
};
