// What is in view is shown at once, the rest while the browser has time, before it comes into view or is printed.
const inView = new Set(), waiting = new Map(), WITHIN = 100, SLICE = 8; // ms
let isWatched = false, isAsked = false;

function soon(n, show) {
  if (!isWatched || inView.has(n)) {
    waiting.delete(n);
    return show();
  }
  waiting.set(n, show);
  whenIdle();
}

function settle(n) {
  const show = waiting.get(n);
  waiting.delete(n);
  show?.();
}

const settleAll = () => [...waiting.keys()].forEach(settle);

function whenIdle() {
  if (isAsked) return;
  isAsked = true;
  const ask = globalThis.requestIdleCallback ?? (f => setTimeout(f, SLICE, {timeRemaining: () => 0}));
  ask(time => {
    isAsked = false;
    const end = performance.now() + Math.max(time.timeRemaining(), SLICE);
    for (const n of [...waiting.keys()]) if (performance.now() < end) settle(n);
    if (waiting.size) whenIdle();
  }, {timeout: WITHIN});
}

const watcher = new IntersectionObserver(entries => {
  isWatched = true;
  for (const {target, isIntersecting} of entries) {
    const n = Number(target.dataset.n);
    inView[isIntersecting ? "add" : "delete"](n);
    if (isIntersecting) settle(n);
  }
}, {rootMargin: "30%"});
shownBy.forEach(element => watcher.observe(element));

// A formula of which a part is wider than the paper is smaller there.
const PAPER = 48; // em of the letters on it
function fitToPaper() {
  for (const line of document.querySelectorAll(".ms-line")) {
    const room = PAPER * parseFloat(getComputedStyle(line).fontSize);
    for (const part of line.querySelectorAll(":scope > :is(.ms-formula, .ms-numbers)")) {
      const widths = [...part.querySelectorAll("math")].map(math => math.getBoundingClientRect().width);
      part.style.setProperty("--fit", Math.min(1, room / Math.max(...widths)));
    }
  }
}
addEventListener("beforeprint", () => {
  settleAll();
  fitToPaper();
});
