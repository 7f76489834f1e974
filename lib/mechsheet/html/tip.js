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

function chartTip(chart, event) {
  const {at, names, units, texts} = chart.readings ?? (chart.readings = readingsOf(chart));
  const box = chart.getBoundingClientRect(), scale = box.width / chart.viewBox.baseVal.width;
  const x = (event.clientX - box.left) / scale;
  let best = -1;
  at.forEach((u, i) => {
    if (u !== null && (best < 0 || Math.abs(u - x) < Math.abs(at[best] - x))) best = i;
  });
  if (best < 0) return;
  tip.innerHTML = names.map((name, i) => `<div>${name} = ${escaped(texts[i][best])} ${escaped(units[i])}</div>`).join("");
  place(box.left + at[best] * scale, event.clientY);
}

// The symbol of a formula at an element: what the document says of it.
function symbolAt(element) {
  for (let e = element; e?.closest("math") && e.localName !== "math"; e = e.parentElement) {
    const known = told.symbols[e.outerHTML.replace(/ class="[^"]*"/g, "").replace(/ xmlns="[^"]*"/g, "")];
    if (known) return [e, known];
  }
  return null;
}

function symbolTip(element, known) {
  settleAll();
  tip.replaceChildren();
  const meaning = document.createElement("div"), value = document.createElement("div");
  meaning.textContent = known.meaning;
  const input = document.getElementById(known.to);
  if (input?.matches("input, select")) {
    value.textContent = `input: ${input.type === "checkbox" ? (input.checked ? "yes" : "no") : input.value} ${known.unit}`;
  } else if (input) {
    const shown = input.querySelector(".ms-value");
    value.innerHTML = shown && !shown.matches(".ms-grey") ? `= ${shown.innerHTML}` : "";
  }
  tip.append(meaning, value);
}

function point(event) {
  const target = event.target.closest ? event.target : null;
  const chart = target?.closest("svg.ms-chart");
  if (chart) return chartTip(chart, event);
  const found = target?.closest("math") && symbolAt(target);
  if (!found) return (tip.hidden = true);
  symbolTip(...found);
  place(event.clientX, event.clientY);
}

addEventListener("scroll", () => (tip.hidden = true), {passive: true});
document.addEventListener("pointermove", point);
document.addEventListener("pointerdown", point);
document.addEventListener("click", event => {
  const found = event.target.closest?.("math") && symbolAt(event.target);
  if (!found || (event.pointerType && event.pointerType !== "mouse")) return;
  const place = document.getElementById(found[1].to);
  place?.scrollIntoView({block: "center"});
  if (place?.matches("input, select")) place.focus({preventScroll: true});
});
