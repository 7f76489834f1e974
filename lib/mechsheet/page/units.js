// Units under the hand: a click on one offers those that measure the same; what it stands behind is shown in the chosen one.
// Numbers are written by format.js of the page in one file, which stands before it.
(() => {
  if (customElements.get("ms-unit")) return;

  const chosen = new Map(); // by what is shown, while the page is open
  const hosts = new Set();

  customElements.define(
    "ms-unit",
    class extends HTMLElement {
      constructor() {
        super();
        this.addEventListener("keydown", (event) => {
          if (event.key !== "Enter" && event.key !== " ") return;
          event.preventDefault();
          event.stopPropagation(); // the editor would go to the code of the cell
          offer(this);
        });
      }

      connectedCallback() {
        this.tabIndex = 0;
        this.role = "button";
        this.ariaHasPopup = "menu";
      }
    },
  );

  // What the page shows in the declared units stays as it is, and is hidden behind its copy in the chosen ones.
  class Host extends HTMLElement {
    connectedCallback() {
      hosts.add(this);
      this.show();
    }

    disconnectedCallback() {
      hosts.delete(this);
    }

    attributeChangedCallback(_name, before) {
      if (before !== null) queueMicrotask(() => this.show()); // once its content has changed too
    }

    show() {
      this.querySelector(":scope > .ms-chosen")?.remove();
      const copy = this.copied();
      this.toggleAttribute("switched", Boolean(copy));
      if (!copy) return;
      copy.classList.add("ms-chosen");
      this.append(copy);
    }

    told(name) {
      return JSON.parse(this.getAttribute(name));
    }
  }

  // A value: its texts in the other units, or its numbers in SI and what the units are.
  class Value extends Host {
    static observedAttributes = ["texts", "si", "units", "of"];

    offered() {
      const unit = this.getAttribute("unit");
      return { of: this.getAttribute("of"), unit, units: [unit, ...Object.keys(this.told(this.kind))] };
    }

    get kind() {
      return this.hasAttribute("texts") ? "texts" : "units";
    }

    copied() {
      const other = chosen.get(this.getAttribute("of"));
      const known = other && this.told(this.kind)[other];
      if (!known) return null;
      const innerHTML = typeof known === "string" ? known : this.written(...known);
      return Object.assign(document.createElement("span"), { innerHTML });
    }

    written(factor, behind) {
      const shape = this.told("shape");
      return valueText(this.told("si").map((part) => Object.assign(part.map(Number), { shape })), factor, behind);
    }
  }
  customElements.define("ms-value", Value);

  const isSwitched = (column) => column && chosen.get(column.of) in column.units && chosen.get(column.of) !== column.unit;

  class Columns extends Host {
    static observedAttributes = ["columns"];

    offered(unit) {
      const column = this.told("columns")[unit.closest("th").cellIndex];
      return { ...column, units: Object.keys(column.units) };
    }

    copied() {
      const columns = this.told("columns");
      if (!columns.some(isSwitched)) return null;
      const copy = this.firstElementChild.cloneNode(true);
      for (const cell of copy.querySelectorAll("td")) ["band", "own"].forEach((mark) => delete cell.dataset[mark]); // set anew
      columns.forEach((column, i) => {
        if (!isSwitched(column)) return;
        const unit = chosen.get(column.of);
        copy.querySelectorAll("ms-unit").forEach((each) => {
          if (each.closest("th").cellIndex === i) each.textContent = unit;
        });
        const texts = inUnit(column, unit);
        [...copy.tBodies[0].rows].forEach((row, k) => {
          row.cells[i].textContent = texts[k];
        });
      });
      return copy;
    }

    // The cell of the copy that stands for one of the table, if there is a copy.
    copyOf(cell) {
      const copy = this.querySelector(":scope > .ms-chosen");
      return copy?.tBodies[0].rows[cell.parentElement.sectionRowIndex]?.cells[cell.cellIndex];
    }

    // Numbers of a column as the copy writes them; nothing where it shows the declared unit.
    written(i, values) {
      const column = this.told("columns")[i];
      return isSwitched(column) ? inUnit({ ...column, values }, chosen.get(column.of)) : null;
    }
  }
  customElements.define("ms-columns", Columns);

  // A chart: its curves stay, the ticks of an axis and the values under the pointer are those in the chosen unit.
  class Axes extends Host {
    static observedAttributes = ["axes", "columns"];

    copied() {
      const unitOf = (axis) => {
        const of = axis?.of.find((name) => chosen.get(name) in axis.ticks);
        return of && axis.ticks[chosen.get(of)];
      };
      const axes = this.told("axes").map(unitOf);
      const columns = this.told("columns").map((column) => {
        const unit = column && chosen.get(column.of);
        return column && unit in column.units && unit !== column.unit ? { column, unit } : null;
      });
      if (!axes.some(Boolean) && !columns.some(Boolean)) return null;
      const copy = this.firstElementChild.cloneNode(true);
      const values = JSON.parse(copy.dataset.values);
      axes.forEach((ticks, up) => {
        if (!ticks) return;
        Axes.along(copy, up, ticks);
        values.axes[up] = ticks.axis;
      });
      columns.forEach((each, i) => {
        if (!each) return;
        values.units[i] = each.unit;
        values.texts[i] = inUnit(each.column, each.unit);
      });
      copy.dataset.values = JSON.stringify(values);
      return copy;
    }

    // Other ticks of one axis: lines of the grid, numbers beside them, and the unit behind what the axis shows.
    static along(chart, up, { at, texts, unit }) {
      const plot = chart.querySelector("svg");
      const grid = plot.firstElementChild;
      const [width, height] = ["width", "height"].map((name) => Number(plot.getAttribute(name)));
      const lines = grid.getAttribute("d").match(/M[^M]+/g);
      const isOther = (line) => line.includes("H") !== Boolean(up);
      const own = at.map((u) => (up ? `M0 ${u}H${width}` : `M${u} 0V${height}`));
      grid.setAttribute("d", [...lines.filter(isOther), ...own].join(""));
      const titles = chart.querySelectorAll(":scope > g > text[text-anchor=middle]");
      const title = up ? chart.querySelector(":scope > g > g > text") : titles[titles.length - 1];
      const numbers = [...chart.querySelectorAll(`:scope > g > text[text-anchor=${up ? "end" : "middle"}]`)];
      const [first, ...rest] = numbers.filter((text) => text !== title);
      const part = plot.viewBox.baseVal;
      const beside = (u) => (up ? ((u - part.y) * height) / part.height + 4 : ((u - part.x) * width) / part.width);
      at.forEach((u, i) => {
        const text = first.cloneNode();
        const name = up ? "y" : "x";
        text.setAttribute(name, Number(plot.getAttribute(name)) + beside(u));
        text.textContent = texts[i];
        first.before(text);
      });
      [first, ...rest].forEach((text) => text.remove());
      if (unit !== undefined) title.lastChild.textContent = unit;
    }
  }
  customElements.define("ms-axes", Axes);

  // A column in another unit, not finer than it is in its own; of its greatest number five digits are enough.
  function inUnit({ units, unit, decimals, power, values }, other) {
    const shown = values.map((x) => (typeof x === "string" ? x : (x * units[unit]) / units[other]));
    const greatest = Math.max(...shown.filter(Number.isFinite).map(Math.abs), 0);
    const before = Number(greatest.toExponential().split("e")[1]) + 1;
    const same = decimals + Math.round(Math.log10(units[other] / units[unit]));
    const places = Math.max(0, Math.min(same, 5 - before));
    return shown.map((y) => (typeof y === "string" ? y : cellText(y, { power, decimals: power ? decimals : places })));
  }

  const menu = document.createElement("div");
  menu.className = "ms-menu";
  menu.role = "menu";
  menu.popover = "auto";

  function offer(unit) {
    const host = unit.closest("ms-value, ms-columns");
    const { of, unit: own, units } = host.offered(unit);
    const now = chosen.get(of) ?? own;
    menu.replaceChildren(
      ...units.map((label) => {
        const item = document.createElement("button");
        Object.assign(item, { textContent: label, role: "menuitemradio", ariaChecked: label === now });
        item.onclick = () => choose(host, of, label);
        return item;
      }),
    );
    document.body.append(menu);
    menu.showPopover();
    const { left, bottom, top } = unit.getBoundingClientRect();
    menu.style.left = `${Math.min(left, innerWidth - menu.offsetWidth - 8)}px`;
    menu.style.top = `${bottom + menu.offsetHeight > innerHeight ? top - menu.offsetHeight : bottom}px`;
    (menu.querySelector("[aria-checked=true]") ?? menu.firstElementChild).focus();
  }

  function choose(host, of, label) {
    chosen.set(of, label);
    hosts.forEach((each) => each.show());
    menu.hidePopover();
    const units = [...host.lastElementChild.querySelectorAll("ms-unit")];
    units.find((unit) => host.offered(unit).of === of)?.focus();
  }

  document.addEventListener("click", ({ target }) => {
    if (target.matches?.("ms-value ms-unit, ms-columns ms-unit")) offer(target);
  });

  menu.addEventListener("keydown", (event) => {
    const step = { ArrowDown: "nextElementSibling", ArrowUp: "previousElementSibling" }[event.key];
    if (!step) return;
    event.preventDefault();
    event.target[step]?.focus();
  });
})();
