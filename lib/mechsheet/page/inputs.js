// Inputs of the page as a whole: what is changed, a step back and on, the document's own, a link and a scene with them.
(() => {
  if (customElements.get("ms-used")) return;

  let fields = []; // as they were last computed with
  const steps = []; // sets of texts that the page has computed, by the names of the inputs
  let at = -1;
  let asked; // the set that was last typed into the fields
  let wanted = false; // whether the page has yet to compute it, and the user has typed nothing since
  let linked = false; // whether an address wants it, perhaps in other words than the page: 0,055 m is told as 55
  const heard = new Set(); // fields that have told their values since they were typed into

  // The element beside the fields tells of all that have changed; of each alone marimo would keep the last, and lose
  // what was typed before it while the page computed.
  const alone = ({ objectId }) => document.querySelector(`td[data-input] marimo-ui-element[object-id="${CSS.escape(objectId)}"]`);
  const hear = (event) => {
    const field = alone(event.detail);
    if (!field) return;
    heard.add(field.closest("td").dataset.input);
    event.stopImmediatePropagation();
  };
  window.addEventListener("marimo-value-ready", hear, true);

  // What the user types is a step of its own; what is typed here does not leave the field's shadow.
  const byHand = ({ target, isTrusted }) => {
    const cell = isTrusted && target.closest?.("td[data-input]");
    if (!cell) return;
    heard.add(cell.dataset.input);
    wanted = false;
  };
  ["input", "change", "click"].forEach((kind) => document.addEventListener(kind, byHand, true));

  const setter = (kind) => Object.getOwnPropertyDescriptor(kind.prototype, "value").set;
  const same = (a, b) => Object.keys(a).every((name) => a[name] === b[name]);

  const eachBar = (act) => document.querySelectorAll("ms-states").forEach(act);
  const hostOf = (name) => document.querySelector(`td[data-input="${name}"] marimo-ui-element > *`);
  const fieldOf = (name) => hostOf(name)?.shadowRoot?.querySelector("input, textarea, select, button");

  // Typed into until it is heard: a field that is there may not listen yet.
  function typeAll(names, texts, tries = 300) {
    if (asked !== texts) return; // another set has been asked for since
    const late = names.filter((name) => !heard.has(name));
    if (!tries || !late.length) return;
    late.filter(fieldOf).forEach((name) => type(name, texts[name]));
    setTimeout(() => typeAll(late, texts, tries - 1), 100);
  }

  // A field takes its text as from the hand.
  function type(name, text) {
    const [host, field] = [hostOf(name), fieldOf(name)];
    if (field.matches("select")) {
      const option = [...field.options].find((each) => each.text === text || each.value === text);
      setter(HTMLSelectElement).call(field, option?.value ?? text);
      field.dispatchEvent(new Event("change", { bubbles: true }));
    } else if (field.matches("button, [type=checkbox]")) {
      const checked = field.ariaChecked === "true" || field.getAttribute("aria-checked") === "true" || field.checked === true;
      if (checked !== (text === "yes")) field.click();
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

  const shown = (name) => {
    const field = hostOf(name)?.shadowRoot?.querySelector("input");
    return field && field.type !== "checkbox" ? field.value : undefined;
  };

  const ownTexts = () => Object.fromEntries(fields.map((field) => [field.name, field.own]));

  // The inputs that the page computes with, told anew with each run; nothing while one of them is refused.
  class Used extends HTMLElement {
    static observedAttributes = ["told"];

    connectedCallback() {
      this.tell();
    }

    disconnectedCallback() {
      queueMicrotask(() => eachBar((bar) => bar.show()));
    }

    attributeChangedCallback() {
      if (this.isConnected) this.tell();
    }

    tell() {
      fields = JSON.parse(this.getAttribute("told"));
      eachBar((bar) => bar.follow());
    }
  }

  const whenIdle = (act) => (window.requestIdleCallback ?? setTimeout)(act);

  class States extends HTMLElement {
    constructor() {
      super();
      this.addEventListener("click", ({ target }) => this.act(target.closest("button")?.name));
      this.addEventListener("change", ({ target }) => this.to({ ...ownTexts(), ...this.scenes[target.value].texts }));
    }

    connectedCallback() {
      if (fields.length) this.follow();
    }

    get scenes() {
      return JSON.parse(this.getAttribute("scenes"));
    }

    get refused() {
      return !document.querySelector("ms-used");
    }

    follow() {
      const now = Object.fromEntries(fields.map(({ name, text }) => [name, text]));
      const first = at < 0;
      if (!first && same(steps[at], now)) wanted = false;
      else if (!wanted) steps.splice(++at, steps.length, now);
      else if (linked && !same(steps[at - 1], now)) steps[at] = now;
      this.show();
      const given = textsIn(location.hash);
      if (first && given.size) this.open(given);
      else if (same(steps[at], now)) whenIdle(() => this.address()); // which takes longer than all else here
    }

    // What a link carries holds from the beginning.
    open(given) {
      const known = Object.keys(steps[at]).filter((name) => given.has(name));
      this.to({ ...steps[at], ...Object.fromEntries(known.map((name) => [name, given.get(name)])) });
      linked = true;
    }

    // Whether the fields show the last set that was computed, which is on its way again.
    get isBack() {
      return Object.entries(steps[at]).every(([name, text]) => (shown(name) ?? text) === text);
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

    show() {
      const differs = new Set(this.given.map(({ name }) => name));
      document.querySelectorAll("td[data-input]").forEach((cell) => cell.classList.toggle("ms-changed", differs.has(cell.dataset.input)));
      const changed = this.given.map(
        ({ head, text, own, unit }) => `<span>${head} = <b>${plain(text)}</b> ${plain(unit)} <i>(${plain(own)} in the document)</i></span>`,
      );
      const button = (name, label, title, is) => `<button name="${name}" title="${title}"${is ? "" : " disabled"}>${label}</button>`;
      this.innerHTML =
        `<div class="ms-row">${button("undo", "↶ undo", "the inputs before the last change", at > 0 || this.refused)}` +
        button("redo", "↷ redo", "the inputs after it", at < steps.length - 1) +
        button("back", "back to the document", "all inputs as the document has them", changed.length || this.refused) +
        button("link", "copy a link", "an address with these inputs", true) +
        button("scene", "save as a scene", "a file of these inputs, for --scene and compare", changed.length) +
        this.list() +
        `<span role="status">${this.refused ? "not computed with what the fields say" : changed.length ? "" : "as in the document"}</span></div>` +
        `<div class="ms-row">${changed.join("")}</div>`;
    }

    // The scenes beside the worksheet; shown is the one that the inputs are as they stand.
    list() {
      const now = Object.fromEntries(fields.map(({ name, text }) => [name, text]));
      const options = this.scenes.map(({ name, texts, why }, n) => {
        const is = texts && !this.refused && same({ ...ownTexts(), ...texts }, now) ? " selected" : why ? " disabled" : "";
        return `<option value="${n}"${is}>${plain(name)}${why ? `: ${plain(why)}` : ""}</option>`;
      });
      const none = `<option${options.some((each) => each.includes(" selected>")) ? "" : " selected"} disabled>a scene</option>`;
      return options.length ? `<select aria-label="scenes" title="inputs of a file beside the worksheet">${none}${options.join("")}</select>` : "";
    }

    act(name) {
      const acts = {
        undo: () => this.to(this.refused && !this.isBack ? steps[at] : steps[(at = Math.max(0, at - 1))]),
        redo: () => this.to(steps[(at = Math.min(steps.length - 1, at + 1))]),
        back: () => this.to(ownTexts()),
        link: () => this.copy(),
        scene: () => saveScene(this.getAttribute("of"), this.given),
      };
      acts[name]?.();
    }

    // Only the fields that differ are typed into; until all have arrived the states in between are no steps of their own.
    to(texts) {
      const now = Object.fromEntries(fields.map(({ name, text }) => [name, shown(name) ?? text]));
      const others = Object.keys(texts).filter((name) => texts[name] !== now[name]);
      if (!same(steps[at], texts)) steps.splice(++at, steps.length, texts);
      [asked, wanted, linked] = [texts, others.length > 0, false];
      heard.clear();
      typeAll(others, texts);
    }

    copy() {
      this.address();
      navigator.clipboard?.writeText(location.href);
      this.querySelector("[role=status]").textContent = "the address above carries these inputs";
    }
  }

  const plain = (text) => String(text).replace(/[&<>"]/g, (sign) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" })[sign]);
  customElements.define("ms-states", States);
  customElements.define("ms-used", Used); // which tells the others at once
})();
