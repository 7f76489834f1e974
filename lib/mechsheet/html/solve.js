// Several equations in several unknowns, as the mechanics' newton and starts solve them; here one start of one problem
// after the other.
const STEP = EPS ** (1 / 3), SINGULAR = 2 ** 22;
function dot(a, b) {
  let sum = 0;
  for (let k = 0; k < a.length; k++) sum += a[k] * b[k];
  return sum;
}

const times = (rows, x) => rows.map(row => dot(row, x));

function all_finite(a) {
  for (let k = 0; k < a.length; k++) if (!isFinite(a[k])) return false;
  return true;
}

function norm(rows) {
  let sum = 0;
  for (const row of rows) sum += dot(row, row);
  return sqrt(sum);
}

const known_or_0 = v => (isFinite(v) ? v : 0);

// Singular values in descending order with the columns of u and v, by rotations of pairs of columns.
function decomposed(rows) {
  const n = rows[0].length, u = comb(n, k => rows.map(row => known_or_0(row[k])));
  const v = comb(n, k => comb(n, i => +(i == k)));
  for (let turn = 0, turned = true; turned && turn < 60; turn++) {
    turned = false;
    for (let i = 0; i < n; i++)
      for (let j = i + 1; j < n; j++) {
        const x = u[i], y = u[j];
        let a = 0, b = 0, c = 0;
        for (let m = 0; m < x.length; m++) (a += x[m] * x[m]), (b += y[m] * y[m]), (c += x[m] * y[m]);
        if (!(abs(c) > EPS * sqrt(a * b))) continue;
        turned = true;
        const zeta = (b - a) / (2 * c), t = (zeta < 0 ? -1 : 1) / (abs(zeta) + sqrt(1 + zeta * zeta));
        const cosine = 1 / sqrt(1 + t * t);
        rotate(x, y, cosine, cosine * t);
        rotate(v[i], v[j], cosine, cosine * t);
      }
  }
  const values = u.map(column => sqrt(dot(column, column)));
  const order = comb(n, k => k).sort((i, j) => values[j] - values[i]);
  return {
    values: order.map(k => values[k]), v: order.map(k => v[k]),
    u: order.map(k => u[k].map(x => (values[k] > 0 ? x / values[k] : 0))),
  };
}

function rotate(a, b, cosine, sine) {
  for (let k = 0; k < a.length; k++) {
    const x = a[k];
    a[k] = cosine * x - sine * b[k];
    b[k] = sine * x + cosine * b[k];
  }
}

// A square matrix by elimination; null of one that is next to singular. Of two unknowns one rotation takes less.
const REGULAR = 2 ** 40; // times that the largest pivot may be the least one
function eliminated(rows) {
  const n = rows.length, a = rows.map(row => row.slice()), order = comb(n, k => k);
  if (n < 3 || n != rows[0].length) return null;
  let most = 0, smallest = Infinity;
  for (let k = 0; k < n; k++) {
    let pivot = k;
    for (let m = k + 1; m < n; m++) if (abs(a[m][k]) > abs(a[pivot][k])) pivot = m;
    [a[k], a[pivot], order[k], order[pivot]] = [a[pivot], a[k], order[pivot], order[k]];
    const row = a[k];
    most = max(most, abs(row[k])), smallest = min(smallest, abs(row[k]));
    if (!(smallest * REGULAR > most)) return null;
    for (let m = k + 1; m < n; m++) {
      const own = a[m], part = (own[k] /= row[k]);
      for (let i = k + 1; i < n; i++) own[i] -= part * row[i];
    }
  }
  return {a, order};
}

function put_back({a, order}, r) {
  const n = a.length, x = order.map(k => r[k]);
  for (let k = 0; k < n; k++) for (let i = 0; i < k; i++) x[k] -= a[k][i] * x[i];
  for (let k = n - 1; k >= 0; k--) {
    for (let i = k + 1; i < n; i++) x[k] -= a[k][i] * x[i];
    x[k] /= a[k][k];
  }
  return x;
}

// Slopes that are solved by elimination as far as that does.
const solved = rows => {
  let parts;
  return {regular: eliminated(rows), parts: () => (parts ??= decomposed(rows))};
};

// The step within the radius, and the length of Newton's own step.
function step_within(slopes, r, radius) {
  if (slopes.regular) {
    const step = put_back(slopes.regular, r.map(v => (isFinite(v) ? -v : 0))), length = sqrt(dot(step, step));
    if (length <= radius) return [step, length];
  }
  const {u, values, v} = slopes.parts();
  const along = u.map(column => -dot(column, r.map(known_or_0)));
  const smallest = max(r.length, v.length) * EPS * values[0];
  let parts = along.map((x, k) => (values[k] > smallest ? x / values[k] : 0));
  const length = sqrt(dot(parts, parts));
  if (length > radius) {
    let damping = 0;
    for (let turn = 0; turn < 12; turn++) {
      const below = values.map(value => value * value + damping);
      parts = along.map((x, k) => (below[k] > 0 ? (values[k] * x) / below[k] : 0));
      const slope = -parts.reduce((sum, x, k) => sum + (below[k] > 0 ? (x * x) / below[k] : 0), 0);
      const norm = sqrt(dot(parts, parts));
      damping = max(damping + (slope < 0 ? (norm ** 2 / slope) * (1 - norm / radius) : 0), 0);
    }
    const scale = radius / max(sqrt(dot(parts, parts)), 1e-300);
    parts = parts.map(x => x * scale);
  }
  return [comb(v.length, n => parts.reduce((sum, x, k) => sum + x * v[k][n], 0)), length];
}

// f with each unknown by itself a step lower and higher: for each unknown two of its places and the residuals there.
const beside = (f, x, step, lo, hi) => x.map((own, k) =>
  [-1, 1].map(way => {
    const at = clip(own + way * step[k], lo[k], hi[k]), place = x.slice();
    place[k] = at;
    return [at, f(place)];
  }));

// Slopes [equation][unknown], one-sided where f has no number on the other side.
function differences(f, x, r, size, lo, hi) {
  const columns = beside(f, x, x.map((v, k) => STEP * max(abs(v), 2 ** -6 * size[k])), lo, hi);
  return r.map((own, m) => columns.map(([[low, below], [high, above]], k) => {
    const y = below[m], z = above[m], [a, b] = [isFinite(y) ? low : x[k], isFinite(z) ? high : x[k]];
    return ((isFinite(z) ? z : own) - (isFinite(y) ? y : own)) / (b - a);
  }));
}

// What an equation changes over the sizes of the unknowns at most.
function changed(slopes, size) {
  let most = 0;
  for (let k = 0; k < size.length; k++) most = max(most, abs(slopes[k] * size[k]));
  return most;
}

// Where f leads from a start; without a number it stays. `unit` weighs residuals whose squares shall be least.
function newton(f, x, size, lo, hi, reach, unit, free) {
  const n = x.length;
  let r = f(x), slopes = r.map(() => x.map(() => NaN)), scale = r.map(() => 0), evaluations = 1;
  let moving = all_finite(r), fresh = moving, sank = moving, radius = reach, before = Infinity;
  for (let turn = 0; turn < (free ? 20 : 100) && moving; turn++) {
    if (fresh) {
      slopes = differences(f, x, r, size, lo, hi);
      evaluations += 2 * n;
      if (!slopes.every(all_finite)) break;
    }
    const own_scale = unit ?? slopes.map(row => changed(row, size) || 1);
    scale = scale.map((v, m) => max(v, own_scale[m]));
    const jacobian = slopes.map((row, m) => row.map((v, k) => (v * size[k]) / own_scale[m]));
    const own = r.map((v, m) => v / own_scale[m]);
    let parts = solved(jacobian), [step, whole] = step_within(parts, own, radius);
    const held = step.map((v, k) => (x[k] <= lo[k] && v < 0) || (x[k] >= hi[k] && v > 0));
    if (held.includes(true)) {
      parts = solved(jacobian.map(row => row.map((v, k) => (held[k] ? 0 : v))));
      [step, whole] = step_within(parts, own, radius);
      step = step.map((v, k) => (held[k] ? 0 : v));
    }
    const part = free ? 1 / max(1, ...step.map((v, k) => abs(v * size[k]) / free[k])) : 1;
    step = step.map(v => v * part);
    const length = sqrt(dot(step, step)), target = x.map((v, k) => clip(v + step[k] * size[k], lo[k], hi[k]));
    const downhill = x.map(() => 0);
    jacobian.forEach((row, m) => row.forEach((v, k) => (downhill[k] += v * own[m])));
    const lowest = dot(downhill, downhill) <= (1e-9 * norm(jacobian)) ** 2 * dot(own, own);
    if ((whole <= 1e-6 && !sank && whole > 0.75 * before) || target.every((v, k) => v == x[k])
      || own.every(v => v == 0) || radius < 1e-12 || lowest) break;
    const there = f(target), left = there.map((v, m) => v / own_scale[m]);
    evaluations++;
    const ahead = times(jacobian, target.map((v, k) => (v - x[k]) / size[k])).map((v, m) => own[m] + v);
    const expected = dot(own, own) - dot(ahead, ahead), fallen = dot(own, own) - dot(left, left);
    let gain = fallen > 0 ? fallen / max(expected, 2 ** -1022) : -1;
    if (!unit && all_finite(left) && step_within(parts, left, Infinity)[1] < whole - length / 4) gain = max(gain, 0.5);
    const sinks = gain > 1e-4, taken = (sinks || whole <= 1e-6 || free) && all_finite(there);
    if (!free) radius = gain < 0.25 ? length / 4 : gain > 0.75 ? max(radius, 3 * length) : radius;
    moving = taken || !free;
    sank = sinks;
    fresh = taken;
    if (taken) [before, x, r] = [whole, target, there];
  }
  return {x, r, slopes, scale, evaluations};
}

// Whether all residuals are no more than rounding: what f varies by over the next floats.
function vanishing(f, {x, r, slopes, scale}, size, lo, hi) {
  const step = x.map((v, k) => EPS * max(8 * abs(v), size[k]));
  const around = beside(f, x, step, lo, hi).flat().map(side => side[1]);
  return r.every((own, m) => {
    const values = [own, ...around.map(y => y[m])], varied = largest(values) - least(values);
    const by_slopes = known_or_0(dot(slopes[m].map(abs), step));
    const noise = varied > 8 * by_slopes && varied > 2 ** -6 * scale[m], level = varied == 0 && slopes[m].every(v => v == 0);
    return abs(own) <= 8 * max(varied, by_slopes) && !level && !noise;
  });
}

// Where starts end, and whether in a solution.
function led(f, starts, at, reach, unit, free) {
  return starts.map(start => {
    let ended = newton(f, start, at.size, at.lo, at.hi, reach, unit, free);
    const fine = () => ended.x.map((v, k) => max(abs(v), at.least[k]));
    if (!unit && fine().some((v, k) => v < 2 ** -10 * at.size[k])) {
      const again = newton(f, ended.x, fine(), at.lo, at.hi, Infinity, null, at.size.map(() => Infinity));
      ended = {...again, evaluations: ended.evaluations + again.evaluations};
    }
    return {...ended, held: !unit && vanishing(f, ended, fine(), at.lo, at.hi)};
  });
}

// One more lot of starts, which fill the places evenly.
function lot(f, at, number, unit) {
  const n = at.first.length, many = 32 * n;
  let golden = 2;
  for (let k = 0; k < 64; k++) golden = (1 + golden) ** (1 / (n + 1));
  const share = (i, k) => (0.5 + golden ** -(k + 1) * (number * many + i)) % 1;
  return led(f, comb(many, i => at.first.map((a, k) => a * (1 - share(i, k)) + at.last[k] * share(i, k))), at, 1, unit);
}

// The solutions that are not the same as another one, in ascending order, and the start that came nearest to one.
function distinct(ends, size) {
  const scale = ends[0].scale.map((_, m) => largest(ends.map(end => end.scale[m])));
  const condition = end => {
    const {values} = decomposed(end.slopes.map((row, m) => row.map((v, k) => (v * size[k]) / scale[m])));
    const ratio = values[0] / values[values.length - 1];
    return ratio < 1 / EPS ? ratio : Infinity;
  };
  const radius = condition => min(64 * EPS * min(condition, 1 / EPS), 2 ** -10);
  const seen = [];
  for (const end of ends.filter(end => end.held)) {
    const own = {x: end.x, residual: end.r, get condition() { return condition(end); }};
    const same = other => other.x.every((v, k) =>
      abs(v - own.x[k]) <= max(radius(own.condition), radius(other.condition)) * size[k]);
    if (!seen.some(same)) seen.push(own);
  }
  seen.sort((a, b) => a.x[0] - b.x[0]);
  const left = ends.map(end => end.r.map((v, m) => abs(v) / scale[m]));
  const nearest = first_least(left.map(a => (all_finite(a) ? dot(a, a) : Infinity)));
  const {x, r, slopes} = ends[nearest];
  return {seen, evaluations: ends.reduce((sum, end) => sum + end.evaluations, 0), starts: ends.length,
    nearest: {x, residual: r, slopes, left: left[nearest]}, lowest: () => ({x, residual: r, condition: condition(ends[nearest])})};
}

function from_guess(f, at, unit) {
  if (unit) return distinct(led(f, [at.first], at, 100, unit), at.size);
  let [end] = led(f, [at.first], at, Infinity, null, at.most);
  if (!end.held) {
    const [more] = led(f, [at.first], at, 100, null);
    end = {...more, evaluations: end.evaluations + more.evaluations};
  }
  return distinct([end], at.size);
}

function between(f, at, unit) {
  let ends = [], known, before = -1, found = 0;
  for (let number = 0; number < 16 && found > before; number++) {
    before = found;
    ends = [...ends, ...lot(f, at, number, unit)];
    known = distinct(ends, at.size);
    const singular = known.seen.filter(({condition}) => condition > SINGULAR).length;
    found = known.seen.length - singular + min(singular, 1);
  }
  return known;
}

// Another solution right beside one at which slopes are singular, as of equations that depend on each other; or none.
function aside(f, at, {x, condition}) {
  if (!(condition > SINGULAR)) return undefined;
  const [{slopes, scale}] = led(f, [x], at, 1, null), size = at.size.map((v, k) => max(v, abs(x[k]) / 16));
  const {v} = decomposed(slopes.map((row, m) => row.map((w, k) => (w * size[k]) / scale[m]))), way = v[v.length - 1];
  const ends = led(f, [-1, 1].map(side => x.map((w, k) => w + side * 2 ** -7 * size[k] * way[k])), at, 1, null);
  return ends.find(end => {
    const off = max(...end.x.map((w, k) => abs(w - x[k]) / size[k]));
    return end.held && off > 2 ** -9 && off < 2 ** -5;
  })?.x;
}

// The verdict on equations f(x) = 0: x and residual (NaN where there is none), condition, evaluations, solutions,
// starts, the nearest place where none is a solution, a pair that is where there is a line of them, and the reason: ""
// where solved, else "nothing", "unsolved" or "depend".
// `asked` has of each unknown its guess or the two ends of its interval, `equals` the targets; with `unit` squares are
// made least. From a guess a step of Newton's own moves an unknown by no more than is in `most`.
function solve(f, asked, factors, most, equals, unit) {
  const none = {x: asked.map(() => NaN), residual: [], condition: NaN, evaluations: 0, solutions: [], starts: 0, asked};
  if ([...asked.flat(), ...equals].some(v => v != v)) return {...none, reason: "nothing"};
  const wrong = asked.findIndex(ends => !all_finite(ends) || ends[0] >= ends[1]);
  if (wrong >= 0) return {...none, reason: `the ends of unknown ${wrong + 1} must be finite and in order`};
  const size = asked.map(([a, b], k) => (b === undefined ? (a == 0 ? factors[k] : abs(a)) : b - a));
  const at = {
    first: asked.map(ends => ends[0]), last: asked.map(ends => ends[ends.length - 1]), size, most,
    least: size.map((v, k) => min(v, factors[k])), lo: asked.map(ends => (ends.length > 1 ? ends[0] : -Infinity)),
    hi: asked.map(ends => ends[1] ?? Infinity),
  };
  const real = x => f(x).map(v => (v - v == 0 ? +v : NaN));
  const guessed = at.first.every((a, k) => a == at.last[k]);
  const known = (guessed ? from_guess : between)(real, at, unit);
  const off = ({x}) => max(...x.map((v, k) => abs(v - (at.first[k] / 2 + at.last[k] / 2)) / size[k]));
  const best = unit ? known.lowest() : known.seen[first_near(known.seen.map(off), () => 2 ** -30)];
  const beside = unit || !best ? undefined : aside(real, at, best), chosen = beside ? undefined : best;
  const around = {...at, first: at.first.map((a, k) => a - size[k]), last: at.last.map((b, k) => b + size[k])};
  let others;
  const every = () => (others ??= guessed && !unit ? distinct(lot(real, around, 0, null), size) : known);
  const {evaluations, nearest} = known, is_known = chosen && all_finite(chosen.x);
  return {
    ...none, x: chosen?.x ?? none.x, residual: chosen?.residual ?? nearest.residual.map(() => NaN),
    evaluations, nearest, guessed, reason: is_known ? "" : beside ? "depend" : "unsolved", pair: [best?.x, beside],
    get condition() { return chosen?.condition ?? NaN; },
    get solutions() { return unit ? [] : every().seen.map(solution => solution.x); },
    get starts() { return every().starts; },
  };
}
