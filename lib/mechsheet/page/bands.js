// Bands within tolerances, behind the numbers that they belong to: attributes, which the page's own changes leave alone.
(() => {
  if (customElements.get("ms-bands")) return;

  const marked = new Set();
  let current = null; // whose bands are shown

  // A bar at each point of a curve, with a stroke at both of its ends.
  function draw(plot, [colour, points]) {
    const bar = document.createElementNS("http://www.w3.org/2000/svg", "path");
    bar.setAttribute("class", "ms-bars");
    bar.setAttribute("stroke", colour);
    bar.setAttribute("d", points.map(([x, y, half]) => `M${x} ${y}m-3 ${-half}h6m-3 0v${2 * half}m-3 0h6`).join(""));
    plot.append(bar);
  }

  function mark(target, text) {
    if (!target || !text) return;
    for (const each of [target, inDeclaredUnit(target)].filter(Boolean)) {
      each.dataset.band = text;
      marked.add(each);
    }
  }

  // The cell that is shown for one whose table is copied into other units, where its own column keeps the declared one.
  function inDeclaredUnit(cell) {
    const host = cell.closest("ms-columns");
    return host && !host.written(cell.cellIndex, []) ? host.copyOf(cell) : null;
  }

  function clear() {
    current = null;
    marked.forEach((target) => delete target.dataset.band);
    marked.clear();
    document.querySelectorAll(".ms-bars").forEach((bar) => bar.remove()); // those copied into another unit too
  }

  // A number that changes has lost its band, and so have all others: they wait for new ones.
  const NUMBERS = ".ms-line, .ms-table, [id^=check-]";
  const isCopy = (node) => node.classList?.contains("ms-chosen");
  const isExchanged = ({ addedNodes, removedNodes }) => [...addedNodes, ...removedNodes].some(isCopy);
  const isNumber = (record) => {
    const { target, addedNodes, removedNodes } = record;
    if (isExchanged(record) && [...addedNodes, ...removedNodes].every(isCopy)) return false; // the same in another unit
    const shown = (target.closest ? target : target.parentElement)?.closest(NUMBERS);
    if (shown?.isConnected) return !shown.closest(".ms-matters");
    return [...removedNodes].some((e) => e.querySelector && !e.closest(".ms-matters") && (e.matches(NUMBERS) || e.querySelector("[data-band]")));
  };
  const changes = new MutationObserver((records) => {
    if (records.some(isNumber)) clear();
    else if (records.some(isExchanged)) current?.show();
  });

  class Bands extends HTMLElement {
    static observedAttributes = ["made"];

    connectedCallback() {
      this.show();
    }

    disconnectedCallback() {
      changes.disconnect();
      clear();
    }

    attributeChangedCallback() {
      if (this.isConnected) this.show();
    }

    show() {
      clear();
      current = this;
      const { lines, tables, checks, figures } = JSON.parse(this.getAttribute("told"));
      const at = (id) => document.getElementById(id);
      for (const [name, text] of Object.entries(lines)) mark(at(`line-${name}`)?.querySelector(".ms-value"), text);
      for (const [id, text] of Object.entries(checks)) mark(at(id), text);
      for (const [number, blocks] of Object.entries(tables)) {
        const shown = at(`table-${number}`)?.parentElement.querySelectorAll("table:not(.ms-chosen)") ?? [];
        blocks.forEach((columns, n) =>
          columns.forEach((texts, i) =>
            texts?.forEach((text, k) => mark(shown[n]?.tBodies[0].rows[k]?.cells[i], text)),
          ),
        );
      }
      for (const [number, curves] of Object.entries(figures)) {
        const plots = at(`figure-${number}`)?.parentElement.querySelectorAll("svg.ms-chart > svg") ?? [];
        plots.forEach((plot) => curves.forEach((curve) => draw(plot, curve)));
      }
      changes.observe(document.body, { childList: true, characterData: true, subtree: true });
    }
  }
  customElements.define("ms-bands", Bands);
})();
