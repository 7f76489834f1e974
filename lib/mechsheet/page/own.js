// Numbers that differ from those of the document's own inputs: marked, with the document's own behind them.
(() => {
  if (customElements.get("ms-own")) return;

  const marked = new Set();
  const RAISED = { "−": "⁻", "+": "⁺", ...Object.fromEntries([..."⁰¹²³⁴⁵⁶⁷⁸⁹"].map((sign, digit) => [digit, sign])) };

  function read(html) {
    const template = document.createElement("template");
    template.innerHTML = html;
    return template.content;
  }

  // A text as it is shown in the declared unit, without what only tells where.
  function textOf(shown) {
    const copy = shown.cloneNode(true);
    copy.querySelectorAll(".ms-chosen").forEach((each) => each.remove());
    return copy.textContent;
  }

  // The same where nothing can be raised.
  function plain(html) {
    const copy = read(html);
    copy.querySelectorAll(".ms-where").forEach((each) => each.remove());
    copy.querySelectorAll("sup").forEach((sup) => (sup.textContent = [...sup.textContent].map((c) => RAISED[c] ?? c).join("")));
    return copy.textContent.trim();
  }

  function mark(target, own, text) {
    if (!target || textOf(target) === own) return;
    target.dataset.own = text;
    marked.add(target);
  }

  // Cells of a column, and those that are shown for them where their table is copied into other units.
  function markColumn(cells, texts, values) {
    const host = cells[0]?.closest("ms-columns");
    const written = host && values && host.written(cells[0].cellIndex, values);
    cells.forEach((cell, k) => {
      mark(cell, texts[k], texts[k]);
      const copy = cell.dataset.own === undefined ? null : host?.copyOf(cell);
      if (copy) mark(copy, null, (written ?? texts)[k]);
    });
  }

  function clear() {
    marked.forEach((target) => delete target.dataset.own);
    marked.clear();
  }

  class Own extends HTMLElement {
    static observedAttributes = ["told"];

    connectedCallback() {
      this.attributeChangedCallback();
      this.changes = new MutationObserver(() => {
        cancelAnimationFrame(this.next);
        this.next = requestAnimationFrame(() => this.show());
      });
      this.changes.observe(document.body, { childList: true, characterData: true, subtree: true });
    }

    disconnectedCallback() {
      this.changes.disconnect();
      cancelAnimationFrame(this.next);
      clear();
    }

    attributeChangedCallback() {
      if (!this.isConnected) return;
      const { lines, checks, tables } = JSON.parse(this.getAttribute("told"));
      this.own = {
        lines: Object.entries(lines).map(([name, html]) => [name, read(html).textContent, plain(html)]),
        checks: Object.entries(checks).map(([id, [html, verdict]]) => [id, read(html).textContent, plain(verdict)]),
        tables: Object.entries(tables),
      };
      this.show();
    }

    show() {
      clear();
      const { lines, checks, tables } = this.own;
      const at = (id) => document.getElementById(id);
      for (const [name, own, text] of lines) mark(at(`line-${name}`)?.querySelector(".ms-value"), own, text);
      for (const [id, own, text] of checks) mark(at(id), own, text);
      for (const [number, [count, blocks]] of tables) {
        const caption = at(`table-${number}`);
        const shown = caption?.parentElement.querySelectorAll("table:not(.ms-chosen)") ?? [];
        blocks.forEach((columns, n) => {
          const rows = shown[n]?.tBodies[0].rows ?? [];
          const now = Number(/of (\d+) are/.exec(shown[n]?.tFoot?.textContent)?.[1] ?? rows.length);
          const cells = (texts, i) => texts.map((_, k) => rows[k].cells[i]);
          if (now === count) columns.forEach(([texts, values], i) => markColumn(cells(texts, i), texts, values));
          else if (shown[n] && !n) mark(caption, "", `${count} rows`); // which of them would be compared is not known
        });
      }
    }
  }
  customElements.define("ms-own", Own);
})();
