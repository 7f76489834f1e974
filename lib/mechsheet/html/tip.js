// What stands under the pointer or the finger: values of a chart, the meaning of a symbol, why a number is not known.
// Values of a chart: those that it was drawn with here, or those of the document's own.
function readingsOf(chart) {
  if (!chart.dataset.values) {
    const spec = told.shown[chart.parentElement.dataset.n], {results} = state;
    const columns = spec.columns.map(column => columnValues(column, results));
    const held = document.createElement("template");
    held.innerHTML = columns.every(Boolean) ? chartSVG(spec, columns, results) : "";
    chart.dataset.values = held.content.firstChild?.dataset.values ?? '{"at":[]}';
  }
  return JSON.parse(chart.dataset.values);
}

// The values at a place of a chart: of all that have a number there.
function chartTip(chart, k, y) {
  const {at, names, units, texts} = readingsAt(chart);
  const box = chart.getBoundingClientRect();
  tip.innerHTML = names.map((name, i) => `<div>${name} = ${escaped(texts[i][k])} ${escaped(units[i])}</div>`).join("");
  place(box.left + (at[k] * box.width) / chart.viewBox.baseVal.width, y);
  stand(chart);
}

const readingsAt = chart => chart.readings ?? (chart.readings = readingsOf(chart));

function pointedAt(chart, event) {
  const {at} = readingsAt(chart), box = chart.getBoundingClientRect();
  const x = ((event.clientX - box.left) * chart.viewBox.baseVal.width) / box.width;
  let best = -1;
  at.forEach((u, i) => {
    if (u !== null && (best < 0 || Math.abs(u - x) < Math.abs(at[best] - x))) best = i;
  });
  if (best >= 0) chartTip(chart, best, event.clientY);
}

// By keys: from one value to the next, with Shift ten further, to the ends.
function pressedAt(figure, {key, shiftKey}) {
  const chart = figure.querySelector("svg.ms-chart"), {at} = chart ? readingsAt(chart) : {at: []};
  const known = at.flatMap((u, k) => (u === null ? [] : [k])), last = known.length - 1;
  if (last < 0) return false;
  const now = chart.at ?? -1, far = shiftKey ? 10 : 1;
  const to = {ArrowRight: now + far, ArrowLeft: now < 0 ? last : now - far, Home: 0, End: last}[key];
  if (to === undefined) return false;
  chart.at = Math.max(0, Math.min(last, to));
  chartTip(chart, known[chart.at], chart.getBoundingClientRect().top + 30);
  return true;
}

function point(event) {
  const target = event.target.closest ? event.target : null;
  const chart = target?.closest("svg.ms-chart");
  if (chart) return pointedAt(chart, event);
  const found = target?.closest("math") && symbolAt(target), own = target && ownOf(target);
  if (found) return symbolTip(found, event.clientX, event.clientY);
  clearTip();
  if (!own) return;
  ownTip(target, own, event.clientX, event.clientY);
}

function ownTip(target, own, x, y) {
  tip.innerHTML = `the document's own: ${own}`;
  place(x, y);
  stand(target);
}

// By a key: the next number that differs from the document's own, with Shift the one before.
function pressedOn(element, {key, shiftKey}) {
  const all = key === " " ? [...element.querySelectorAll(".ms-value, td, .ms-compared")] : [], many = all.length, now = all.indexOf(toldOf);
  const from = shiftKey && now < 0 ? 0 : now, step = shiftKey ? -1 : 1;
  const next = all.map((_, k) => all[(from + step * (k + 1) + 2 * many) % many]).find(ownOf);
  if (!next) return false;
  clearTip();
  next.scrollIntoView({block: "nearest", inline: "nearest"});
  const {right, bottom} = next.getBoundingClientRect();
  ownTip(next, ownOf(next), right, bottom);
  next.classList.add("ms-chosen");
  return true;
}

const ownParts = new Map(); // as the document has them, read once

function heldOf(n) {
  if (!ownParts.has(n)) {
    const held = document.createElement("template");
    held.innerHTML = told.shown[n].kind === "table" ? `<table><tbody>${first[n]}</tbody></table>` : `<span>${first[n]}</span>`;
    ownParts.set(n, held.content);
  }
  return ownParts.get(n);
}

// What the document has for its own inputs in the place of another number; nothing where it has the same.
function ownOf(target) {
  const element = target.closest("[data-n]"), n = element?.dataset.n, spec = told.shown[n];
  const part = {value: "*", table: "td", check: ".ms-compared"}[spec?.kind], place = part === "*" ? element : target.closest(part);
  if (!part || !place || !element.contains(place) || isSwitched(spec)) return "";
  const held = heldOf(n), at = place.closest("tr")?.sectionRowIndex;
  const own = {
    value: () => held.firstChild,
    table() {
      const {rows} = held.querySelector("tbody");
      return rows.length === element.tBodies[0].rows.length && rows[at]?.cells[place.cellIndex];
    },
    check: () => held.querySelector(part),
  }[spec.kind]();
  return !own || own.textContent === place.textContent ? "" : own.innerHTML.replace(/^: /, "");
}

// Browsers tell late of a scrolling that came before the tip.
addEventListener("scroll", () => topOf(toldOf) === toldAt || clearTip(), {passive: true});
document.addEventListener("pointermove", point);
document.addEventListener("pointerdown", point);
document.addEventListener("click", event => {
  const found = event.target.closest?.("math") && symbolAt(event.target);
  if (found && (!event.pointerType || event.pointerType === "mouse")) goTo(found);
});

tip.setAttribute("aria-live", "polite");
const OWN = "space: the document's own number where one differs";
for (const [kind, keys] of [
  [".ms-line .ms-formula", `arrow keys: its symbols; Enter: where one is defined; ${OWN}`],
  [".ms-figure [data-n]", "arrow keys: its values"],
  [".ms-table table[data-n], .ms-check[data-n]", OWN],
])
  for (const element of document.querySelectorAll(kind)) {
    element.tabIndex = 0;
    element.setAttribute("aria-description", keys);
  }
document.addEventListener("focusout", clearTip);
document.addEventListener("keydown", event => {
  if (event.key === "Escape") return clearTip();
  const {target} = event, is = kind => target.matches?.(kind);
  const isDone = is(".ms-figure [data-n]") ? pressedAt(target, event) : is(".ms-formula") && pressedIn(target, event.key);
  if (isDone || (is(".ms-formula, table, .ms-check") && pressedOn(target, event))) event.preventDefault();
});
