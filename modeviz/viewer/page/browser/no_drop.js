// A file that is dropped here would be opened by the browser in place of the page.
() => {
  const page = (window.__modevizNoDrop = {});
  function refuse(event) {
    if (window.__modevizNoDrop !== page) return window.removeEventListener(event.type, refuse);
    if (!event.dataTransfer?.types.includes("Files")) return;
    event.preventDefault();
    event.dataTransfer.dropEffect = "none";
  }
  for (const kind of ["dragover", "drop"]) window.addEventListener(kind, refuse);
}
