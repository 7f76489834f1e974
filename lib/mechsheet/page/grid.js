// A list or a table among the inputs as a grid of cells: the face of the text area beside it, which holds its rows.
(() => {
  if (customElements.get("ms-grid")) return;

  const KEYS = "Enter, ↑, ↓: along the column; Ctrl+Enter: a row in between; Ctrl+Delete: away with the row";

  function rowsOf(text) {
    const rows = text.split(/\r?\n|\|/).filter((row) => row.trim());
    return rows.map((row) => row.split(/[;\t]/).map((cell) => cell.trim()));
  }

  const inputsOf = (row) => [...row.querySelectorAll("input")];
  const valuesOf = (row) => inputsOf(row).map((input) => input.value.trim());
  const isFilled = (row) => valuesOf(row).some(Boolean);

  class Grid extends HTMLElement {
    static observedAttributes = ["made"]; // another form, whose text areas begin anew

    constructor() {
      super();
      this.addEventListener("input", () => this.number());
      this.addEventListener("change", ({ target }) => this.changed(target));
      this.addEventListener("paste", (event) => this.pasted(event));
      this.addEventListener("keydown", (event) => this.pressed(event));
      this.addEventListener("click", ({ target }) => target.matches("button") && this.away(target.closest("tr")));
    }

    connectedCallback() {
      if (this.area) this.show(this.area.value);
      else if (this.isConnected) setTimeout(() => this.connectedCallback(), 50); // it comes a moment later
    }

    attributeChangedCallback(_name, before) {
      if (before !== null) this.show(this.getAttribute("text"));
    }

    get area() {
      return this.parentElement?.querySelector("marimo-text-area")?.shadowRoot?.querySelector("textarea");
    }

    show(text) {
      this.heads = JSON.parse(this.getAttribute("columns"));
      const heads = this.heads.map((column) => `<th class="ms-${column.kind}">${column.head}</th>`).join("");
      this.innerHTML = `<table title="${KEYS}"><thead><tr><th></th>${heads}</tr></thead><tbody></tbody></table>`;
      this.body = this.querySelector("tbody");
      this.body.append(...this.fitting(rowsOf(text)).map((cells) => this.row(cells)));
      this.number();
    }

    // Of a list each number is a row, however it is written.
    fitting(rows) {
      return this.heads.length > 1 ? rows : rows.flat().map((cell) => [cell]);
    }

    row(cells = []) {
      const row = document.createElement("tr");
      row.innerHTML =
        "<th></th>" +
        this.heads.map(({ kind }) => `<td><input class="ms-${kind}" spellcheck="false"></td>`).join("") +
        '<td><button tabindex="-1" aria-label="away with the row">×</button></td>';
      inputsOf(row).forEach((input, i) => (input.value = cells[i] ?? ""));
      return row;
    }

    // Only rows with something in them have a number and are sent; an empty one at the end is there to be filled in.
    number() {
      if (!this.body.lastElementChild || isFilled(this.body.lastElementChild)) this.body.append(this.row());
      let count = 0;
      const sizes = this.heads.map(() => 0);
      for (const row of this.body.rows) {
        const number = isFilled(row) ? ++count : "";
        row.firstElementChild.textContent = number;
        inputsOf(row).forEach((input, i) => {
          input.dataset.input = number && `${this.heads[i].name} (${number})`;
          input.ariaLabel = `${this.heads[i].label}, row ${number || "to be filled in"}`;
          sizes[i] = Math.max(sizes[i], input.value.length);
        });
      }
      for (const row of this.body.rows) inputsOf(row).forEach((input, i) => this.widen(input, sizes[i]));
    }

    // A column may be narrower than it would, but cuts no number.
    widen(input, length) {
      input.size = Math.max(7, length);
      input.style.minWidth = `calc(${length}ch + 0.9em)`;
    }

    // The text area takes its text as from the hand, and passes it on when it is left.
    send() {
      this.number();
      const rows = [...this.body.rows].map(valuesOf).filter((cells) => cells.some(Boolean));
      const text = rows.map((cells) => cells.join("\t")).join("\n");
      if (text === this.area.value) return;
      Object.getOwnPropertyDescriptor(HTMLTextAreaElement.prototype, "value").set.call(this.area, text);
      this.area.dispatchEvent(new InputEvent("input", { bubbles: true }));
      this.area.dispatchEvent(new FocusEvent("focusout", { bubbles: true }));
    }

    // What is typed may be several numbers; a text is one, and is refused where it has a sign that stands between cells.
    changed(input) {
      if (input.matches(".ms-text")) this.send();
      else this.fill(input, input.value);
    }

    // Rows and columns from a cell on; what is more than the columns hold stays in the last, and is refused there.
    fill(input, text) {
      const from = input.closest("td").cellIndex - 1;
      const last = this.heads.length - from - 1;
      let row = input.closest("tr");
      this.fitting(text.trim() ? rowsOf(text) : [[""]]).forEach((cells, k) => {
        while (cells.length > last + 1 && !cells.at(-1)) cells.pop();
        const kept = cells.length > last ? [...cells.slice(0, last), cells.slice(last).join("; ")] : cells;
        if (k) row = row.nextElementSibling ?? this.body.appendChild(this.row());
        kept.forEach((cell, i) => (inputsOf(row)[from + i].value = cell));
      });
      this.send();
    }

    pasted(event) {
      const text = event.clipboardData.getData("text/plain");
      if (!/[\t\n;|]/.test(text.trim())) return; // one cell, which goes where the caret is
      event.preventDefault();
      this.fill(event.target, text);
    }

    pressed(event) {
      const at = event.target.closest("td")?.cellIndex;
      const row = event.target.closest("tr");
      const keys = {
        Enter: () => row.nextElementSibling,
        ArrowDown: () => row.nextElementSibling,
        ArrowUp: () => row.previousElementSibling,
        "Shift+Enter": () => row.previousElementSibling,
        "Ctrl+Enter": () => (row.after(this.row()), row.nextElementSibling),
        "Ctrl+Delete": () => this.away(row),
      };
      const key = (event.ctrlKey || event.metaKey ? "Ctrl+" : "") + (event.shiftKey ? "Shift+" : "") + event.key;
      if (!(key in keys)) return;
      event.preventDefault();
      event.stopPropagation(); // the editor has uses of its own for these keys
      keys[key]()?.cells[at].querySelector("input")?.select();
    }

    // The row that stands there then.
    away(row) {
      const next = row.nextElementSibling ?? row.previousElementSibling;
      row.remove();
      this.send();
      return next;
    }
  }
  customElements.define("ms-grid", Grid);
})();
