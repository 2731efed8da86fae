// Says on a page who presents, with what whoever looks can do about it; while he only looks, widgets look so.
// Buttons speak for widgets of the page, which may lie in a folder that is closed.
({ text, actions, looks }) => {
  document.body.classList.toggle("mv-looks", looks);
  let banner = document.getElementById("modeviz-presence");
  if (!text) return banner?.remove();
  banner ??= document.createElement("div");
  banner.id = "modeviz-presence";
  banner.setAttribute("role", "status");
  const buttons = actions.map(({ words, widget: uuid }) => {
    const button = document.createElement("button");
    const pressed = { type: "GuiUpdateMessage", uuid, updates: { value: true } };
    button.onclick = () => window.__viserMutable.sendMessage(pressed);
    button.textContent = words;
    return button;
  });
  banner.replaceChildren(text, ...buttons);
  document.body.append(banner);
}
