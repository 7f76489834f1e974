// Inputs of the page as a whole: what is changed, a step back and on, the document's own, a link and a scene with them.
(() => {
  if (customElements.get("ms-used")) return;

  let fields = []; // as they were last computed with: the text of each, and what its field said, such as 0,055 m
  const steps = []; // sets of texts that the page has computed, by the names of the inputs
  let at = -1;
  let asked; // the set that was typed into the fields and is on its way through the page
  const unheard = new Set(); // fields that have not told their values since they were typed into
  const moved = new Set(); // fields that have been typed into since the page is open

  // The element beside the fields tells of all that have changed; of each alone marimo would keep the last, and lose
  // what was typed before it while the page computed.
  const alone = ({ objectId }) => document.querySelector(`td[data-input] marimo-ui-element[object-id="${CSS.escape(objectId)}"]`);
  // A second tab of an editor reads: what is typed there would be computed beside the fields of the first.
  const reads = () => document.querySelector(".sticky .lucide-eye");
  const hear = (event) => {
    const field = alone(event.detail);
    if (reads()) {
      event.stopImmediatePropagation();
      const name = field?.closest("td").dataset.input;
      if (!unheard.delete(name) && field) setTimeout(() => eachBar((bar) => bar.follow())); // not by the page itself
      return;
    }
    if (!field) return;
    const name = field.closest("td").dataset.input;
    unheard.delete(name);
    moved.add(name);
    event.stopImmediatePropagation();
  };
  window.addEventListener("marimo-value-ready", hear, true);

  // What the user types stays; what is typed here does not leave the field's shadow.
  const byHand = (event) => {
    const cell = event.isTrusted && event.target.closest?.("td[data-input]");
    const changes = event.type !== "click" || event.composedPath()[0].closest?.("button, [role=checkbox]");
    if (!cell || !changes) return;
    unheard.delete(cell.dataset.input);
    moved.add(cell.dataset.input);
  };
  ["input", "change", "click"].forEach((kind) => document.addEventListener(kind, byHand, true));

  // Esc takes back what is typed into a field, or into a cell of a grid, and not computed with yet.
  let held; // the field in which one types, and what it held before
  const typedInto = (event) => {
    const field = event.target.closest?.("td[data-input]") && event.composedPath()[0];
    return field?.matches?.("input:not([type=checkbox]), textarea") ? field : undefined;
  };
  const hold = (event) => (held = { field: typedInto(event), text: typedInto(event)?.value });
  document.addEventListener("focusin", hold);
  document.addEventListener("keydown", (event) => {
    const field = typedInto(event);
    if (field && event.key === "Enter") return hold(event);
    if (!field || event.key !== "Escape" || field !== held?.field || field.value === held.text) return;
    setter(field.constructor).call(field, held.text);
    field.dispatchEvent(new InputEvent("input", { bubbles: true, composed: true }));
    field.select?.();
  });

  const setter = (kind) => Object.getOwnPropertyDescriptor(kind.prototype, "value").set;
  const same = (a, b) => Object.keys(a).every((name) => a[name] === b[name]);

  const eachBar = (act) => document.querySelectorAll("ms-states").forEach(act);
  const hostOf = (name) => document.querySelector(`td[data-input="${name}"] marimo-ui-element > *`);
  const fieldOf = (name) => hostOf(name)?.shadowRoot?.querySelector("input, textarea, select, button");

  // Typed into until it is heard: a field that is there may not listen yet.
  function typeAll(texts, tries = 300) {
    if (asked !== texts || !tries || !unheard.size) return; // another set may have been asked for since
    [...unheard].filter((name) => name in texts && fieldOf(name)).forEach((name) => type(name, texts[name]));
    setTimeout(() => typeAll(texts, tries - 1), 100);
  }

  // A field takes its text as from the hand.
  function type(name, text) {
    const [host, field] = [hostOf(name), fieldOf(name)];
    if (field.matches("select")) {
      const option = [...field.options].find((each) => each.text === text || each.value === text);
      setter(HTMLSelectElement).call(field, option?.value ?? text);
      field.dispatchEvent(new Event("change", { bubbles: true }));
    } else if (field.matches("button, [type=checkbox]")) {
      if (words(name) !== text) field.click();
    } else {
      // First another text: one that is there already is no change.
      for (const each of ["", text]) {
        setter(field.constructor).call(field, each);
        field.dispatchEvent(new InputEvent("input", { bubbles: true }));
      }
      field.dispatchEvent(new FocusEvent("focusout", { bubbles: true }));
      const grid = host.closest("td").querySelector("ms-grid");
      grid?.show(text);
    }
  }

  // Symbol, unit and meaning beside a field.
  function called(name) {
    const beside = [...hostOf(name).closest("tr").cells].filter((cell) => !cell.dataset.input);
    return beside.map((cell) => cell.textContent.trim()).filter(Boolean).join(", ");
  }

  // What a field shows, however it came there; nothing of one that is not drawn yet.
  function words(name) {
    const field = fieldOf(name);
    if (field?.matches("select")) return field.selectedOptions[0]?.text ?? "";
    if (!field?.matches("button, [type=checkbox]")) return field?.value;
    return field.getAttribute("aria-checked") === "true" || field.checked === true ? "yes" : "no";
  }

  // What a field has shown first.
  function begun(name) {
    const [first] = [JSON.parse(hostOf(name).dataset.initialValue)].flat();
    return typeof first === "boolean" ? (first ? "yes" : "no") : first;
  }

  // Names of the fields that show anything but a set of texts, be it in other words.
  function others(texts) {
    const shows = ({ name, said, text }) => {
      const now = words(name) ?? said;
      return now === texts[name] || (now === said && text === texts[name]);
    };
    return fields.filter((field) => field.name in texts && !shows(field)).map(({ name }) => name);
  }

  // Whether the page has computed with all that was asked for, but for what the user has typed over it since.
  function arrived() {
    const typed = new Set(others(asked).filter((name) => !unheard.has(name)));
    const due = fields.filter(({ name }) => name in asked && !typed.has(name));
    return due.every(({ name, said, text }) => [said, text].includes(asked[name]));
  }

  const textsNow = () => Object.fromEntries(fields.map(({ name, text }) => [name, text]));
  const ownTexts = () => Object.fromEntries(fields.map((field) => [field.name, field.own]));

  // The inputs that the page computes with, told anew with each run; nothing while one of them is refused.
  class Used extends HTMLElement {
    static observedAttributes = ["told"];

    connectedCallback() {
      this.tell();
    }

    disconnectedCallback() {
      queueMicrotask(() => {
        eachBar((bar) => bar.show());
        document.dispatchEvent(new Event("ms-used"));
      });
    }

    attributeChangedCallback() {
      if (this.isConnected) this.tell();
    }

    tell() {
      fields = JSON.parse(this.getAttribute("told"));
      eachBar((bar) => bar.follow());
      document.dispatchEvent(new Event("ms-used"));
    }
  }

  // At the latest after a second: now and then Chromium has nothing to do and finds no idle time either.
  const whenIdle = (act) => (window.requestIdleCallback ?? setTimeout)(act, { timeout: 1000 });

  class States extends HTMLElement {
    constructor() {
      super();
      this.addEventListener("click", ({ target }) => this.act(target.closest("button")?.name));
      this.addEventListener("change", ({ target }) => this.to({ ...ownTexts(), ...this.offered[target.value].texts }));
    }

    connectedCallback() {
      if (fields.length) this.follow();
    }

    get offered() {
      return JSON.parse(this.getAttribute("scenes"));
    }

    get refused() {
      return !document.querySelector("ms-used");
    }

    // Of a set on its way the states in between are no steps of their own.
    follow() {
      const now = textsNow();
      const first = at < 0;
      if (asked && (reads() || arrived())) {
        asked = undefined;
        unheard.clear();
      }
      if (first || !(asked || same(steps[at], now))) steps.splice(++at, steps.length, now);
      this.show();
      if (first && this.open()) return;
      this.resume();
      if (!asked) whenIdle(() => this.address()); // which takes longer than all else here
    }

    // Fields begin anew where a page is opened again on an editor that still computes with what was typed before. One
    // that shows something else was typed into before anything here listened.
    resume(tries = 100) {
      if (tries && !fields.every(({ name }) => fieldOf(name))) return setTimeout(() => this.resume(tries - 1), 100);
      fields.forEach(({ name }) => ((fieldOf(name) ?? {}).ariaLabel = called(name))); // which a screen reader says
      const isAnew = (name) => reads() || (!moved.has(name) && words(name) === begun(name));
      const anew = fields.filter(({ name }) => fieldOf(name) && isAnew(name));
      const stale = anew.filter(({ name, said, text }) => ![said, text].includes(words(name)));
      if (!stale.length) return;
      stale.forEach(({ name }) => unheard.add(name));
      this.to({ ...textsNow(), ...asked });
    }

    // What a link carries, whether it carries anything; all else is as in the document, and what no input takes is told.
    open() {
      const given = textsIn(location.hash);
      this.strange = strange(given, new Map(fields.map(({ name, options }) => [name, options])));
      const known = [...given].filter(([name]) => !this.strange.has(name));
      if (given.size) this.to({ ...ownTexts(), ...Object.fromEntries(known) });
      return given.size > 0;
    }

    get given() {
      return fields.filter(({ own, text }) => own !== text);
    }

    address() {
      const text = addressOf(this.given);
      // Whole: marimo's page has a base, to which a fragment alone would lead from a worksheet that the query names.
      const page = location.pathname + location.search;
      if (text || location.hash.includes("=")) history.replaceState(history.state, "", page + (text && `#${text}`));
    }

    // The buttons stay the same ones: one that is drawn anew between press and release is not clicked.
    draw() {
      const button = (name, label, title) => `<button name="${name}" title="${title}">${label}</button>`;
      this.innerHTML =
        `<div class="ms-row">${button("undo", "↶ undo", "the inputs before the last change")}` +
        button("redo", "↷ redo", "the inputs after it") +
        button("back", "back to the document", "all inputs as the document has them") +
        button("link", "copy a link", "an address with these inputs") +
        button("scene", "save as a scene", "a file of these inputs, for --scene and compare") +
        `<span class="ms-scenes"></span><span role="status"></span></div><div class="ms-row"></div>`;
    }

    enable() {
      const changed = this.given.length > 0;
      const { refused } = this; // then what link and scene would carry is of before, and not what the fields say
      const can = { undo: at > 0 || refused, redo: at < steps.length - 1, back: changed || refused };
      Object.assign(can, { link: !refused, scene: changed && !refused });
      Object.entries(can).forEach(([name, is]) => (this.querySelector(`[name=${name}]`).disabled = !is));
    }

    show() {
      if (!this.firstChild) this.draw();
      this.enable();
      const differs = new Set(this.given.map(({ name }) => name));
      document.querySelectorAll("td[data-input]").forEach((cell) => cell.classList.toggle("ms-changed", differs.has(cell.dataset.input)));
      const list = this.querySelector(".ms-scenes");
      list.innerHTML = this.list();
      list.hidden = !list.firstChild;
      const as = this.refused ? "not computed with what the fields say" : differs.size ? "" : "as in the document";
      this.querySelector("[role=status]").textContent = [as, ...(this.strange?.values() ?? [])].filter(Boolean).join("; ");
      const changed = (this.refused ? [] : this.given).map(
        ({ head, text, own, unit }) => `<span>${head} = <b>${inLine(text)}</b> ${plain(unit)} <i>(${inLine(own)} in the document)</i></span>`,
      );
      this.lastElementChild.innerHTML = changed.join("");
    }

    // The scenes beside the worksheet; shown is the one that the inputs are as they stand.
    list() {
      const now = textsNow();
      const options = this.offered.map(({ name, texts, why }, n) => {
        const is = texts && !this.refused && same({ ...ownTexts(), ...texts }, now) ? " selected" : why ? " disabled" : "";
        return `<option value="${n}"${is}>${plain(name)}${why ? `: ${plain(why)}` : ""}</option>`;
      });
      const none = `<option${options.some((each) => each.includes(" selected>")) ? "" : " selected"} disabled>a scene</option>`;
      return options.length ? `<select aria-label="scenes" title="inputs of a file beside the worksheet">${none}${options.join("")}</select>` : "";
    }

    act(name) {
      const acts = {
        // What is typed and not computed with yet, or refused, goes first.
        undo: () => this.to(others(steps[at]).length ? steps[at] : steps[(at = Math.max(0, at - 1))]),
        redo: () => this.to(steps[(at = Math.min(steps.length - 1, at + 1))]),
        back: () => {
          this.strange = undefined;
          this.to(ownTexts());
        },
        link: () => this.copy(),
        scene: () => saveScene(this.getAttribute("of"), this.given),
      };
      acts[name]?.();
    }

    // Only the fields that differ are typed into.
    to(texts) {
      others(texts).forEach((name) => unheard.add(name));
      asked = texts;
      typeAll(texts);
      this.enable();
    }

    copy() {
      this.address();
      navigator.clipboard?.writeText(location.href);
      this.querySelector("[role=status]").textContent = "the address above carries these inputs";
    }
  }

  // An address typed or pasted into the page that is open; a link to a place in it carries no inputs.
  window.addEventListener("hashchange", () => document.querySelector("ms-states")?.open());

  const plain = (text) => String(text).replace(/[&<>"]/g, (sign) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" })[sign]);
  const inLine = (text) => plain(text).replaceAll("\n", " | "); // rows as in a scene: a page draws no end of line
  customElements.define("ms-states", States);
  customElements.define("ms-used", Used); // which tells the others at once
})();
