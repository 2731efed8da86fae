// Remembers in this browser what whoever looks is called.
(name) => {
  try {
    if (name) localStorage.setItem("modeviz-name", name);
    else localStorage.removeItem("modeviz-name");
  } catch {}
}
