// Sliders and play buttons: what they move, and the marks that they set in charts.
const PASS = 3000; // ms from one end to the other while it plays
const POSITIONS = 400; // positions of a slider

// A text with the numbers of one position in its holes.
function filled(text, numbers) {
  let n = 0;
  return text.replace(/\0(\d)/g, (_, decimals) => {
    const x = numbers[n++], digits = String(Math.abs(x)).padStart(Number(decimals) + 1, "0");
    const at = digits.length - decimals;
    return (x < 0 ? "-" : "") + (decimals > 0 ? `${digits.slice(0, at)}.${digits.slice(at)}` : digits);
  });
}

const picturesOf = ({pieces, of, numbers}) => of.map((each, k) => () => filled(each.map(n => pieces[n]).join(""), numbers[k]));

const nearest = (positions, x) => positions.reduce((best, at, k) => (Math.abs(at - x) < Math.abs(positions[best] - x) ? k : best), 0);

const isSlid = name => moving.get(name) && moving.get(name).at !== moving.get(name).first;
const slid = () => Object.fromEntries([...moving].map(([name, control]) => [`slider ${name}`, control.positions[control.at]]));

// Show where a control is, and how far it goes.
function showControl(name) {
  const {positions, at} = moving.get(name);
  document.querySelectorAll(`[data-control="${name}"]`).forEach(input => {
    input.max = positions.at(-1);
    input.value = positions[at];
    input.closest(".ms-player").querySelector("output").textContent = significant(positions[at], 6);
  });
}

// Show what a control moves: from an evaluation, or one of the pictures that the document has.
function showMoved(name) {
  const control = moving.get(name), own = !state.changed.size;
  showControl(name);
  if (state.refused) return;
  control.elements.forEach(([spec, element, n]) => {
    if (spec.kind !== "moved") return soon(n, () => showNow(spec, element));
    soon(n, () => {
      set(element, own ? control.pictures[spec.picture][control.at]() : "");
      grey(element, own ? "" : MOVES_NOT);
    });
  });
  for (const [symbol, at] of Object.entries(control.marks)) setMark(symbol, own ? at[control.at] : NaN);
}

// On the charts alone: on the page as a whole all of its styles would be looked at again.
const figures = [...document.querySelectorAll(".ms-figure")];
const setMark = (symbol, at) => figures.forEach(figure => figure.style.setProperty(`--at-${symbol}`, Number.isFinite(at) ? at : -1e30));

function showPositions() {
  for (const [symbol, key] of Object.entries(told.positions)) setMark(symbol, state.results?.values[key]);
}

// Let sliders end where they do for these inputs; whether one had to leave its place.
function ended() {
  let left = false;
  for (const [name, control] of moving) {
    const stop = state.results.values[control.stop];
    if (!(stop >= control.own[0])) continue;
    const {own, at, unit, stepped} = control, there = control.positions[at], [start] = own;
    const every = Math.max(unit, ...own.slice(1).map((x, k) => x - own[k]));
    const before = own.filter(x => x <= stop), last = before[before.length - 1];
    const end = stepped ? Math.floor((stop - start) / unit + 1e-9) * unit : stop - start;
    const more = Array.from({length: Math.min(Math.floor(end / every + 1e-9), POSITIONS)}, (_, k) => (k + 1) * every);
    const places = [...more.filter(x => end - x > 1e-6 * unit), end].map(x => Number((start + x).toFixed(12)));
    control.positions = [...before, ...places.filter(x => x - last > 1e-6 * unit)];
    control.at = nearest(control.positions, there);
    left ||= control.positions[control.at] !== there;
  }
  return left;
}

// Move a control: what rests on it is computed anew.
function move(name, at) {
  moving.get(name).at = at;
  if (state.refused) return showMoved(name);
  state.results = computed();
  if (!state.results) return refresh();
  told.shown.forEach((spec, n) => {
    if (!spec.slid?.includes(name) || spec.control) return;
    const own = !state.changed.size && !spec.slid.some(isSlid);
    soon(n, own ? () => showFirst(n) : () => showOne(spec, n));
  });
  showMoved(name);
  showPositions();
}

// Where along its field a line stands: where its control has it.
function positionOf(spec) {
  const control = moving.get(spec.control);
  return control && spec.at !== undefined ? Number(control.pictures[spec.picture][control.at]()) : spec.at;
}

function play(button) {
  const name = button.closest(".ms-player").querySelector("[data-control]").dataset.control, control = moving.get(name);
  if (!control) return;
  const stop = () => {
    cancelAnimationFrame(control.timer);
    control.timer = 0;
    button.textContent = "▶";
    button.ariaLabel = "play";
  };
  if (control.timer) return stop();
  button.textContent = "❚❚";
  button.ariaLabel = "pause";
  const last = control.positions.length - 1, turning = "turning" in button.dataset;
  let begun = performance.now();
  const advance = now => {
    if (state.refused) return stop();
    control.timer = requestAnimationFrame(advance);
    const steps = Math.floor((now - begun) / PASS * last);
    if (steps < 1) return;
    begun = now;
    if (control.at >= last) control.step = -1;
    if (control.at <= 0) control.step = 1;
    move(name, turning ? (control.at + steps) % (last + 1) : Math.min(Math.max(control.at + steps * (control.step ?? 1), 0), last));
  };
  control.timer = requestAnimationFrame(advance);
}

for (const [name, {positions, pictures, which, marks, stop, stepped}] of Object.entries(told.moved)) {
  const elements = told.shown.flatMap((spec, n) => (spec.control === name ? [[spec, shownBy[n], n]] : []));
  const input = document.querySelector(`[data-control="${name}"]`);
  const at = nearest(positions, Number(input.getAttribute("value"))); // its own one may be between two steps
  moving.set(name, {positions, own: positions, unit: Number(input.step), stepped, stop, pictures: which.map(n => picturesOf(pictures[n])), marks, elements, at, first: at});
}

// The last position of a slider in each frame.
const dragged = new Map();

document.addEventListener("input", event => {
  const control = moving.get(event.target.dataset?.control);
  if (!control) return;
  if (!dragged.size) {
    requestAnimationFrame(() => {
      dragged.forEach((at, name) => move(name, at));
      dragged.clear();
    });
  }
  dragged.set(event.target.dataset.control, nearest(control.positions, Number(event.target.value)));
});

document.addEventListener("click", event => {
  const button = event.target.closest(".ms-play");
  if (button) play(button);
});
