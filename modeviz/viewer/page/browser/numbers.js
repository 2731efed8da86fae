// Has a number box that is left empty say its number again: viser's page ignores what is no number, and
// the server, whose number has not changed, sends none.
() => {
  let last = ""; // number in the box that is typed into

  function boxOf({ target }) {
    return target instanceof HTMLInputElement && target.matches(".mantine-NumberInput-input") ? target : null;
  }

  function isNumber(text) {
    return text !== "" && Number.isFinite(Number(text)); // letters are there until React takes them away
  }

  function note(event) {
    const box = boxOf(event);
    if (box && (event.type === "focusin" || isNumber(box.value))) last = box.value;
  }

  function fill(event) {
    const box = boxOf(event);
    if (!box || box.value || !last) return;
    Object.getOwnPropertyDescriptor(HTMLInputElement.prototype, "value").set.call(box, last);
    box.dispatchEvent(new Event("input", { bubbles: true })); // else React does not know of it
  }

  if (window.__modevizNumbers) return; // a reconnect runs the script again
  window.__modevizNumbers = true;
  document.addEventListener("focusin", note, true);
  document.addEventListener("input", note, true);
  document.addEventListener("focusout", fill, true);
}
