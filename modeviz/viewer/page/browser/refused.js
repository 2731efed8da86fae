// Points out why nothing came of what was just tried on a page.
() => {
  const banner = document.getElementById("modeviz-presence");
  if (banner && !banner.getAnimations().length) {
    banner.animate([{ scale: "1" }, { scale: "1.12" }, { scale: "1" }], { duration: 350 });
  }
}
