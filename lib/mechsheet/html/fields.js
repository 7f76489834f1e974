// The inputs as texts and as numbers in SI: read, checked against their limits, written into the address and as a scene.
const NUMBER = /^([+−-]?(?:\d+(?:[.,]\d*)?|[.,]\d+)(?:[eE][+−-]?\d+)?)\s*(.*)$/s;
const COMPARE = {"<": (a, b) => a < b, "<=": (a, b) => a <= b, ">": (a, b) => a > b, ">=": (a, b) => a >= b};

class Refused extends Error {}

const unitOf = field => (field.unit ? ` ${field.unit}` : "");
const says = (field, value) => `${field.meaning} ${field.name} = ${value}${unitOf(field)}`;

function refuse(field, value, must) {
  throw new Refused(`${says(field, value)} ${must}`);
}

// A number in the display unit, from a text behind which another unit may stand.
function readNumber(field, text) {
  const match = NUMBER.exec(text.trim());
  if (!match) refuse(field, `'${text.slice(0, 60)}'`, "is no number");
  let x = Number(match[1].replace(",", ".").replaceAll("−", "-"));
  const unit = match[2].trim();
  if (unit && unit !== field.unit) {
    if (!(unit in field.units)) refuse(field, `'${text.slice(0, 60)}'`, `has a unit that is none of ${Object.keys(field.units).join(", ") || "them"}`);
    x = Number(significant(x * (field.units[unit] / field.factor), 15));
  }
  if (field.whole && !Number.isInteger(x)) refuse(field, x, "must be a whole number");
  if (!Number.isFinite(x)) refuse(field, x, "must be a finite number");
  if (Math.abs(x) > told.inputs.most) refuse(field, x, `must be at most ${significant(told.inputs.most, 6)} in size`);
  return x;
}

const toSI = (field, x) => (x === field.shown ? field.own : x * field.factor);

function hold(field, x, shown, k) {
  const named = k === undefined ? field : {...field, name: `${field.name} (${k + 1})`};
  for (const [sign, other] of field.limits) {
    const given = typeof other === "number" ? other : shown.get(other);
    if (given === undefined) continue; // the other one is refused itself
    const limit = Array.isArray(given) ? given[k] : given;
    const length = sign === ">" && other === 0;
    if (!COMPARE[sign](x, limit)) {
      refuse(named, x, `must be ${length ? "positive" : `${sign} ${other}`}${typeof other === "number" ? "" : ` = ${limit}`}`);
    }
    if (length && Math.abs(x) < told.inputs.least) refuse(named, x, `must be at least ${significant(told.inputs.least, 6)}`);
  }
}

const inputOf = field => document.getElementById(`input-${field.name}`);
const gridOf = field => document.querySelector(`[data-grid="${field.name}"]`);

// All inputs: numbers in SI by the names that evaluate takes, those that differ from the document's own, what is refused,
// and what is to be noted of one that is not.
function readInputs() {
  const shown = new Map(), si = {}, changed = new Set(), errors = new Map(), notes = new Map();
  const attempt = (field, read) => {
    try {
      read();
    } catch (error) {
      if (!(error instanceof Refused)) throw error;
      if (!errors.has(field.name)) errors.set(field.name, error.message);
    }
  };
  for (const field of told.inputs.fields) {
    const input = inputOf(field);
    if (field.kind === "choice") si[field.name] = input.selectedIndex;
    else if (field.kind === "switch") si[field.name] = Number(input.checked);
    else if (field.kind === "text") si[field.name] = Number(input.value !== field.own);
    else if (field.kind === "number") {
      attempt(field, () => {
        const x = readNumber(field, input.value);
        shown.set(field.name, x);
        si[field.name] = toSI(field, x);
      });
    } else attempt(field, () => readRows(field, shown, si));
    const differs = {
      text: () => si[field.name] === 1,
      rows: () => field.columns.some(c => !same(si[c.name], c.own)),
    }[field.kind] ?? (() => si[field.name] !== field.own);
    if (differs()) changed.add(field.name);
    const [own, now] = [field.columns?.[0].own, si[field.columns?.[0].name]].map(rows => rows?.length);
    if (now && now !== own) notes.set(field.name, `${now} rows, ${own} in the document: what rests on them is not known here`);
  }
  for (const field of told.inputs.fields) {
    if (field.kind === "number" && shown.has(field.name)) attempt(field, () => hold(field, shown.get(field.name), shown));
    for (const column of field.columns ?? []) {
      if (shown.has(column.name)) attempt(field, () => shown.get(column.name).forEach((x, k) => hold(column, x, shown, k)));
    }
  }
  return {si, changed, errors, notes};
}

const same = (a, b) => Boolean(a) && a.length === b.length && a.every((x, i) => x === b[i]);

const cellsOf = field => [...gridOf(field).querySelectorAll("tbody tr")].map(row => [...row.querySelectorAll("input")].map(cell => cell.value.trim()));

function readRows(field, shown, si) {
  const rows = cellsOf(field).filter(cells => cells.some(Boolean));
  if (!rows.length) throw new Refused(`${field.meaning} ${field.name} must have 1 to 10000 rows, not 0`);
  field.columns.forEach((column, n) => {
    const named = k => ({...column, name: `${column.name} (${k + 1})`});
    const numbers = rows.map((cells, k) => readNumber(named(k), cells[n]));
    const own = new Map(column.shown.map((x, k) => [x, column.own[k]]));
    shown.set(column.name, numbers);
    si[column.name] = Float64Array.from(numbers, x => own.get(x) ?? x * column.factor);
  });
}

// The texts of the inputs that differ, as they are typed; of a list its rows.
const typed = field => {
  if (field.kind === "switch") return inputOf(field).checked ? "yes" : "no";
  if (field.kind !== "rows") return inputOf(field).value.trim();
  return cellsOf(field).filter(cells => cells.some(Boolean)).map(cells => cells.join("; ")).join(" | ");
};

function type(field, text) {
  const input = inputOf(field);
  if (field.kind === "switch") input.checked = ["yes", "true", "on", "1"].includes(text.trim().toLowerCase());
  else if (field.kind === "choice") {
    const at = [...input.options].findIndex(option => option.value === text);
    if (at >= 0) input.selectedIndex = at;
  } else if (field.kind === "rows") fillGrid(field, text.split(/[\n|]/).map(row => row.split(/[;\t]/).map(cell => cell.trim())));
  else input.value = text;
}

// Rows of a list; an empty one at the end is there to be filled in.
function fillGrid(field, rows) {
  const body = gridOf(field).querySelector("tbody"), width = field.columns.length;
  const cells = width > 1 ? rows : rows.flat().map(cell => [cell]);
  body.replaceChildren(...[...cells.filter(row => row.some(Boolean)), []].map((row, k) => gridRow(field, row, k)));
}

function gridRow(field, cells, k) {
  const row = document.createElement("tr"), head = document.createElement("th");
  head.textContent = k + 1;
  const each = field.columns.map((column, n) => {
    const cell = document.createElement("td"), input = document.createElement("input");
    Object.assign(input, {type: "text", inputMode: "decimal", spellcheck: false, value: cells[n] ?? ""});
    input.ariaLabel = `${column.name.split(".").at(-1)}, row ${k + 1}`;
    cell.append(input);
    return cell;
  });
  row.append(head, ...each);
  return row;
}

const textsOf = changed => told.inputs.fields.filter(f => changed.has(f.name)).map(f => ({...f, text: typed(f)}));

function readAddress() {
  const given = textsIn(location.hash);
  for (const field of told.inputs.fields) type(field, given.get(field.name) ?? field.text);
  return given.size > 0;
}
