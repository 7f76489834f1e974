// What is in view is shown at once, the rest while the browser has time, before it comes into view or is printed.
const inView = new Set(), waiting = new Map(), LEAST_TIME = 2; // ms
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
  (globalThis.requestIdleCallback ?? (f => setTimeout(f, 20, {timeRemaining: () => Infinity})))(time => {
    isAsked = false;
    for (const n of [...waiting.keys()]) if (time.timeRemaining() > LEAST_TIME) settle(n);
    if (waiting.size) whenIdle();
  });
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
addEventListener("beforeprint", settleAll);
