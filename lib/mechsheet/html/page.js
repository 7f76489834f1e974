// The page itself: it shows for the inputs what evaluate gives, and nothing that it does not know.
async function unpacked(text) {
  const bytes = Uint8Array.from(atob(text), letter => letter.charCodeAt(0));
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"))).json();
}

const told = await unpacked(document.getElementById("told").textContent);
const shownBy = told.shown.map((spec, n) => document.querySelector(`[data-n="${n}"]`));
const contentOf = element => element.tBodies?.[0] ?? element;
const first = shownBy.map((element, n) => told.pictures[n] ?? contentOf(element).innerHTML);
const ALONE = "it holds for the document's own inputs alone";
const UNKNOWN = "not known for these inputs: it holds for the document's own";
const FAILED = "the page ends with an error for these inputs: open the worksheet itself";
const DRAWN = new Set(["chart", "drawing", "numbers"]);
const MOVES_NOT = "as in the document, for its own inputs only";
const state = {changed: new Set(), refused: false, results: null, strange: []};
const moving = new Map(); // by the name of the control: its positions, pictures and marks, and which of them is shown

const ENDS = 100; // rows at either end of a table that are shown: see `rows` of the document

// Each kind of element: from the results to what stands in it; nothing where that is not known.
const show = {
  value(spec, element, results) {
    const parts = spec.keys?.map(key => along(results.values[key], positionOf(spec)));
    const known = parts && parts.every(part => part !== undefined);
    const isNothing = known && isNothingBut(parts, spec, results.values);
    const where = known && spec.over && !isNothing ? whereText(parts, spec.over.map(axisNow), results.values) : "";
    const text = known && (isNothing ? "≈ " : "") + valueText(isNothing ? parts.map(() => 0) : parts, ...unitNow(spec).slice(1));
    set(element, known ? text + where : "");
    return Boolean(known);
  },
  table(spec, element, results) {
    const columns = spec.columns.map(column => columnTexts(inUnit(withDecimals(column, results), results), results));
    const rows = Math.max(...columns.map(texts => texts?.length ?? 0));
    const kinds = spec.columns.map(column => (column.unit ? "" : ' class="ms-text"'));
    const cells = k => columns.map((texts, n) => `<td${kinds[n]}>${texts ? escaped(texts[k] ?? "") : ""}</td>`).join("");
    const shown = Array.from({length: rows}, (_, k) => k).filter(k => rows <= 2 * ENDS || k < ENDS || k >= rows - ENDS);
    set(element.tBodies[0], shown.map(k => `<tr>${cells(k)}</tr>`).join(""));
    const told = rows > shown.length ? `rows ${ENDS + 1} to ${rows - ENDS} of ${rows} are not shown` : "";
    if (told || element.tFoot) set(element.createTFoot(), told && `<tr><td class="ms-text" colspan="${columns.length}">${told}</td></tr>`);
    return columns.every(Boolean);
  },
  check(spec, element, results) {
    const verdict = judged(spec, results), name = element.querySelector(".ms-name");
    if (name && spec.title) set(name, nameHTML(spec.title, results));
    if (verdict) tell(element, verdict, spec);
    else tell(element, {kind: "OPEN", word: "not known", compared: "", reason: ""}, spec); // it is told as of others
    return Boolean(verdict);
  },
  chart(spec, element, results) {
    const switched = chartInUnits(spec, results), columns = switched.columns.map(column => columnValues(column, results));
    const known = columns.every(Boolean) && argument(spec.every, results) !== undefined;
    set(element, known ? chartSVG(switched, columns, results) : "");
    return known;
  },
  drawing(spec, element, results) {
    const known = spec.keys.every(key => results.values[key] !== undefined);
    set(element, known ? drawingSVG(drawnWith(spec, results)) : "");
    return known;
  },
  text(spec, element, results) {
    const known = spec.keys.every(key => results.values[key] !== undefined);
    const read = key => results.values[key];
    set(element, known ? htmlOf(spec.pieces, read) : "");
    return known;
  },
  numbers(spec, element, results) {
    const known = isPutIn() ? numbersOf(spec, results) : [];
    set(element, known && isPutIn() ? withNumbers(spec, known) : "");
    return Boolean(known);
  },
  own(spec, element) {
    set(element, "");
    return false;
  },
  moved(spec, element) {
    set(element, "");
    return false;
  },
  found(spec, element, results) {
    const verdict = spec.words && !results.gaps[`found ${spec.key}`] && results.found[spec.key];
    set(element, verdict ? foundHTML(spec.words, verdict) : "");
    return Boolean(verdict);
  },
};

// Whether a value is nothing but the rounding of what its line adds, or, where it is small in its unit, of all behind it.
function isNothingBut(parts, {terms, left, unit}, values) {
  const [, factor] = offersOf({unit})[0];
  return isRounding(parts, values[terms], 1e-2) || isRounding(parts, values[left], 1e-6 * factor);
}

// The part of a field at one position of its last axis; all of it where none is meant.
function along(field, at) {
  if (at === undefined || field === undefined || typeof field === "number") return field;
  const length = (field.shape ?? [field.length]).at(-1);
  const part = field.filter((_, i) => i % length === at);
  return part.length > 1 ? Object.assign(part, {shape: field.shape.slice(0, -1)}) : part[0];
}

const escaped = text => String(text).replace(/[&<>"]/g, sign => ({"&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;"})[sign]);

function columnValues(column, results) {
  if (column.key === null) return column.fixed ? column.values?.map(x => x * ((column.own ?? column.factor) / column.factor)) ?? null : null;
  const values = results.values[column.key];
  return values === undefined ? null : Float64Array.from(typeof values === "number" ? [values] : values, x => x / column.factor);
}

// An argument of what is shown, which may be the key of a quantity.
const argument = (own, {values}) => (typeof own === "string" ? values[own] : own);

// A column with as many decimals as it has for these inputs.
function withDecimals(column, results) {
  if (typeof column.decimals === "string") return {...column, decimals: argument(column.decimals, results), own: column.factor};
  if (!("usual" in column)) return column;
  const values = columnValues(column, results) ?? [];
  return {...column, decimals: enough(values, column.usual)};
}

function columnTexts(column, results) {
  if (!(column.decimals >= 0 && column.decimals <= 100)) return null; // nobody knows how many, or can write as many
  if (column.key === null && (!column.fixed || !column.own)) return column.fixed ? column.texts : null;
  const values = columnValues(column, results);
  return values && (column.label ? labelsOf(column.label, values, results) : Array.from(values, x => cellText(x, column)));
}

// Texts of an input by their rows, or of several by their numbers; none where the number beside one is none.
function labelsOf([name, key], values, results) {
  const rows = results.values[key], texts = Array.isArray(name) ? name : typedIn.get(name);
  const read = node => results.values[node];
  return rows && Array.from(rows, (k, n) => (values[n] === values[n] ? written(texts[k], read) : AXIS.none));
}

// The name of a check, of which nobody knows some pieces where it rests on what is not known.
function nameHTML(pieces, {values}) {
  const of = part => (part.keys.every(key => values[key] !== undefined) ? escaped(piece(part.piece, key => values[key])) : "…");
  return pieces.map(part => (typeof part === "string" ? part : of(part))).join("");
}

// Residual, limit and verdict of a check, as the worksheet judges it; null where they are not known.
function judged(spec, results) {
  const parts = spec.keys?.map(key => results.values[key]);
  const bound = spec.own ? spec.limit : results.values[spec.limit];
  if (!parts || parts.some(part => part === undefined) || bound === undefined) return null;
  const all = parts.flatMap(part => (typeof part === "number" ? [part] : [...part]));
  const lost = all.filter(x => x !== x).length, limit = bound / (spec.own ? 1 : spec.factor);
  const sum = spec.essential && !spec.signed;
  const residual = (sum ? all.reduce((a, b) => a + b, 0) : Math[spec.least ? "min" : "max"](...all)) / spec.factor;
  const open = reason => ({kind: "OPEN", word: "not evaluated", compared: "", reason});
  if (!all.length) return open("there is nothing to check");
  if (lost) return open(all.length > 1 ? `${lost} of ${all.length} values do not exist` : "its value does not exist");
  if (limit !== limit) return open(`its limit ${spec.agreement ? "is more than a thousandth of what is compared, or " : ""}does not exist`);
  if (!isFinite(limit)) return open("its limit is infinite");
  const passed = spec.least ? residual >= limit : residual <= limit, kind = passed ? "PASS" : "FAIL", agrees = spec.agreement && passed;
  const [a, b] = compared(residual, limit, agrees).map(inWords);
  const sign = passed ? (spec.least ? "≥" : "≤") : spec.least ? "&lt;" : "&gt;";
  const told = agrees ? `within ${b}${spec.behind}` : `${a} ${sign} ${b}${spec.behind}`;
  const [needs, has] = spec.least ? [limit, residual] : [residual, limit];
  const part = needs >= 0 && has > 0 && limit > 0 && !spec.agreement ? needs / has : NaN, used = utilised(part);
  return {kind, word: kind, compared: `: ${told}${used && `, ${used}`}`, reason: spec.where || "", part};
}

// What part of its limit a quantity takes, told apart from 100 %.
const utilised = part =>
  (isFinite(part) ? (part > 0 && part < told.little ? `under ${100 * told.little} %` : `${apart([100 * part, 100], 3)[0]} %`) : "");

function tell(element, {kind, word, compared, reason, part = NaN}) {
  const badge = element.querySelector(".ms-badge");
  badge.className = `ms-badge ms-${kind}`;
  badge.textContent = word;
  const place = element.querySelector(".ms-compared");
  place.innerHTML = compared;
  place.dataset.part = part;
  element.querySelector(".ms-note").innerHTML = inWords(escaped(reason));
  inside.delete(element);
}

function refresh() {
  const {si, changed, errors} = readInputs();
  told.inputs.fields.forEach(({name}, n) => mark(told.inputs.fields[n], changed.has(name), errors.get(name) ?? ""));
  Object.assign(state, {changed, si});
  state.results = errors.size ? null : computed();
  if (state.results && ended()) state.results = computed();
  state.refused = !state.results;
  const own = !changed.size && !errors.size, why = errors.size ? "an input cannot be used" : FAILED;
  told.shown.forEach((spec, n) => {
    const at = spec.kind === "check" ? (_, f) => f() : soon; // the checks are summed up
    if (own && !spec.control && spec.kind !== "moved" && !spec.slid?.some(isSlid)) at(n, () => showFirst(n));
    else if (state.refused) at(n, () => empty(spec, shownBy[n], why));
    else if (spec.kind !== "moved" && !spec.control) at(n, () => showOne(spec, n));
  });
  [...moving.keys()].forEach(showMoved);
  showPositions();
  sum();
  say(changed, errors);
  waiting.set("address", keepAddress); // browsers refuse it after many within seconds
  whenIdle();
}

function keepAddress() {
  const address = addressOf(textsOf(state.changed));
  if (state.refused || address === location.hash.slice(1)) return;
  history.replaceState(null, "", address ? `#${address}` : location.pathname);
}

function showFirst(n) {
  if (isSwitched(told.shown[n]) || (!first[n] && DRAWN.has(told.shown[n].kind))) return showOne(told.shown[n], n);
  set(contentOf(shownBy[n]), first[n]);
  grey(shownBy[n], "");
  if (moving.has(told.shown[n].of)) showControl(told.shown[n].of);
}

const showOne = (spec, n) => (spec.fixed && !broken(spec, state.results) ? showFirst(n) : showNow(spec, shownBy[n]));

function showNow(spec, element) {
  const results = state.results, why = broken(spec, results);
  if (why) return empty(spec, element, why);
  try {
    grey(element, show[spec.kind](spec, element, results) ? "" : gapOf(spec, results) ?? UNKNOWN);
  } catch (error) { // all else follows
    console.error(error);
    empty(spec, element, FAILED);
  }
}

// Why the worksheet would show something else; undefined where it would not.
const broken = (spec, results) => spec.guards?.filter(([key]) => !results.values[key]).map(([key, why]) => results.gaps[key] ?? why)[0];

// What the page computes for its inputs and the positions of its sliders; nothing where that ends with an error.
function computed() {
  try {
    return evaluate({...state.si, ...slid()});
  } catch (error) {
    console.error(error);
    return null;
  }
}

function gapOf(spec, results) {
  const keys = [...(spec.keys ?? []), ...(spec.columns ?? []).map(column => column.key), `found ${spec.key}`, ...(spec.own ? [] : [spec.limit])];
  return keys.map(key => results.gaps[key]).find(Boolean) ?? spec.why;
}

// What stands there already is left alone: laying it out again takes longer than computing it.
const inside = new WeakMap();

function set(element, html) {
  const before = inside.get(element) ?? element.innerHTML;
  inside.set(element, html);
  if (before === html) return;
  const equals = element.previousElementSibling;
  if (equals?.className === "ms-equals") equals.textContent = html.startsWith("≈") ? "" : "="; // ≈ is sign enough
  const [old, now] = [before, html].map(text => text.split("<", 1)[0]), {firstChild} = element;
  const isText = old && now && !/[&\r]/.test(now) && before.slice(old.length) === html.slice(now.length);
  if (isText && firstChild?.data === old) firstChild.data = now; // a number before its unit
  else element.innerHTML = html;
}

function grey(element, reason) {
  element.classList.toggle("ms-grey", Boolean(reason));
  if (reason) element.dataset.reason = reason;
  else delete element.dataset.reason;
}

const NOTHING = {values: {}, gaps: {}, guards: [], found: {}};

// Of what has a frame of its own that stays; from all else every number goes, also one that no key stands for.
function empty(spec, element, reason) {
  if (["table", "check"].includes(spec.kind)) show[spec.kind](spec, element, NOTHING);
  else set(element, "");
  grey(element, reason);
}

function mark(field, changed, error) {
  const input = inputOf(field), row = input.closest(".ms-field");
  row.classList.toggle("ms-changed", changed);
  row.title = changed ? `the document's own: ${field.text}${unitOf(field)}` : "";
  input.setAttribute("aria-invalid", Boolean(error));
  document.getElementById(`error-${field.name}`).innerHTML = inWords(escaped(error));
  const used = document.querySelector(`[data-used="${field.name}"]`);
  used.classList.toggle("ms-changed", changed);
  if (field.kind === "rows") set(used.nextElementSibling.cells[0], onPaper(field));
  else set(used.cells[1], (field.kind === "number" ? inWords : String)(escaped(typed(field))));
}

// Where checks are summed up, with those in the order in which they are stated, in which equal ones stay.
const summedUp = [...document.querySelectorAll(".ms-summary")].map(each => [each, [...each.querySelector(".ms-row").children]]);

// The verdicts of all checks where they are summed up, the worst first, and how many solve blocks found nothing.
function sum() {
  for (const [summary, stated] of summedUp) {
    const row = summary.querySelector(".ms-row"), counts = {PASS: 0, FAIL: 0, OPEN: 0};
    const items = stated.map(item => {
      const check = document.getElementById(item.dataset.of), badge = check?.querySelector(".ms-badge");
      const kind = /ms-(PASS|FAIL|OPEN)/.exec(badge?.className)?.[1] ?? "OPEN";
      counts[kind]++;
      const own = item.querySelector(".ms-badge"), name = check?.querySelector(".ms-name");
      if (name) set(item.querySelector(".ms-name"), name.innerHTML);
      if (own.textContent !== badge.textContent) Object.assign(own, {className: badge.className, textContent: badge.textContent});
      const part = Number(check?.querySelector(".ms-compared").dataset.part ?? NaN), reason = check?.querySelector(".ms-note").textContent;
      item.querySelector(".ms-note").textContent = utilised(part) || reason;
      return {kind, item, part: isFinite(part) ? part : -Infinity};
    });
    const worse = (a, b) => (a.part === b.part ? 0 : b.part - a.part);
    const sorted = ["FAIL", "OPEN", "PASS"].flatMap(kind => items.filter(each => each.kind === kind).sort(worse).map(({item}) => item));
    if (sorted.some((item, k) => item !== row.children[k])) row.append(...sorted);
    const total = items.length, unfound = document.querySelectorAll(".ms-found .ms-FAIL").length;
    summary.querySelector("b").textContent = `${counts.PASS} of ${total} checks pass` + (counts.FAIL ? `, ${counts.FAIL} fail` : "") +
      (counts.OPEN ? `, ${counts.OPEN} not evaluated` : "") + (unfound ? `; ${unfound} not found` : "");
  }
}

// What is not known for these inputs, by the reason.
function lacking(results) {
  const found = new Map(results.guards.map(why => [why, new Set()]));
  told.shown.forEach((spec, n) => {
    const alone = spec.kind === "check" && !spec.keys ? ALONE : undefined; // of which nothing is recorded
    const why = broken(spec, results) ?? gapOf(spec, results) ?? alone, name = nameOf(spec, shownBy[n]);
    if (why && name) found.set(why, (found.get(why) ?? new Set()).add(name));
  });
  ofOwn ??= numberless(evaluate({}));
  const none = [...numberless(results)].filter(name => !ofOwn.has(name));
  return [...found].map(([why, names]) => (names.size ? `not known: ${listed([...names])} (${why})` : why))
    .concat(none.length ? `no number for these inputs: ${listed(none)}` : []);
}

// Names of the lines that have none somewhere, first those at which numbers get lost; of the document's own inputs.
const numberless = results => new Set(told.shown.flatMap((spec, n) => {
  const lost = spec.kind === "value" && spec.keys?.some(key => elements(results.values[key] ?? []).some(x => x !== x));
  return lost ? nameOf(spec, shownBy[n]) : [];
}));
let ofOwn;

const nameOf = (spec, element) => spec.of ?? (spec.title && element.querySelector(".ms-name")?.textContent) ?? spec.name ?? spec.key ?? element.closest(".ms-table, .ms-figure")?.querySelector(".ms-caption b").textContent ?? textIn(element);
const textIn = element => `a text${sectionOf(element) && ` of ${sectionOf(element)}`}`;
const listed = names => names.slice(0, LISTED).join(", ") + (names.length > LISTED ? ` and ${names.length - LISTED} more` : "");

function say(changed, errors) {
  const bar = document.querySelector(".ms-bar");
  const names = told.inputs.fields.filter(field => changed.has(field.name)).map(field => field.name).join(", ");
  const text = errors.size
    ? `not computed: ${[...errors.values()][0]}`
    : state.refused ? FAILED : changed.size ? [`changed: ${names}`, ...lacking(state.results)].join("; ") : "as in the document";
  bar.querySelector(".ms-state").innerHTML = inWords(escaped([text, ...state.strange].join("; ")));
  document.body.classList.toggle("ms-stopped", state.refused);
  bar.querySelector(".ms-back").hidden = !changed.size && !errors.size;
  bar.querySelector(".ms-save").hidden = !changed.size || Boolean(errors.size);
}

document.addEventListener("input", event => {
  if (event.target.closest(".ms-inputs")) refresh();
});
document.addEventListener("submit", event => event.preventDefault());
addEventListener("hashchange", () => {
  if (!location.hash || location.hash.includes("=")) readAddress(); // else a link to a place: the inputs stay
  refresh();
});

document.querySelector(".ms-back")?.addEventListener("click", () => {
  state.strange = [];
  for (const field of told.inputs.fields) type(field, field.text);
  refresh();
});

document.querySelector(".ms-save")?.addEventListener("click", () => saveScene(told.name, textsOf(state.changed)));
