// Gives the page our style sheet, where no panel takes it along when it is put away.
(rules) => {
  const sheet = document.getElementById("modeviz-style") ?? document.createElement("style");
  sheet.id = "modeviz-style";
  sheet.textContent = rules;
  document.body.append(sheet);
}
