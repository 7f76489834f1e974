// What numpy does that JavaScript does not. A field of numbers is flat, the last axis first; a shape is said beside it,
// or is its `shape` where only the numbers tell it.
const {abs, acos, asin, atan2, cos, exp, floor, log, max, min, sign, sin, sqrt, tan, trunc} = Math;
const square = x => x * x;
const pow = (x, y) => (x == 1 || (x == -1 && abs(y) == Infinity) ? 1 : x ** y);
// What Python's own numbers have an error for.
const per = (x, y) => (y == 0 ? NaN : x / y);
const refusing = x => (abs(x) == Infinity ? NaN : x);
const round = x => {
  const up = Math.round(x);
  return up - x == 0.5 && up % 2 ? up - 1 : up;
};
const mod = (x, y) => {
  const rest = x % y;
  return rest && rest < 0 != y < 0 ? rest + y : rest;
};

const field = n => new Float64Array(n);
const nothing = n => field(n).fill(NaN);
const flat = a => (a.length === undefined ? [a] : a);
const count = shape => shape.reduce((n, m) => n * m, 1);
const whole = n => (Number.isInteger(n) && n >= 0 && n <= 1e6 ? n : 1);
const rows = n => field(whole(n)).map((_, i) => (whole(n) == n ? i : NaN));
const shaped = (a, shape) => Object.assign(a, {shape});
const filled = (shape, x) => shaped(field(count(shape)).fill(x), shape);
const pick = (a, k) => (k >= 0 && k < a.length ? a[trunc(k)] : NaN);

const equal = (a, b) => {
  const [x, y] = [flat(a), flat(b)];
  return x.length == y.length && x.every((v, i) => v == y[i] || (v != v && y[i] != y[i]));
};

// Positions of elements that stand so many steps apart along each axis.
function positions(shape, steps, start = 0) {
  const at = new Int32Array(count(shape)).fill(start);
  for (let k = shape.length - 1, n = 1; k >= 0; n *= shape[k--])
    for (let j = n; j < n * shape[k]; j++) at[j] = at[j - n] + steps[k];
  return at;
}

const strides = shape => shape.map((_, k) => count(shape.slice(k + 1)));

function gather(a, at) {
  const b = field(at.length), x = flat(a);
  for (let i = 0; i < b.length; i++) b[i] = x[at[i]];
  return b;
}

// A field in the shape that it has together with others; no numbers where they do not go together.
const spreading = (from, to) => {
  const own = [...to.slice(from.length).map(() => 1), ...from], steps = strides(own);
  const fits = own.length == to.length && own.every((n, k) => n == 1 || n == to[k]);
  return fits ? positions(to, steps.map((step, k) => (own[k] == 1 ? 0 : step))) : nothing(count(to));
};
const spread = (a, from, to) => gather(a, spreading(from, to));

// A field of this shape, element by element.
function over(shape, f) {
  const a = field(count(shape));
  for (let i = 0; i < a.length; i++) a[i] = f(i);
  return a;
}

const together = (...shapes) => {
  const axes = max(...shapes.map(shape => shape.length));
  const along = k => shapes.map(shape => shape[k - axes + shape.length] ?? 1).filter(n => n != 1);
  return Array.from({length: axes}, (_, k) => (along(k).length ? max(...along(k)) : 1));
};

// What numpy's functions do that move elements: of a field and its shape a field that knows its own.

function sliced(n, start, stop, step) {
  const by = step ?? 1, least = by > 0 ? 0 : -1;
  const end = (v, otherwise) => (v === null ? otherwise : max(min(v < 0 ? v + n : v, n + least), least));
  const from = end(start, by > 0 ? 0 : n - 1), to = end(stop, by > 0 ? n : -1);
  return Array.from({length: max(0, Math.ceil((to - from) / by))}, (_, i) => from + i * by);
}

// An index: for each axis a number, {these: numbers}, or a slice [start, stop, step]; null is a new axis.
function picked(a, shape, keys) {
  const steps = strides(shape), size = [];
  let at = [0], k = 0;
  for (const key of keys) {
    const n = key === null ? 1 : shape[k], step = key === null ? 0 : steps[k++];
    const places = key === null ? [0] : typeof key == "number" ? [key] : key.these ?? sliced(n, ...key);
    const inside = places.map(i => (i >= n || i < -n ? NaN : step * (i < 0 ? i + n : i)));
    at = at.flatMap(p => inside.map(i => p + i));
    if (typeof key != "number") size.push(places.length);
  }
  return Object.assign(shaped(gather(a, at), size), {outside: at.some(i => i != i)});
}

function reshaped(a, _, dims) {
  const known = count(dims.filter(n => n >= 0)), shape = dims.map(n => (n < 0 ? flat(a).length / known : n));
  return count(shape) == flat(a).length ? shaped(all_of(a), shape) : shaped(nothing(1), dims.map(() => 1));
}

function moved(a, to) {
  const [n, from] = to(flat(a).length);
  return shaped(gather(a, each(n, from)), [n]);
}

function turned(a, shape, axes) {
  const steps = strides(shape), size = axes.map(k => shape[k]);
  return shaped(gather(a, positions(size, axes.map(k => steps[k]))), size);
}

// Several fields one after the other along an axis.
function joined(parts, shapes, axis) {
  const [first] = shapes, n = shapes.reduce((n, shape) => n + shape[axis], 0);
  const shape = first.map((m, k) => (k == axis ? n : m)), a = shaped(field(count(shape)), shape);
  if (shapes.some(other => other.some((m, k) => k != axis && m != first[k]))) return a.fill(NaN);
  for (let j = 0, at = 0; j < count(first.slice(0, axis)); j++)
    parts.forEach((part, k) => {
      const inner = count(shapes[k].slice(axis));
      a.set(flat(part).slice(j * inner, (j + 1) * inner), at);
      at += inner;
    });
  return a;
}

// A list of which so many rows are taken: those that are not there are no numbers.
const rows_of = (a, n) => (a.length < n ? all_of(a, nothing(n - a.length)) : a);

const stacked = (parts, shapes, axis) =>
  joined(parts, shapes.map(shape => [...shape.slice(0, axis), 1, ...shape.slice(axis)]), axis);

function all_of(...parts) {
  const a = field(parts.reduce((n, part) => n + flat(part).length, 0));
  let at = 0;
  for (const part of parts) {
    a.set(flat(part), at);
    at += flat(part).length;
  }
  return a;
}

// Reductions of a line of numbers, and of each line along an axis.
const fold = (f, start) => a => {
  let x = start;
  for (const v of a) x = f(x, v);
  return x;
};
// As numpy adds numbers that stand one after the other, to the last bit: a limit may be where they meet it.
function total(a) {
  const n = a.length, whole = n - n % 8;
  if (n < 8) return in_order(a);
  if (n > 128) {
    const half = (n >> 1) - (n >> 1) % 8;
    return total(a.slice(0, half)) + total(a.slice(half));
  }
  const r = a.slice(0, 8);
  for (let k = 8; k < whole; k++) r[k % 8] += a[k];
  let x = r[0] + r[1] + (r[2] + r[3]) + (r[4] + r[5] + (r[6] + r[7]));
  for (let k = whole; k < n; k++) x += a[k];
  return x;
}
const in_order = fold((x, v) => x + v, 0);
const known = f => a => f(a.filter(v => v == v));
const some = f => a => (a.length ? f(a) : NaN);
const first_of = better => some(a => a.reduce((k, v, i) => (a[k] == a[k] && (v != v || better(v, a[k])) ? i : k), 0));
const of = {
  sum: total, prod: fold((x, v) => x * v, 1), any: a => a.some(v => v != 0),
  all: a => a.every(v => v != 0), max: some(fold((x, v) => max(x, v), -Infinity)),
  min: some(fold((x, v) => min(x, v), Infinity)), argmax: first_of((v, w) => v > w), argmin: first_of((v, w) => v < w),
};
of.nanmax = known(of.max), of.nanmin = known(of.min), of.nansum = known(of.sum);
const next = {sum: (x, v) => x + v, prod: (x, v) => x * v, max, min, all: (x, v) => x && v != 0};

function lines(a, shape, axis, f) {
  const step = strides(shape)[axis], n = shape[axis], outer = count(shape.slice(0, axis));
  for (let i = 0; i < outer; i++)
    for (let j = 0; j < step; j++) {
      const line = field(n), start = i * n * step + j;
      for (let k = 0; k < n; k++) line[k] = a[start + k * step];
      f(line, start, step);
    }
}

function along(f, a, shape, axis, keep) {
  const size = keep ? shape.map((n, k) => (k == axis ? 1 : n)) : shape.filter((_, k) => k != axis);
  const b = shaped(field(count(size)), size);
  const g = f == total && strides(shape)[axis] > 1 ? in_order : f;  // as numpy does, row by row
  let at = 0;
  lines(a, shape, axis, line => (b[at++] = g(line)));
  return b;
}

function so_far(f, a, shape, axis) {
  const b = shaped(field(a.length), shape);
  lines(a, shape, axis, (line, j, step) => line.forEach((v, k) => (b[j + k * step] = k ? f(b[j + (k - 1) * step], v) : v)));
  return b;
}

// What was found before, unless what it rests on differs.
const before = {};
function unless_same(name, under, f) {
  if (!before[name]?.under.every((x, k) => equal(x, under[k]))) before[name] = {under, value: f()};
  return before[name].value;
}

const each = (n, f) => Array.from({length: n}, (_, p) => f(p));

const TURNS = 1e5;

// What a loop makes of its state; no numbers where it does not end. Whether it is known in each turn what that makes.
function repeated(state, most, turn) {
  let ends = false, known = true, now;
  for (let k = 0; k < (most ?? TURNS) && !ends; k++) {
    [state, ends, now] = turn(state);
    ends = flat(ends).every(v => v != 0);
    known &&= now;
  }
  known &&= ends || most !== null;
  const made = ends || most !== null ? state : state.map(v => (v.length === undefined ? NaN : nothing(v.length)));
  return Object.assign(made, {ends, known});
}

function gap(out, why, keys) {
  for (const key of keys) {
    out.values[key] = undefined;
    out.gaps[key] ??= why;
  }
}
