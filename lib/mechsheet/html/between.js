// The root of f to which scipy's function of that name leads between two ends, of several one, or where f jumps over 0.
// NaN where scipy raises; of others than brentq and bisect also where there are several.
const MOST_TURNS = 2000;
function root_by(name, f, lo, hi) {
  const at = x => {
    const y = f(x);
    return isFinite(y) ? +y : NaN;
  };
  const a = at(lo), b = at(hi), way = {brentq: by_brent, bisect: by_halves}[name];
  if (a == 0) return {value: lo};
  if (b == 0) return {value: hi};
  if (!signs_differ(a, b)) return {value: NaN};
  if (way) return {value: way(at, lo, hi, a, b)};
  const {roots} = find(f, lo, hi, null);
  return {value: roots.length == 1 ? roots[0].value : NaN};
}

function by_halves(f, a, b, left) {
  for (let step = b - a, turn = 0; turn < MOST_TURNS; turn++) {
    step /= 2;
    const x = a + step, y = f(x);
    if (y != y) return NaN;
    if (y < 0 == left < 0) a = x;
    if (y == 0 || abs(step) < 4 * EPS * abs(x) + 1e-300) return x;
  }
  return NaN;
}

// Brent's method as scipy has it: x is the best place, `before` the one before it, `other` one beyond the root.
function by_brent(f, before, x, y_before, y) {
  let other = 0, y_other = 0, step_before = 0, step = 0;
  for (let turn = 0; turn < MOST_TURNS; turn++) {
    if (y_before != 0 && y < 0 != y_before < 0) [other, y_other, step_before, step] = [before, y_before, x - before, x - before];
    if (abs(y_other) < abs(y)) [before, x, other, y_before, y, y_other] = [x, other, x, y, y_other, y];
    const near = 2 * EPS * abs(x) + 5e-301, half = (other - x) / 2;
    if (y == 0 || abs(half) < near) return x;
    let next = half, known = half;
    if (abs(step_before) > near && abs(y) < abs(y_before)) {
      const p = (y_before - y) / (before - x), q = (y_other - y) / (other - x);
      const tried = before == other ? (-y * (x - before)) / (y - y_before)
        : (-y * (y_other * q - y_before * p)) / (q * p * (y_other - y_before));
      if (2 * abs(tried) < min(abs(step_before), 3 * abs(half) - near)) [known, next] = [step, tried];
    }
    [step_before, step, before, y_before] = [known, next, x, y];
    x += abs(step) > near ? step : half > 0 ? near : -near;
    y = f(x);
    if (y != y) return NaN;
  }
  return NaN;
}
