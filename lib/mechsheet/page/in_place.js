// A click on a formula or on an input's symbol edits its line there: typeset beneath as one types, Enter writes the file.
(() => {
  if (customElements.get("ms-in-place")) return;

  const EMPTY = { false: "F = m * a  # [N] force", true: "L: float = 0.5  # [m] length; > 0" };
  const UNSAVED = "a cell holds text that is not run and saved: run it and save (Ctrl+S), then write here";
  const TAKEN = 500; // ms between two questions whether the page has taken the file over
  const PATIENCE = 3000; // ms that nothing can be typed elsewhere, where something computes for long
  const SHOWN = ".ms-line, [data-line]";
  const later = () => new Promise((then) => setTimeout(then, TAKEN));
  const AGAIN = "the page was being computed anew meanwhile: once more";
  const READS = "another tab edits this worksheet: Take over, at the top, brings it here";
  const LEFT = "Enter writes this line, Esc leaves it as it was";
  let waiting; // the question that has no answer yet
  let last = Promise.resolve();
  let turn = Promise.resolve(); // of changes of the file: the next one is of a page that holds the one before
  const written = []; // changes, the last one at the end
  let count = 0;

  class InPlace extends HTMLElement {
    static observedAttributes = ["answer"];

    attributeChangedCallback(_name, _before, text) {
      const answer = JSON.parse(text);
      if (answer.number === undefined) waiting?.done({ why: AGAIN }); // another field, which was not asked
      else if (answer.number === waiting?.number) waiting.done(answer);
    }
  }
  customElements.define("ms-in-place", InPlace);

  // One question after the other: of two that wait for it, marimo would hear the later one alone.
  function ask(what) {
    last = last.then(() => answered(what));
    return last;
  }

  // What changes nothing is asked again where the page was being computed anew.
  async function answered(what, tries = 20) {
    const answer = await answerTo(what);
    if (answer.why !== AGAIN || !tries || ["write", "undo"].includes(what.do)) return answer;
    await later();
    return answered(what, tries - 1);
  }

  // The field takes its text as from the hand, and passes it on when it is left.
  function answerTo(what) {
    const area = document.querySelector("ms-in-place + * marimo-text-area")?.shadowRoot?.querySelector("textarea");
    if (!area) return { why: AGAIN };
    if (document.querySelector(".sticky .lucide-eye")) return { why: READS }; // its fields tell nothing
    const number = ++count;
    Object.getOwnPropertyDescriptor(HTMLTextAreaElement.prototype, "value").set.call(
      area,
      JSON.stringify({ number, ...what }),
    );
    area.dispatchEvent(new InputEvent("input", { bubbles: true }));
    area.dispatchEvent(new FocusEvent("focusout", { bubbles: true }));
    return new Promise((done) => (waiting = { number, done }));
  }

  const box = document.createElement("div");
  box.className = "ms-box";
  box.innerHTML =
    '<textarea rows="1" spellcheck="false" aria-label="line of the worksheet"></textarea><div class="ms-typed"></div>' +
    '<div class="ms-why" role="alert"></div><div class="ms-keys"><button data-do="write">write <kbd>Enter</kbd></button>' +
    '<button data-do="everywhere"></button><button data-do="below">new line below <kbd>Ctrl+Enter</kbd></button>' +
    '<button data-do="undo">undo <kbd>Ctrl+Z</kbd></button>' +
    '<button data-do="code">code</button><button data-do="close">close <kbd>Esc</kbd></button></div>';
  const [area, typed, why, keys] = box.children;
  const chip = document.createElement("div");
  chip.className = "ms-written";
  chip.role = "status";
  // What is edited: its place in the page, name, the line as it was, whether below it; busy while it is written; what is
  // told because one clicked elsewhere, and of the line as it was opened, until one types again; how often to take back
  // what is being written.
  let of;

  const isTypedIn = () => area.value !== (of.below ? "" : of.was);
  const isUnsaved = () => document.querySelector(".marimo-cell.needs-run");

  const explain = (text) => (why.textContent = [text, of.left].filter(Boolean).join("; "));

  function place() {
    if (!box.isConnected) return;
    if (!of.place.isConnected) edit(placeOf(of.name) ?? of.place); // it was drawn anew
    const at = of.place.getBoundingClientRect();
    box.style.left = `${at.left}px`;
    box.style.top = `${at.bottom + 2}px`;
    box.style.width = `${Math.max(at.width, 500)}px`;
  }
  document.addEventListener("scroll", place, { capture: true, passive: true });
  addEventListener("resize", place);

  // What is outlined, and has the box beneath it.
  function edit(host) {
    of.place.classList.remove("ms-edited");
    of.place = host;
    host.classList.add("ms-edited");
  }

  // Another name for what is needed elsewhere can be written there too.
  function offer([old, other] = []) {
    const button = keys.querySelector('[data-do="everywhere"]');
    button.hidden = !other;
    button.innerHTML = `${old} becomes ${other} everywhere <kbd>Alt+Enter</kbd>`;
  }

  function show(text) {
    area.value = text;
    offer();
    area.placeholder = EMPTY[of.name.startsWith("g.")];
    document.body.append(box);
    keys.querySelector('[data-do="undo"]').hidden = !written.length;
    toView();
  }

  function toView() {
    area.focus();
    toSight();
    grow();
  }

  // As high as its text, whose rows may be longer than the box is wide.
  function grow() {
    area.style.height = "";
    area.style.height = `${area.scrollHeight}px`;
  }

  function toSight() {
    place();
    const { top, bottom } = box.getBoundingClientRect();
    if (top < 0 || bottom > innerHeight - 150) of.place.scrollIntoView({ block: "center" });
  }

  async function open(host, name) {
    if (of && !area.readOnly && isTypedIn()) {
      of.left = LEFT; // what is typed is not lost by a click elsewhere
      explain("");
      return toView();
    }
    close();
    area.value = "";
    const mine = (of = { place: host, name, was: "", told: "", below: false, from: focused() });
    edit(host);
    typed.replaceChildren();
    const { line, why: told } = await turn.then(() => ask({ do: "open", name }));
    if (of !== mine) return;
    of.told = told || (isUnsaved() ? UNSAVED : "");
    explain(of.told);
    of.was = line ?? "";
    show(of.was);
    area.readOnly = line === undefined;
    if (line) preview();
  }

  function below() {
    of.below = true;
    why.textContent = "";
    typed.replaceChildren();
    show("");
  }

  function close() {
    const from = of?.from;
    of?.place.classList.remove("ms-edited");
    of = undefined;
    area.readOnly = false;
    box.remove();
    from?.focus(); // who works by keys goes on there
  }

  function focused(within = document) {
    const found = within.activeElement;
    return found?.shadowRoot?.activeElement ? focused(found.shadowRoot) : found;
  }

  // Who works by keys goes on where the line stands now.
  function focus(name) {
    const now = placeOf(name);
    const field = now?.querySelector("marimo-ui-element > *")?.shadowRoot?.querySelector("input, select, button");
    (field ?? now?.closest(SHOWN))?.focus({ preventScroll: true });
  }

  // One question at a time: what was typed meanwhile is asked for then.
  let timer;
  let asking = false;
  async function preview() {
    if (asking) return;
    const [mine, text] = [of, area.value];
    asking = true;
    const answer = await ask({ do: "type", name: of.name, was: of.was, new: text, below: of.below });
    asking = false;
    if (of && (of !== mine || area.value !== text)) return typing();
    if (!of || of.busy) return;
    offer(answer.renames);
    explain(answer.why ?? (isUnsaved() ? UNSAVED : of.told));
    typed.classList.toggle("ms-former", answer.shown === undefined);
    if (answer.shown === undefined) {
      if (typed.querySelector(".ms-badge")?.textContent === "mistake") typed.replaceChildren(); // of a text of before
      return;
    }
    typed.innerHTML = answer.shown;
    typed.querySelectorAll("[id]").forEach((each) => each.removeAttribute("id")); // the page's own lines have them
    toSight();
  }

  function typing() {
    grow();
    typed.classList.add("ms-former"); // until what stands there is of this text
    clearTimeout(timer);
    timer = setTimeout(() => of && (area.value.trim() || !of.below) && preview(), 200);
  }
  area.addEventListener("beforeinput", (event) => of.busy && event.preventDefault()); // it would not be written
  area.addEventListener("input", () => {
    of.left = "";
    of.told = "";
    of.sure = false; // of the text that was asked about
    offer();
    typing();
  });
  // What stands there is of the inputs that the page computes with.
  document.addEventListener("ms-used", () => of && !of.busy && typed.firstChild && typing());

  const inTurn = (act) => (turn = turn.then(act).catch(reportError)); // the next one has its turn all the same

  // Nothing is typed elsewhere until it is known what is in the file: it would be lost to the file that comes.
  async function change(what) {
    const [root, from] = [document.getElementById("root"), focused()];
    root.inert = true;
    const patience = setTimeout(() => (root.inert = false), PATIENCE);
    const answer = await ask(what);
    clearTimeout(patience);
    root.inert = false;
    if (focused() === document.body) from.focus({ preventScroll: true });
    return answer;
  }

  async function write(what, name, mine, then) {
    const tell = (text) => (mine && of === mine ? explain(text) : say(text));
    const answer = isUnsaved() ? { why: UNSAVED } : await change(what);
    if (mine) mine.busy = false;
    const own = what.new?.trim().match(/^(?:def\s+)?([\p{L}\p{N}_]+)/u)?.[1];
    if (own) name = (name.startsWith("g.") ? "g." : "") + own;
    if (answer.why) return tell(answer.why);
    if (answer.asks) {
      if (mine && of === mine) {
        of.sure = true;
        offer(answer.renames);
      }
      return tell(`${answer.asks}: Enter once more writes it, Esc leaves it as it was`);
    }
    if (what.do === "undo") written.pop();
    else written.push({ name, ...answer.written });
    for (; mine?.back > 0; mine.back--) undo();
    const byKeys = mine && of === mine && mine.from !== document.body;
    if (mine && of === mine) close();
    const done = `${name.replace("g.", "")} is ${what.do === "undo" ? "as it was" : "written"}`;
    say(`${done}, the page takes it over`);
    for (let n = 0; n < 40; n++) {
      if ((await ask({ do: "taken" })).taken) {
        say(done);
        if (then) return then(name);
        await later();
        return byKeys && focused() === document.body && focus(name);
      }
      await later();
    }
    say(`${done} into the file, but the page has not taken it over: open it by mechsheet edit, which watches the file`);
  }

  function say(text) {
    chip.textContent = text;
    if (written.length) {
      const back = document.createElement("button");
      back.innerHTML = `undo ${written.at(-1).name.replace("g.", "")} <kbd>Ctrl+Z</kbd>`;
      back.addEventListener("click", undo);
      chip.append(back);
    }
    document.body.append(chip);
  }

  function undo() {
    inTurn(() => {
      const last = written.at(-1);
      // Another line, and text that is typed, stay in the box while something is taken back.
      const mine = of && !of.busy && of.name === last?.name && !isTypedIn() ? of : undefined;
      return last && write({ do: "undo", before: last.after, after: last.before }, last.name, mine);
    });
  }

  const acts = {
    write(then, more = {}) {
      const mine = of;
      const { name, was, below, sure = false, busy } = mine;
      if (busy || area.readOnly || (!area.value.trim() && below)) return;
      clearTimeout(timer);
      [mine.busy, mine.back] = [true, 0];
      const what = { do: "write", name, was, new: area.value, below, sure, ...more };
      inTurn(() => write(what, name, mine, then));
    },
    everywhere() {
      acts.write(undefined, { everywhere: !keys.querySelector('[data-do="everywhere"]').hidden });
    },
    // What is typed is written first; the new line opens beneath it, where it stands then.
    below() {
      if (!isTypedIn() || !area.value.trim()) return below();
      acts.write(async (name) => {
        for (let n = 0; n < 20 && !placeOf(name); n++) await later();
        const now = placeOf(name);
        if (now && !of) open(now, name).then(below);
      });
    },
    undo,
    code() {
      of.place.closest(".marimo-cell").removeAttribute("data-ms-folded");
      close();
    },
    close,
  };
  keys.addEventListener("click", ({ target }) => acts[target.closest("button")?.dataset.do]?.());
  box.addEventListener("keydown", (event) => {
    event.stopPropagation(); // the editor has uses of its own for these keys
    if (event.key === "Escape") close();
    else if (event.key === "Enter" && !event.shiftKey) {
      event.preventDefault();
      acts[event.ctrlKey || event.metaKey ? "below" : event.altKey ? "everywhere" : "write"]();
    } else if (of.busy && event.key === "z" && (event.ctrlKey || event.metaKey)) of.back++; // of what is being written
  });

  const isTyped = (event) => event.composedPath()[0].closest?.("input, textarea, select, [contenteditable=true]");
  const pressed = (event) => {
    if (event.key !== "z" || !(event.ctrlKey || event.metaKey) || isTyped(event) || !written.length) return;
    event.preventDefault();
    event.stopPropagation();
    undo();
  };
  document.addEventListener("keydown", pressed, { capture: true }); // before the editor, which has uses of its own for it

  // What others need goes with its cell only when that is deleted once more; for its key the editor asks itself.
  let sure; // the cell that was asked about
  let entered; // the cell in which the keyboard was, which the palette (Ctrl+K) deletes
  document.addEventListener("focusin", ({ target }) => (entered = target.closest?.(".marimo-cell") ?? entered));

  function going({ target }) {
    const button = target.closest?.('[data-testid="delete-button"], [role="menuitem"], [cmdk-item]');
    if (button?.matches("[cmdk-item]")) return button.textContent === "Cell > Delete" ? entered : undefined;
    if (button?.role !== "menuitem") return button?.closest(".marimo-cell");
    return button.textContent === "Delete" ? document.querySelector('[data-state="open"] > .marimo-cell') : undefined;
  }

  const deleting = (event) => {
    const cell = going(event) ?? undefined;
    const again = cell === sure;
    sure = again ? undefined : cell;
    if (!cell || again) return;
    event.preventDefault();
    event.stopImmediatePropagation();
    ask({ do: "cell", name: cell.dataset.cellId }).then(({ asks }) => {
      if (asks) say(`${asks}: delete once more to let it go`);
      else if (cell === sure) event.target.dispatchEvent(new event.constructor(event.type, event));
    });
  };
  document.addEventListener("click", deleting, { capture: true });
  document.addEventListener("cmdk-item-select", deleting, { capture: true }); // Enter in the palette

  // A table or figure is edited beneath its caption: what is clicked in a chart is a place in it.
  function placeOf(name) {
    if (name.startsWith("g.")) return document.querySelector(`td[data-input="${name.slice(2)}"]`)?.parentElement;
    const shown = document.getElementById(`line-${name}`) ?? document.querySelector(`[data-line="${name}"]`);
    return shown?.querySelector(":scope > .ms-caption") ?? shown;
  }

  // A line, or the row of an input but for its field, by name; what is clicked for something else in it does that.
  function clicked(target) {
    if (box.contains(target) || target.closest?.("a, button, ms-unit, [data-input], marimo-ui-element, .ms-box")) return [];
    return target.closest?.("ms-figure svg") ? [] : lineOf(target);
  }

  function lineOf(target) {
    const row = target.closest?.(".ms-line, .ms-inputs tr, [data-line]");
    if (!row || !row.closest(".marimo-cell.interactive")) return [];
    if (row.dataset.line) return [row.querySelector(":scope > .ms-caption") ?? row, row.dataset.line];
    const input = row.querySelector(":scope > td[data-input]");
    let line = row;
    while (line && !input && !line.id) line = line.previousElementSibling; // further equations of a solve block
    if (input) return [row, `g.${input.dataset.input}`];
    return line?.id.startsWith("line-") ? [row, line.id.slice("line-".length)] : [];
  }

  // F2 on a field, a unit, or what is shown, as in a cell of a spreadsheet; Enter on what is shown.
  const opening = (event) => {
    const { key, target } = event;
    const isShown = target.matches?.(SHOWN) && !event.ctrlKey && !event.metaKey;
    const [row, name] = key === "F2" || (key === "Enter" && isShown) ? lineOf(target) : [];
    if (isShown) event.stopPropagation(); // a letter is a command for the whole cell to the editor
    if (!row) return;
    event.preventDefault();
    open(row, name);
  };
  document.addEventListener("keydown", opening, { capture: true });

  let down; // where the button of the mouse was pressed, and the name of its line
  document.addEventListener("click", (event) => {
    const [row, name] = clicked(event.target);
    const elsewhere = event.detail && down?.name !== name; // pressed on a unit, say, that was drawn anew since
    if (row && !elsewhere && !event.defaultPrevented && getSelection().isCollapsed) open(row, name);
  });

  // A line that is drawn anew before the button comes up is clicked too; the browser tells of none, or of what holds it.
  document.addEventListener("mousedown", ({ target }) => (down = { target, name: clicked(target)[1] }), { capture: true });
  document.addEventListener("mouseup", ({ target }) => {
    const [row, name] = clicked(target);
    if (row && name === down?.name && !down.target.isConnected && getSelection().isCollapsed) open(row, name);
  });
})();
