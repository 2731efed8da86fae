// Has this page alone tell at which phase its shapes stand, in whole degrees, as the value of a widget.
(widget) => {
  const degrees = Math.round((window.__modeviz.phase * 180) / Math.PI);
  const value = ((degrees % 360) + 360) % 360;
  window.__viserMutable.sendMessage({ type: "GuiUpdateMessage", uuid: widget, updates: { value } });
}
