// Makes the address under which this page opens a view, shows it in a field, and copies it if it may.
//
// Of the page's own address it has which vehicle is shown, and neither a token nor a key of a session.
async (id, view) => {
  const address = new URL(window.location.pathname, window.location.origin);
  const vehicle = new URLSearchParams(window.location.search).get("vehicle");
  if (vehicle) address.searchParams.set("vehicle", vehicle);
  address.searchParams.set("view", view);
  const frame = () => new Promise(requestAnimationFrame);
  let box = null;
  for (let i = 0; i < 300 && !(box = document.getElementById(id)); i++) await frame();
  if (!box) return;
  const [field, said] = [box.querySelector("input"), box.querySelector("span")];
  field.value = address.href;
  field.onfocus = () => field.select();
  const copied = await navigator.clipboard?.writeText(address.href).then(() => true, () => false);
  if (!copied) field.select();
  said.textContent = copied
    ? "Copied: paste it where somebody is to see this."
    : "This browser lets no page copy from here: copy it from the field.";
}
