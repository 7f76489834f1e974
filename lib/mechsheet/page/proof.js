// Digits that are not proved are grey, as long as the page shows what was proved.
(() => {
  if (customElements.get("ms-proof")) return;

  const grey = new Highlight();
  CSS.highlights.set("ms-unproved", grey);
  // What other numbers would change, in the declared units.
  const SHOWN =
    ".ms-table:not(.ms-matters *) table:not(.ms-chosen), ms-verdict, .ms-value:not(:has(> ms-value)), .ms-value > ms-value > :first-child";
  const NUMBER = /(\d+(?:\.\d+)?)(?:e([+−]?\d+)|(\u202f·\u202f10)$)?/g; // a power of ten, or one that is raised
  const text = () => [...document.querySelectorAll(SHOWN)].map((each) => each.textContent).join();
  const isCopy = (node) => node.classList?.contains("ms-chosen");

  class Proof extends HTMLElement {
    static observedAttributes = ["made"];

    connectedCallback() {
      this.classList.remove("ms-ended");
      this.shown = text();
      this.changed = new MutationObserver((records) => this.compare(records));
      this.changed.observe(document.body, { childList: true, characterData: true, subtree: true });
      this.given = (event) => event.composedPath().some((e) => e.dataset?.input) && this.end();
      document.addEventListener("change", this.given);
      this.mark();
    }

    mark() {
      grey.clear();
      for (const [table, block, row, column, off] of JSON.parse(this.getAttribute("unproved"))) {
        const own = document.getElementById(`table-${table}`)?.closest(".ms-table");
        const shown = own?.querySelectorAll("table:not(.ms-chosen)")[block];
        const copy = shown?.parentElement.querySelector(":scope > .ms-chosen");
        both(shown, copy, off, (each) => each.tBodies[0].rows[row]?.cells[column]);
      }
      for (const [name, off] of Object.entries(JSON.parse(this.getAttribute("lines")))) {
        const value = document.getElementById(`line-${name}`)?.querySelector(".ms-value");
        const host = value?.querySelector(":scope > ms-value");
        both(host?.firstElementChild ?? value, host?.querySelector(":scope > .ms-chosen"), off, (each) => each);
      }
    }

    attributeChangedCallback(_name, before) {
      if (before === null) return;
      this.disconnectedCallback();
      queueMicrotask(() => this.isConnected && this.connectedCallback()); // once its other attributes have changed too
    }

    disconnectedCallback() {
      this.changed.disconnect();
      document.removeEventListener("change", this.given);
      grey.clear();
    }

    compare(records) {
      if (text() !== this.shown) this.end();
      else if (records.some((record) => [...record.addedNodes, ...record.removedNodes].some(isCopy))) this.mark();
    }

    // The page shows other numbers now, which are proved as soon as it rests.
    end() {
      this.disconnectedCallback();
      this.classList.add("ms-ended");
    }
  }
  customElements.define("ms-proof", Proof);

  // The digits of what stands somewhere, and of its copy in another unit.
  function both(shown, copy, off, part) {
    const own = shown && part(shown) ? numbers(part(shown)) : [];
    own.forEach((each) => range(each, off));
    const others = copy && part(copy) ? numbers(part(copy)) : [];
    others.forEach((each, i) => range(each, off === null || !own[i]?.value ? off : (off * each.value) / own[i].value));
  }

  // The numbers that an element shows: each with its text, where its digits are there, and its power of ten.
  function numbers(element) {
    const found = [];
    const texts = document.createTreeWalker(element, NodeFilter.SHOW_TEXT);
    while (texts.nextNode()) {
      const node = texts.currentNode;
      if (node.parentElement.closest("sup, ms-unit, .ms-where")) continue;
      for (const { 0: all, 1: mantissa, 2: e, 3: raised, index } of node.data.matchAll(NUMBER)) {
        const power = Number((e ?? (raised ? node.nextSibling.textContent : "0")).replace("−", "-"));
        found.push({ node, index, mantissa, power, end: index + all.length, value: mantissa * 10 ** power });
      }
    }
    return found;
  }

  function range({ node, index, mantissa, power, end }, off) {
    const start = off === null ? 0 : lost(mantissa, power, off);
    if (start === mantissa.length) return;
    const ends = { startContainer: node, endContainer: node };
    grey.add(new StaticRange({ ...ends, startOffset: index + start, endOffset: start ? index + mantissa.length : end }));
  }

  // Where the digits of a number begin that an error may change by half or more.
  function lost(mantissa, power, off) {
    const point = mantissa.indexOf(".");
    let place = 10 ** (power - (point < 0 ? 0 : mantissa.length - point - 1));
    let at = mantissa.length;
    for (let k = mantissa.length - 1; k >= 0 && place / 2 < off; k--) {
      if (!/\d/.test(mantissa[k])) continue;
      at = k;
      place *= 10;
    }
    return at;
  }
})();
