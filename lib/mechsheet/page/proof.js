// Digits that are not proved are grey, as long as the page shows what was proved.
(() => {
  if (customElements.get("ms-proof")) return;

  const grey = new Highlight();
  CSS.highlights.set("ms-unproved", grey);
  const SHOWN = ".ms-table:not(.ms-matters *), ms-verdict"; // what other numbers would change

  class Proof extends HTMLElement {
    static observedAttributes = ["made"];

    connectedCallback() {
      this.classList.remove("ms-ended");
      this.shown = [...document.querySelectorAll(SHOWN)].map((each) => each.textContent).join();
      this.changed = new MutationObserver(() => this.compare());
      this.changed.observe(document.body, { childList: true, characterData: true, subtree: true });
      this.given = (event) => event.composedPath().some((e) => e.dataset?.input) && this.end();
      document.addEventListener("change", this.given);
      for (const [table, block, row, column, off] of JSON.parse(this.getAttribute("unproved"))) {
        const host = document.getElementById(`table-${table}`)?.closest(".ms-table");
        const text = host?.querySelectorAll("table:not(.ms-chosen)")[block]?.tBodies[0].rows[row]?.cells[column]?.firstChild;
        if (!text) continue;
        const ends = { startContainer: text, endContainer: text, endOffset: text.length };
        grey.add(new StaticRange({ ...ends, startOffset: lost(text.data, off) }));
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

    compare() {
      if ([...document.querySelectorAll(SHOWN)].map((each) => each.textContent).join() !== this.shown) this.end();
    }

    // The page shows other numbers now, which are proved as soon as it rests.
    end() {
      this.disconnectedCallback();
      this.classList.add("ms-ended");
    }
  }
  customElements.define("ms-proof", Proof);

  // Where the digits of a number begin that an error may change by half or more; all of them where nothing is known.
  function lost(text, off) {
    const [mantissa, power] = text.split("e");
    if (off === null) return 0;
    const point = mantissa.indexOf(".");
    let place = 10 ** (Number((power ?? "0").replace("−", "-")) - (point < 0 ? 0 : mantissa.length - point - 1));
    let at = mantissa.length;
    for (let k = mantissa.length - 1; k >= 0 && place / 2 < off; k--) {
      if (!/\d/.test(mantissa[k])) continue;
      at = k;
      place *= 10;
    }
    return at;
  }
})();
