// Sliders and play buttons: the pictures of their positions, and the marks that they set in charts.
const STEP = 60; // ms between two pictures while it plays

async function unpacked(text) {
  const bytes = Uint8Array.from(atob(text), letter => letter.charCodeAt(0));
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"))).json();
}

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

function showMoved(name) {
  const control = moving.get(name);
  const known = !state.changed.size && !state.refused;
  document.querySelectorAll(`[data-control="${name}"]`).forEach(input => {
    input.value = control.positions[control.at];
    input.closest(".ms-player").querySelector("output").textContent = significant(control.positions[control.at], 6);
  });
  control.elements.forEach(([spec, element]) => {
    if (spec.kind === "value") return state.refused || showAlong(spec, element);
    const html = known ? control.pictures[spec.picture][control.at]() : "";
    set(element, html);
    grey(element, known ? "" : MOVES_NOT);
  });
  for (const [symbol, at] of Object.entries(control.marks)) {
    document.documentElement.style.setProperty(`--at-${symbol}`, known ? at[control.at] : -1e30);
  }
}

// Where along its field a line stands: where its control has it.
function positionOf(spec) {
  const control = moving.get(spec.control);
  return control && spec.at !== undefined ? Number(control.pictures[spec.picture][control.at]()) : spec.at;
}

function showAlong(spec, element) {
  const results = (state.results ??= evaluate({}));
  if (results.guards.length) return;
  grey(element, show.value(spec, element, results) ? "" : reasonOf(spec, results));
}

function play(button) {
  const name = button.closest(".ms-player").querySelector("[data-control]").dataset.control, control = moving.get(name);
  if (!control) return;
  const stop = () => {
    clearInterval(control.timer);
    control.timer = 0;
    button.textContent = "▶";
    button.ariaLabel = "play";
  };
  if (control.timer) return stop();
  button.textContent = "❚❚";
  button.ariaLabel = "pause";
  const last = control.positions.length - 1;
  control.timer = setInterval(() => {
    if (state.changed.size || state.refused) return stop();
    if (control.at >= last) control.step = -1;
    if (control.at <= 0) control.step = 1;
    const turned = "turning" in button.dataset && control.at >= last;
    control.at = turned ? 0 : control.at + (control.step ?? 1);
    showMoved(name);
  }, STEP);
}

for (const [name, text] of Object.entries(told.moved)) {
  unpacked(text).then(({positions, pictures, marks}) => {
    const elements = told.shown.flatMap((spec, n) => (spec.control === name ? [[spec, shownBy[n]]] : []));
    const input = document.querySelector(`[data-control="${name}"]`);
    moving.set(name, {positions, pictures: pictures.map(picturesOf), marks, elements, at: nearest(positions, Number(input.value))});
    showMoved(name);
  });
}

document.addEventListener("input", event => {
  const control = moving.get(event.target.dataset?.control);
  if (!control) return;
  control.at = nearest(control.positions, Number(event.target.value));
  requestAnimationFrame(() => showMoved(event.target.dataset.control));
});

document.addEventListener("click", event => {
  const button = event.target.closest(".ms-play");
  if (button) play(button);
});
