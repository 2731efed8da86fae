// Files that are dropped anywhere on the page go to the panel's upload button, one after the other.
//
// Leans on viser's page: a button's hidden input is called file_upload_ and its name, the button itself is
// disabled while a file is on its way, and tabs are built when they are up.
(buttonName, tabName) => {
  const page = (window.__modevizDrop = {});
  const LONGEST = 600_000; // ms, for one file
  const carries = (event) => [...(event.dataTransfer?.types ?? [])].includes("Files");
  const isCurrent = () => window.__modevizDrop === page;
  const button = () => document.getElementById(buttonName);

  async function until(condition, longest) {
    const end = performance.now() + longest;
    while (!condition() && performance.now() < end) await new Promise((done) => setTimeout(done, 50));
    return condition();
  }

  async function open() {
    if (button()) return true;
    const enter = new KeyboardEvent("keydown", { key: "Enter", bubbles: true }); // a click would need a pointer
    document.querySelector(`[role="tab"][title="${tabName}"]`)?.dispatchEvent(enter);
    return until(button, 3000);
  }

  async function send(file) {
    if (!(await until(() => !button()?.disabled, LONGEST))) return;
    const input = document.getElementById(`file_upload_${buttonName}`);
    const carrier = new DataTransfer();
    carrier.items.add(file);
    input.files = carrier.files;
    input.dispatchEvent(new Event("change", { bubbles: true }));
    await until(() => button()?.disabled, 500);
    await until(() => !button()?.disabled, LONGEST);
  }

  function over(event) {
    if (!isCurrent()) return window.removeEventListener("dragover", over);
    if (!carries(event)) return;
    event.preventDefault();
    event.dataTransfer.dropEffect = "copy";
  }

  async function drop(event) {
    if (!isCurrent()) return window.removeEventListener("drop", drop);
    if (!carries(event)) return;
    event.preventDefault();
    const files = [...event.dataTransfer.files];
    if (!(await open())) return;
    for (const file of files) await send(file);
  }

  window.addEventListener("dragover", over);
  window.addEventListener("drop", drop);
}
