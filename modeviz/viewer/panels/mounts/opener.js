// Opens the folder of the selected mount group and brings it into view. In a low window only two folders
// start open. A look at the page now and then is enough, and survives all that viser builds anew: folders
// when their tab comes up again, everything after a reconnect.
() => {
  const HIGH = 900; // px: from here on all folders start open
  const LOOK_EVERY = 100; // ms
  const UNFOLDING = 300; // ms: longer than a folder takes to open

  const page = (window.__modevizFolders ??= { open: {}, told: null });
  const turn = (page.turn = {}); // after a reconnect the script runs again, and takes over
  const known = new WeakSet(); // the folders that are as they should be

  const folderOf = (marker) => marker.closest(".mantine-Paper-root");
  const isOpen = (folder) => folder.firstElementChild.querySelector(".tabler-icon-chevron-up") !== null;
  const toggle = (folder) => folder.firstElementChild.click();
  const isThere = (marker) => marker && folderOf(marker).offsetParent !== null;

  // What was open stays open when a folder is built anew; at the start the selected one and another are,
  // or all.
  function keep(markers, selected) {
    const other = markers.find((marker) => marker.dataset.group !== selected)?.dataset.group;
    for (const marker of markers) {
      const folder = folderOf(marker);
      const group = marker.dataset.group;
      page.open[group] ??= window.innerHeight >= HIGH || group === selected || group === other;
      if (known.has(folder)) page.open[group] = isOpen(folder);
      else if (isOpen(folder) !== page.open[group]) toggle(folder);
      known.add(folder);
    }
  }

  function reveal(folder) {
    if (!isOpen(folder)) toggle(folder);
    if (folder.matches(":active") || folder.contains(document.activeElement)) return; // somebody works there
    setTimeout(() => folder.scrollIntoView({ block: "nearest", behavior: "smooth" }), UNFOLDING);
  }

  function bringUpTab() {
    const enter = new KeyboardEvent("keydown", { key: "Enter", bubbles: true }); // a click would need a pointer
    document.querySelector('[role="tab"][title="Mounts"]')?.dispatchEvent(enter);
  }

  function look() {
    if (page.turn !== turn) return clearInterval(timer);
    const { group, asked } = document.querySelector(".mv-selected")?.dataset ?? {};
    if (group === undefined) return;
    const markers = [...document.querySelectorAll(".mv-rates")].filter(isThere);
    keep(markers, group);
    const call = `${group} ${asked}`;
    if (call === page.told) return;
    const marker = markers.find((marker) => marker.dataset.group === group);
    if (marker) reveal(folderOf(marker));
    else if (group && page.told !== null) bringUpTab();
    if (marker || !group || page.told === null) page.told = call;
  }
  const timer = setInterval(look, LOOK_EVERY);
}
