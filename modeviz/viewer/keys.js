// Lets keys rest while a window such as the guide lies over the page: they reach that window alone.
//
// viser listens for its keys and for ours above the page's body, what stands in a window below it.
() => {
  window.__modevizKeys?.abort(); // after a reconnect the script runs again, and takes over
  const { signal } = (window.__modevizKeys = new AbortController());

  function rest(event) {
    if (document.querySelector(".mantine-Modal-content")) event.stopPropagation();
  }

  document.body.addEventListener("keydown", rest, { signal });
}
