// Copies a link, whole, to the clipboard of this page; where browsers do not allow that, it can be copied by hand.
(link) => {
  const whole = new URL(link, location.href.split(/[?#]/)[0]).href;
  const byHand = () => window.prompt("Copy this link", whole);
  if (navigator.clipboard) navigator.clipboard.writeText(whole).catch(byHand);
  else byHand();
}
