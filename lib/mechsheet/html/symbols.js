// A symbol of a formula: its meaning, unit and value, where it is defined and used; a click goes there.
const markup = element => element.outerHTML.replace(/ class="[^"]*"/g, "").replace(/ xmlns="[^"]*"/g, "");
const raisedIn = element => (element.localName === "msubsup" ? element.children[2] : null);
const knownAs = element =>
  told.symbols[raisedIn(element) ? `<msub>${[...element.children].slice(0, 2).map(markup).join("")}</msub>` : markup(element)];

// The largest part of a formula round an element that is a symbol: of a base with an index both.
function symbolAt(element) {
  let found = null;
  for (let e = element; e?.closest("math") && e.localName !== "math"; e = e.parentElement) {
    if (knownAs(e)) found = e;
    if (found && raisedIn(e.parentElement) === e) break; // an exponent is a symbol of its own
  }
  return found;
}

function symbolsIn(formula) {
  const found = [], look = e => {
    const isKnown = knownAs(e), raised = raisedIn(e);
    if (isKnown) found.push(e);
    if (!isKnown) [...e.children].forEach(look);
    else if (raised) look(raised);
  };
  formula.querySelectorAll("math").forEach(look);
  return found;
}

// Lines that read what is defined at a place, and all that depend on it.
let readings;
function usesOf(to) {
  readings ??= [...document.querySelectorAll(".ms-line[id]")].map(line =>
    [line, new Set(symbolsIn(line.querySelector(".ms-formula")).map(e => knownAs(e).to).filter(id => id !== line.id))]);
  const direct = readings.filter(([, read]) => read.has(to)).map(([line]) => line), ids = new Set([to]);
  for (let before = 0; before < ids.size; ) {
    before = ids.size;
    for (const [line, read] of readings) if ([...read].some(id => ids.has(id))) ids.add(line.id);
  }
  return [direct, ids.size - 1];
}

function sectionOf(place) {
  const before = heading => heading.compareDocumentPosition(place) & Node.DOCUMENT_POSITION_FOLLOWING;
  return [...document.querySelectorAll("main :is(h2, h3)")].filter(before).at(-1)?.textContent.trim() ?? "";
}

let isTold = null;

function symbolTip(element, x, y) {
  if (element === isTold) return place(x, y);
  clearTip();
  settleAll();
  isTold = element;
  element.classList.add("ms-known");
  const {meaning, unit, to} = knownAs(element), input = document.getElementById(to), rows = Array.from({length: 4}, () => document.createElement("div"));
  rows[0].textContent = meaning;
  if (input?.matches("input, select")) {
    rows[1].textContent = `input: ${input.type === "checkbox" ? (input.checked ? "yes" : "no") : input.value} ${unit}`;
  } else if (input) {
    const shown = input.querySelector(".ms-value");
    rows[1].innerHTML = shown && !shown.matches(".ms-grey") ? `= ${shown.innerHTML}` : "";
  }
  const [direct, all] = usesOf(to), section = input && sectionOf(input);
  rows[2].textContent = section ? `in ${section}` : "";
  rows[3].textContent = direct.length ? `read by ${direct.length} ${direct.length > 1 ? "lines" : "line"}, ${all} in all depend on it` : "no line reads it";
  direct.forEach(line => line.classList.add("ms-uses"));
  tip.replaceChildren(...rows.filter(row => row.textContent));
  place(x, y);
  stand(element);
}

let toldOf = null, toldAt = 0; // what the tip tells of, and where that stands in the window
const topOf = element => element?.getBoundingClientRect().top;
const stand = element => ([toldOf, toldAt] = [element, topOf(element)]);

function clearTip() {
  document.querySelectorAll(".ms-uses, .ms-chosen").forEach(element => element.classList.remove("ms-uses", "ms-chosen"));
  isTold = null;
  tip.hidden = true;
}

function goTo(symbol) {
  const place = document.getElementById(knownAs(symbol).to);
  place?.scrollIntoView({block: "center"});
  (place?.matches("input, select") ? place : place?.querySelector(".ms-formula"))?.focus({preventScroll: true});
}

// By keys: along the symbols of a formula, to where one is defined.
function pressedIn(formula, key) {
  const symbols = symbolsIn(formula), at = symbols.findIndex(e => e.matches(".ms-chosen"));
  const step = {ArrowRight: 1, ArrowLeft: -1}[key] ?? (key === "Enter" && at < 0 ? 1 : 0);
  if (key === "Enter" && at >= 0) goTo(symbols[at]);
  if (!step || !symbols.length) return key === "Enter";
  const next = symbols[(at + step + symbols.length + (at < 0 && step < 0)) % symbols.length], box = next.getBoundingClientRect();
  symbolTip(next, box.right, box.bottom);
  next.classList.add("ms-chosen");
  return true;
}
