// Lets keys rest while a window such as the guide lies over the page: they reach that window alone, and Escape
// presses its button, which closes or cancels.
//
// viser listens for its keys and for ours above the page's body, what stands in a window below it.
() => {
  window.__modevizKeys?.abort(); // after a reconnect the script runs again, and takes over
  const { signal } = (window.__modevizKeys = new AbortController());

  function rest(event) {
    const dialog = document.querySelector(".mantine-Modal-content");
    if (!dialog) return;
    event.stopPropagation();
    if (event.key === "Escape") dialog.querySelector("button:enabled")?.click();
  }

  document.body.addEventListener("keydown", rest, { signal });
}
