// A symbol of a formula under the pointer: its meaning and value, where it is defined and used; a click goes there.
(() => {
  if (window.msSymbols) return;
  window.msSymbols = true;

  const LETTERS = 24; // of the longest symbol: what is longer is no symbol

  const told = (line) => JSON.parse(line.dataset.reads);
  const inputOf = (name) => document.querySelector(`td[data-input="${name.slice(2)}"]`);
  const placeOf = (name) => (name.startsWith("g.") ? inputOf(name) : document.getElementById(`line-${name}`));

  // Of a symbol with an exponent its own.
  const lettersOf = (e) => (e.localName === "msubsup" ? [...e.children].slice(0, 2) : [e]).map((part) => part.textContent.trim()).join("");

  // The largest part of a formula round an element that is a symbol of its line: of a base with an index both.
  function symbolAt(event) {
    const path = event.composedPath();
    const line = path.find((each) => each.matches?.(".ms-line[data-reads]"));
    if (!line || !path[0].closest?.("math")) return null;
    const names = told(line);
    let found = null;
    for (let e = path[0]; e.localName !== "math"; e = e.parentElement) {
      const text = lettersOf(e);
      if (text.length > LETTERS) break;
      if (Object.hasOwn(names, text) && placeOf(names[text])) found = names[text];
      if (found && e.matches("msubsup > :nth-child(3)")) break; // an exponent is a symbol of its own
    }
    return found;
  }

  // Lines by what they read; all that depends on a name stands behind those that read it themselves.
  function uses(name) {
    const lines = [...document.querySelectorAll(".ms-line[data-reads]")];
    const reading = lines.map((line) => [line, Object.values(told(line)), line.id.slice("line-".length)]);
    const direct = reading.filter(([, names, own]) => own !== name && names.includes(name)).map(([line]) => line);
    const depending = new Set(direct);
    let known;
    do {
      known = depending.size;
      const names = new Set([...depending].map((line) => line.id.slice("line-".length)));
      for (const [line, read, own] of reading) if (own !== name && read.some((each) => each !== own && names.has(each))) depending.add(line);
    } while (depending.size > known);
    return [direct, [...depending]];
  }

  const clean = (element) => element?.textContent.replace(/\s+/g, " ").trim() ?? "";

  function sectionOf(place) {
    const before = (heading) => heading.compareDocumentPosition(place) & Node.DOCUMENT_POSITION_FOLLOWING;
    return clean([...document.querySelectorAll(".markdown :is(h2, h3)")].filter(before).at(-1));
  }

  function meaningOf(name, of) {
    if (!name.startsWith("g.")) return [clean(of.querySelector(":scope > span:not(.ms-formula, .ms-number)")), of.querySelector(".ms-value")?.innerHTML];
    const [, , unit, meaning] = of.closest("tr").cells;
    const field = of.querySelector("marimo-ui-element > *")?.shadowRoot?.querySelector("input, select");
    const value = field && field.type !== "checkbox" ? `${field.value} ${clean(unit)}` : "";
    return [clean(meaning.firstChild), value && `input: ${value.replace(/[&<]/g, (sign) => (sign === "&" ? "&amp;" : "&lt;"))}`];
  }

  let shown = null;

  function clear() {
    document.querySelectorAll(".ms-uses, .ms-depends").forEach((line) => line.classList.remove("ms-uses", "ms-depends"));
    if (shown) tip.hidden = true;
    shown = null;
  }

  function show(name, event) {
    clear();
    shown = name;
    const of = placeOf(name);
    const [meaning, value] = meaningOf(name, of);
    const [direct, depending] = uses(name);
    depending.forEach((line) => line.classList.add(direct.includes(line) ? "ms-uses" : "ms-depends"));
    const rows = ["", "", "", ""].map(() => document.createElement("div"));
    rows[0].textContent = meaning;
    rows[1].innerHTML = value ? (name.startsWith("g.") ? value : `= ${value}`) : "";
    rows[2].textContent = `in ${sectionOf(of)}`;
    rows[3].textContent = direct.length ? `read by ${direct.length} ${direct.length > 1 ? "lines" : "line"}, ${depending.length} in all depend on it` : "no line reads it";
    tip.replaceChildren(...rows.filter((row) => row.textContent));
    place(event.clientX, event.clientY);
  }

  document.addEventListener("pointermove", (event) => {
    const name = symbolAt(event);
    if (!name) return clear();
    if (name !== shown) show(name, event);
  });

  document.addEventListener("click", (event) => {
    const name = !getSelection().toString() && symbolAt(event);
    if (!name) return;
    const of = placeOf(name);
    if (of.contains(event.target)) return clear(); // in the editor this edits the line
    event.preventDefault();
    of.dispatchEvent(new Event("ms-lead", { bubbles: true }));
    of.scrollIntoView({ block: "center" });
    of.querySelector("marimo-ui-element > *")?.shadowRoot?.querySelector("input, select")?.focus({ preventScroll: true });
    of.animate?.([{ background: "#f2c14e88" }, { background: "transparent" }], 1500);
  });

  addEventListener("scroll", clear, { passive: true, capture: true });
})();
