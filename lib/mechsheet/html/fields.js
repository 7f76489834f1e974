// The inputs as texts and as numbers in SI: read, checked against their limits, written into the address and as a scene.
const NUMBER = /^([+−-]?(?:\d+(?:[.,]\d*)?|[.,]\d+)(?:[eE][+−-]?\d+)?)\s*(.*)$/s;
const UNIT = /^($|\p{L}|[%°]|1\/)/u; // as Python takes what stands behind a number for a unit
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
  if (!match || !UNIT.test(match[2])) refuse(field, `'${text.slice(0, 60)}'`, "is no number");
  let x = Number(match[1].replace(",", ".").replaceAll("−", "-"));
  const unit = match[2].trim();
  if (unit && unit !== field.unit) {
    if (!(unit in field.units)) {
      const known = Object.keys(field.units).join(", ") || "no unit";
      throw new Refused(`${field.meaning} ${field.name} = '${text.slice(0, 60)}': ${unit.slice(0, 60)} is not known here: ${known}`);
    }
    x = Number(significant(x * field.units[unit], 15));
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
      refuse(named, x, `must be ${length ? "positive" : `${sign} ${other === limit ? "" : `${other} = `}${limit}${unitOf(field)}`}`);
    }
    if (length && Math.abs(x) < told.inputs.least) refuse(named, x, `must be at least ${significant(told.inputs.least, 6)}${unitOf(field)}`);
  }
}

const inputOf = field => document.getElementById(`input-${field.name}`);

// All inputs: numbers in SI by the names that evaluate takes, those that differ from the document's own, and what is
// refused.
function readInputs() {
  const shown = new Map(), si = {}, changed = new Set(), errors = new Map();
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
  }
  for (const field of told.inputs.fields) {
    if (field.kind === "number" && shown.has(field.name)) attempt(field, () => hold(field, shown.get(field.name), shown));
    for (const column of field.columns ?? []) {
      if (shown.has(column.name)) attempt(field, () => shown.get(column.name).forEach((x, k) => hold(column, x, shown, k)));
    }
  }
  return {si, changed, errors};
}

const typedIn = new Map(); // of the columns of texts, by their names

// A text in one line, which has none of the signs that stand between the cells of a table.
function readText(column, cell) {
  const text = cell.replace(/\s+/g, " ").trim(), {longest} = told.inputs;
  if ([...text].length > longest || /\p{C}/u.test(text)) refuse(column, `'${text.slice(0, 60)}'..`, `must be a line of at most ${longest} characters`);
  if (/[;|]/.test(text)) refuse(column, `'${text.slice(0, 60)}'`, "must be a text without ; and |");
  return text;
}

const same = (a, b) => Boolean(a) && a.length === b.length && a.every((x, i) => x === b[i]);

function readRows(field, shown, si) {
  const rows = cellsOf(field);
  const {rows: most} = told.inputs;
  if (!rows.length || rows.length > most)
    throw new Refused(`${field.meaning} ${field.name} must have 1 to ${most} rows, not ${rows.length}`);
  field.columns.forEach((column, n) => {
    const named = k => ({...column, name: `${column.name} (${k + 1})`});
    if (column.texts) {
      const texts = rows.map((cells, k) => readText(named(k), cells[n]));
      typedIn.set(column.name, texts);
      si[column.name] = Float64Array.from(texts, (text, k) => Number(text !== column.texts[k]));
      return;
    }
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
  return cellsOf(field).map(cells => cells.join("; ")).join(" | ");
};

function type(field, text) {
  const input = inputOf(field);
  if (field.kind === "switch") input.checked = ["yes", "true", "on", "1"].includes(text.trim().toLowerCase());
  else if (field.kind === "choice") {
    const at = [...input.options].findIndex(option => option.value === text);
    if (at >= 0) input.selectedIndex = at;
  } else if (field.kind === "rows") fillGrid(field, text);
  else input.value = text;
}

const textsOf = changed => told.inputs.fields.filter(f => changed.has(f.name)).map(f => ({...f, text: typed(f)}));

// Every field by the address, which may carry what there is not: it is told.
function readAddress() {
  const given = textsIn(location.hash);
  for (const field of told.inputs.fields) type(field, given.get(field.name) ?? field.text);
  const options = field => (field.kind === "choice" ? [...inputOf(field).options].map(option => option.value) : undefined);
  state.strange = [...strange(given, new Map(told.inputs.fields.map(field => [field.name, options(field)]))).values()];
}
