// Says on a page who presents, with what whoever looks can do about it; while he only looks, widgets look so.
({ text, actions, looks }) => {
  document.body.classList.toggle("mv-looks", looks);
  let banner = document.getElementById("modeviz-presence");
  if (!text) return banner?.remove();
  banner ??= document.createElement("div");
  banner.id = "modeviz-presence";
  banner.setAttribute("role", "status");
  const labels = actions.map(({ words, widget }) => {
    const label = document.createElement("label");
    label.htmlFor = widget;
    label.textContent = words;
    return label;
  });
  banner.replaceChildren(text, ...labels);
  document.body.append(banner);
}
