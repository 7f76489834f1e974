// All roots of one equation in an interval, as the mechanics' roots and brackets find them; here of one problem.
const EPS = 2 ** -52;
const bits = new BigInt64Array(1), float = new Float64Array(bits.buffer);

function after(x, to) {
  if (x == to) return x;
  if (x == 0) return to > 0 ? 5e-324 : -5e-324;
  float[0] = x;
  bits[0] += to > x == x > 0 ? 1n : -1n;
  return float[0];
}

const spacing = x => after(abs(x), Infinity) - abs(x);
const clip = (x, low, high) => min(max(x, low), high);
function comb(n, f) {
  const a = [];
  for (let k = 0; k < n; k++) a.push(f(k));
  return a;
}

const least = a => a.reduce((x, v) => (v < x || x != x ? v : x), NaN);
const largest = a => a.reduce((x, v) => (v > x || x != x ? v : x), NaN);
// The first of those that are as near, by rounding, as the nearest one.
const first_near = (off, play) => {
  const nearest = off[first_least(off)];
  return off.findIndex(distance => distance <= nearest + play(nearest));
};
const first_least = a => a.reduce((k, v, i) => (v < a[k] || (a[k] != a[k] && v == v) ? i : k), 0);
const signs_differ = (a, b) => (a < 0 && b > 0) || (a > 0 && b < 0);
const by_place = rows => rows.sort((a, b) => a[0] - b[0]);

const COARSE = comb(7, k => (k + 1) / 8);
const FINE = [...comb(4, k => -(8 ** -(k + 2))), 0, ...comb(4, k => 8 ** -(k + 2))];
const PLACES = comb(97, k => (1 - cos((Math.PI * k) / 96)) / 2);
const AFTER = comb(20, k => 1.25 ** (k - 2));

// Samples are rows [x, y] in ascending order: more of them between low and high, some near a place.
function closer(f, rows, low, high, near) {
  const width = high - low, at = low < near && near < high ? near : low / 2 + high / 2, two = 2 * EPS * abs(at);
  const places = [...COARSE.map(c => low * (1 - c) + high * c), ...FINE.map(c => at + c * width), at - two, at + two];
  return by_place([...rows, ...places.map(u => clip(u, low, high)).map(u => [u, f(u)])]);
}

// The last float at which f is finite on the way from one row to another one.
function last_finite(f, rows, inside, outside) {
  const way = outside < inside ? -1 : 1, end = rows.length - 1;
  let out = way * rows[outside][0];
  let near = [2, 1, 0].map(k => rows[clip(inside - way * k, 0, end)]).map(row => (isFinite(row[1]) ? row : rows[inside]));
  near = near.map(([x, y]) => [way * x, y]);
  for (;;) {
    const [[x0, y0], [x1, y1], [last, y2]] = near;
    if (!(after(last, out) < out)) return way * last;
    const slope = (x1 - last) / (y1 - y2), bend = ((x0 - x1) / (y0 - y1) - slope) / (y0 - y2);
    const to = (y1 - y2 - slope / bend) / 2, vertex = last + to * (slope + bend * (to + y2 - y1));
    const all = closer(u => f(way * u), near, last, out, vertex);
    const k = all.findIndex(row => !isFinite(row[1]));
    if (k >= 0) out = all[k][0];
    near = all.slice(0, k < 0 ? all.length : k).slice(-3);
  }
}

// The extreme of f between three rows whose middle one is the least or the greatest.
function extreme(f, rows, floor) {
  const way = rows[1][1] > least([rows[0][1], rows[2][1]]) ? -1 : 1;
  let three = rows.map(([x, y]) => [x, way * y]);
  for (;;) {
    const [[low, y0], [mid, y1], [high, y2]] = three;
    const p = (mid - low) * (y1 - y2), q = (mid - high) * (y1 - y0);
    const vertex = mid - ((mid - low) * p - (mid - high) * q) / (2 * (p - q));
    const all = closer(u => way * f(u), three, low, high, vertex), best = first_least(all.map(row => row[1]));
    const level = all[best][1] + 4 * EPS * max(abs(y0), abs(y1), abs(y2));
    let left = best, right = best;
    do left--; while (left > 0 && !(all[left][1] > level));
    do right++; while (right < all.length - 1 && !(all[right][1] > level));
    three = [all[max(left, 0)], all[best], all[min(right, all.length - 1)]];
    const width = three[2][0] - three[0][0];
    if (!(width < (high - low) / 2 && width > 4 * (EPS * abs(mid) + floor))) return [three[1][0], way * three[1][1]];
  }
}

// The final bracket of a root between the first two rows [x, residual], whose signs differ; the third stands beside it.
function bracketed(g, rows, floor) {
  if (rows[0][0] < 0 && rows[1][0] > 0) rows = narrowed(g, rows, [0]);
  for (let poor = 0; ; ) {
    const [[a, ra], [b, rb], [c, rc]] = rows;
    const width = b - a, half = b / 2 - a / 2, unit = EPS * abs(b) + floor;
    if (!(width > 4 * unit && ra != 0 && rb != 0)) return rows.slice(0, 2);
    const share = ra / (rb - ra), line = a - width * share;
    const parabola = a + width * share * (rc / (rb - rc)) + (c - a) * (ra / (rc - ra)) * (rb / (rc - rb));
    const zero = a < parabola && parabola < b ? parabola : line, bent = abs(parabola - line) / 2;
    const off = max(bent < width ? bent : width / 4, 8 ** (1 + poor) * unit);
    const even = !(a < zero && zero < b) || width <= 64 * unit || poor > 2;
    const places = poor > 2 && width > 64 * unit
      ? comb(15, k => a * (1 - (k + 1) / 16) + b * ((k + 1) / 16))
      : [-1, 0, 1].map(k => (even ? a + half + (k * half) / 2 : zero + k * off));
    rows = narrowed(g, rows, places.map(u => clip(u, a, b)));
    poor = rows[1][0] - rows[0][0] > width / 4 ? poor + 1 : even && poor > 2 ? poor : 0;
  }
}

// The first change of sign between two ends and places between them, and the point beside it.
function narrowed(g, [low, high], places) {
  const all = [low, ...places.map(u => [u, g(u)]), high];
  const k = max(all.findIndex((row, n) => n + 1 < all.length && sign(row[1]) != sign(all[n + 1][1])), 0);
  return [all[k], all[k + 1], all[k > 0 ? k - 1 : k + 2]];
}

// The run of finite f around the finite sample nearest the guess, between the ends that are given.
function reachable(f, guess, lo, hi) {
  const rows = comb(129, k => guess * 2 ** ((k - 64) / 8)).map(x => clip(x, lo ?? -Infinity, hi ?? Infinity)).map(x => [x, f(x)]);
  const finite = rows.map(row => isFinite(row[1])), end = rows.length - 1;
  if (!finite.includes(true)) return [lo ?? rows[0][0], hi ?? rows[end][0]];
  const start = first_least(finite.map((holds, k) => (holds ? abs(k - 64) : Infinity)));
  let [first, last] = [start, start];
  while (first > 0 && finite[first - 1]) first--;
  while (last < end && finite[last + 1]) last++;
  return [lo ?? last_finite(f, rows, first, max(first - 1, 0)), hi ?? last_finite(f, rows, last, min(last + 1, end))];
}

const turning = rows => rows.map(([, own], k) => {
  const [left, right] = [rows[k - 1]?.[1], rows[k + 1]?.[1]];
  return (own <= left && own < right) || (own >= left && own > right);
});

function with_edges(f, rows) {
  const more = [];
  for (let i = 0; i + 1 < rows.length; i++) {
    const next = isFinite(rows[i + 1][1]), inside = i + next;
    if (isFinite(rows[i][1]) == next) continue;
    const edge = last_finite(f, rows, inside, 2 * i + 1 - inside);
    more.push(...comb(12, k => edge + (rows[inside][0] - edge) * (k / 12) ** 2).map(x => [x, f(x)]));
  }
  return by_place([...more, ...rows]);
}

// Which rows meet the target within what f varies over the next few floats: turns, ends and exact hits.
function touching(f, rows, equals, turn, floor) {
  const out = k => !(rows[k]?.[1] == rows[k]?.[1] && rows[k]), lo = rows[0][0], hi = rows[rows.length - 1][0];
  const end = rows.map((_, k) => (out(k - 1) || out(k + 1)) && !out(k));
  const touch = rows.map(([x, own], k) => {
    const unit = spacing(max(abs(own), abs(equals)));
    let looked = turn[k] || own == equals;
    if (end[k]) {
      const next = rows[(out(k - 1) ? k + 1 : k - 1 + rows.length) % rows.length][1];
      looked ||= !(abs(own - equals) > abs(own - next) + unit);
    }
    if (!looked) return false;
    const spread = [-1, 1].map(way => {
      const beside = [own, ...[1, 2, 4, 8].map(n => f(clip(x + way * n * (EPS * abs(x) + floor), lo, hi)))];
      return largest(beside) - least(beside);
    });
    return abs(own - equals) <= (end[k] ? max(...spread) : min(...spread)) + unit;
  });
  const zero = k => rows[k][1] == equals;
  return [touch.map((hit, k) => hit && (k == 0 || !zero(k) || !zero(k - 1))), end];
}

// How far a value is off the line through its neighbours at most, of rows [way off, residual] from 0 on.
const bent = rows =>
  2 * largest(rows.slice(1, -1).map(([t, r], k) => {
    const [[t0, r0], [t2, r2]] = [rows[k], rows[k + 2]];
    return abs(r - (r0 + (r2 - r0) * ((t - t0) / (t2 - t0))));
  }));

// What f is rounded by beside a bracket, where the slope has made up for the rise in it.
function rounding(g, ends, far) {
  const rise = abs(ends[1][1] - ends[0][1]);
  return largest([0, 1].map(k => {
    const way = k ? 1 : -1, [x, r] = ends[k], width = min(ends[1][0] - ends[0][0], far[k]);
    const places = comb(16, n => width ** (1 - n / 15) * far[k] ** (n / 15));
    const made_up = places.findIndex(t => abs(g(x + way * t) - r) >= rise / 2);
    const from = places[made_up < 0 ? 15 : made_up];
    return bent([[0, r], ...AFTER.map(n => min(n * from, far[k])).map(t => [t, g(x + way * t)])]);
  }));
}

// The root in the piece from row i on, and whether it is sound: no pole, no jump.
function crossing(f, rows, equals, i, floor) {
  const g = u => f(u) - equals, end = rows.length - 1, residual = ([x, y]) => [x, y - equals];
  const lower = abs(rows[i][1] - equals) < abs(rows[i + 1][1] - equals);
  let ends = bracketed(g, [rows[i], rows[i + 1], rows[clip(lower ? i - 1 : i + 2, 0, end)]].map(residual), floor);
  const [root, off] = ends[abs(ends[1][1]) < abs(ends[0][1]) ? 1 : 0];
  if (off == 0) ends = [[root, 0], [root, 0]];
  const [lo, hi] = [rows[0][0], rows[end][0]], ulp = EPS * abs(root) + floor, room = [ends[0][0] - lo, hi - ends[1][0]];
  const beside = [0, 1].map(k => {
    const [x, r] = ends[k];
    return [[0, r], ...[8, 16, 2 ** 33].map(n => min(n * ulp, room[k])).map(t => [t, g(x + (k ? t : -t))])];
  });
  const away = largest(beside.map(rows => abs(rows[3][1]))), unit = spacing(max(abs(equals), abs(off)));
  const rise = abs(ends[1][1] - ends[0][1]), width = ends[1][0] - ends[0][0];
  const slope = largest(beside.flatMap(rows => rows.slice(1, 3).map(([t, r]) => abs(r - rows[0][1]) / t)));
  let explained = rise <= 8 * (width * slope + largest(beside.map(rows => bent(rows.slice(0, 3))))) + 4 * unit;
  if (!explained) {
    const far = max(2 ** 33 * ulp, 2 ** -20 * hi - 2 ** -20 * lo), own = rows.map(row => row[1]);
    const rounded = rounding(g, ends, room.map(t => min(far, t)));
    explained = rise <= 8 * (width * slope + rounded) && rise <= 2 ** -16 * (largest(own) - least(own));
  }
  const sound = explained && abs(off) <= 4 * away + 4 * unit;
  return {value: root, residual: off, bracket: [ends[0][0], ends[1][0]], sound};
}

// The verdict on f(x) = equals: value (NaN where there is none), residual, bracket, interval, reached, roots, samples,
// jump, evaluations, and the reason: "" where solved, else "nothing", "closes", "outside", "level", "jumps" or what is wrong
// with the numbers given.
function find(f, lo, hi, guess, equals = 0) {
  let evaluations = 0;
  const at = x => {
    const y = f(x);
    evaluations++;
    return isFinite(y) ? +y : NaN;
  };
  const none = {value: NaN, residual: NaN, bracket: [NaN, NaN], interval: [NaN, NaN], reached: [NaN, NaN], roots: [],
    samples: 0, jump: NaN, evaluations: 0, equals};
  const given = Object.entries({lo, hi, guess, equals}).filter(([, v]) => v !== null);
  if (given.some(([, v]) => v != v)) return {...none, reason: "nothing"};
  const wrong = given.find(([, v]) => !isFinite(v));
  if (wrong) return {...none, reason: `${wrong[0]} must be finite`};
  const within = lo !== null && hi !== null;
  for (const [a, b, u, v] of within ? [[lo, hi, "lo", "hi"]] : [[lo, guess, "lo", "guess"], [guess, hi, "guess", "hi"]])
    if (a !== null && b !== null && a >= b) return {...none, reason: `${u} must be less than ${v}`};
  if (!within && guess <= 0) return {...none, reason: "guess must be positive"};

  at(within ? lo / 2 + hi / 2 : guess);
  const [low, high] = within ? [lo, hi] : reachable(at, guess, lo, hi);
  const near = guess ?? low / 2 + high / 2, floor = EPS ** 2 * high - EPS ** 2 * low;
  let rows = PLACES.map((c, k) => (k == 0 ? low : k == 96 ? high : low * (1 - c) + high * c)).map(x => [x, at(x)]);
  if (rows.some(row => row[1] != row[1])) rows = with_edges(at, rows);
  const samples = (within ? 0 : 129) + rows.filter((row, k) => k == 0 || row[0] != rows[k - 1][0]).length;
  const turns = turning(rows).map((holds, k) => {
    if (!holds) return false;
    const own = rows[k][1], rise = max(abs(own - rows[k - 1][1]), abs(own - rows[k + 1][1]));
    const passed = (own > rows[k + 1][1] ? 1 : -1) * (own - equals);
    return passed >= -64 * rise && passed <= 2 ** -10 * rise;
  });
  const turned_rows = rows.map((row, k) => (turns[k] ? extreme(at, rows.slice(k - 1, k + 2), floor) : row));
  const order = comb(rows.length, k => k).sort((a, b) => turned_rows[a][0] - turned_rows[b][0]);
  rows = order.map(k => turned_rows[k]);
  const [touch, end] = touching(at, rows, equals, order.map(k => turns[k]), floor);
  const inner = touch.map((hit, k) => hit && !end[k]), known = rows.filter(([, y]) => y == y);
  const level = known.length > 2 && known.every(([, y]) => abs(y - equals) <= 4 * spacing(equals)); // any x would do

  const found = [];
  for (let i = 0; i + 1 < rows.length && !level; i++)
    if (signs_differ(rows[i][1] - equals, rows[i + 1][1] - equals) && !inner[i] && !inner[i + 1])
      found.push(crossing(at, rows, equals, i, floor));
  const jump = least(found.filter(root => !root.sound).map(root => root.value));
  const roots = found.filter(root => root.sound);
  rows.forEach(([x, y], k) => {
    const again = found.some(root => root.sound && abs(root.value - x) <= 2 ** 12 * (EPS * abs(x) + floor));
    if (touch[k] && !again && !level) roots.push({value: x, residual: y - equals, bracket: [x, x]});
  });
  roots.sort((a, b) => a.value - b.value);
  const nearest = roots[first_near(roots.map(root => abs(root.value - near)), off => 2 ** -30 * off + 8 * EPS * abs(near))];
  return {
    ...none, ...nearest, roots, interval: [low, high], samples, jump,
    get evaluations() { return evaluations; },
    get reached() {
      const top = turning(rows).map((holds, k) => (holds ? extreme(at, rows.slice(k - 1, k + 2), floor)[1] : NaN));
      const all = [...rows.map(row => row[1]), ...top];
      return [least(all), largest(all)];
    },
    get reason() {
      const [bottom, top] = this.reached;
      if (nearest || level) return nearest ? "" : "level";
      return bottom != bottom ? "closes" : bottom <= equals && equals <= top ? "jumps" : "outside";
    },
  };
}

// A verdict that knows its assembly branch, and all of them with their own, which are searched when they are asked for.
function on_branch(branch, verdict, functions, ...given) {
  let all;
  const every = () => (all ??= functions.map(([s, f]) => [s, s == branch ? verdict : find(f, ...given)]));
  return Object.defineProperties(verdict, {branch: {value: branch}, branches: {get: every}});
}
