// What would it take: a form for the inputs that may change, what is required and what shall be best, as options of the
// command; the text area behind it takes them.
(() => {
  if (customElements.get("ms-design")) return;

  let count = 0;
  const escaped = (text) => new Option(text).innerHTML.replaceAll('"', "&quot;");
  const option = (name, text) => `<option value="${escaped(name)}">${escaped(text)}</option>`;

  class Design extends HTMLElement {
    static observedAttributes = ["inputs", "results"];

    connectedCallback() {
      if (this.firstChild) return;
      this.innerHTML =
        "<details><summary>what would it take</summary>" +
        '<div class="ms-vary"></div><div class="ms-need"></div>' +
        '<div class="ms-best"><select aria-label="goal"><option value="">as much reserve as can be</option>' +
        '<option value="max">the greatest</option><option value="min">the least</option></select>' +
        '<select aria-label="result that shall be best" data-of="results" hidden></select></div>' +
        "<button>find it</button></details>";
      [this.vary, this.need, this.best] = this.querySelectorAll("div");
      this.offer(this.best.lastElementChild);
      this.addEventListener("change", (event) => this.changed(event.target));
      this.querySelector("button").addEventListener("click", () => this.send());
      this.grow();
    }

    // In the editor there come to be other ones, and other units; what is chosen stays.
    attributeChangedCallback() {
      this.querySelectorAll("select[data-of]").forEach((select) => this.offer(select));
    }

    offer(select) {
      const all = this.told(select.dataset.of);
      const { value } = select;
      const isGone = value && !all.some(({ name }) => name === value);
      select.innerHTML =
        option("", select.dataset.of.slice(0, -1)) +
        all.map(({ name, meaning }) => option(name, meaning ? `${name} – ${meaning}` : name)).join("") +
        (isGone ? option(value, value) : "");
      select.value = value;
      this.unit(select);
    }

    unit(select) {
      const chosen = this.told(select.dataset.of).find(({ name }) => name === select.value);
      const unit = select.parentElement.querySelector("i");
      if (unit) unit.textContent = chosen?.unit ?? "";
      return chosen;
    }

    told(what) {
      return JSON.parse(this.getAttribute(what));
    }

    // Of each kind one row more than are filled in.
    grow() {
      const isFull = (rows) => !rows.lastElementChild || rows.lastElementChild.querySelector("select").value;
      if (isFull(this.vary)) {
        this.row(
          this.vary,
          'by <select aria-label="input that may change" data-of="inputs"></select>' +
            '<span hidden> from <input aria-label="least" size="8"> to <input aria-label="greatest" size="8"> <i></i></span>',
        );
      }
      if (isFull(this.need)) {
        this.row(
          this.need,
          'so that <select aria-label="result that is required" data-of="results"></select>' +
            '<span hidden> <select aria-label="positions"><option value="">at every position</option>' +
            '<option value="min">at its least</option><option value="max">at its greatest</option></select> ' +
            '<select aria-label="is"><option>=</option><option>&gt;=</option><option>&lt;=</option></select> ' +
            '<input aria-label="value" size="10"> <i></i></span>',
        );
      }
    }

    row(rows, html) {
      const row = document.createElement("div");
      row.innerHTML = html;
      rows.append(row);
      this.offer(row.querySelector("select"));
    }

    changed(target) {
      const row = target.closest(".ms-vary > div, .ms-need > div");
      if (target.parentElement === this.best) this.best.lastElementChild.hidden = !this.best.firstElementChild.value;
      if (!row || target !== row.querySelector("select")) return;
      const isInput = row.parentElement === this.vary;
      const chosen = this.unit(target);
      if (!chosen && row.nextElementSibling) return row.remove();
      row.querySelector("span").hidden = !chosen;
      if (isInput) row.querySelectorAll("input").forEach((end, i) => (end.value = [chosen?.low, chosen?.high][i] ?? ""));
      this.grow();
    }

    // The text area takes its text as from the hand, and passes it on when it is left.
    send() {
      const values = (row) => [...row.querySelectorAll("select, input")].map(({ value }) => value.trim());
      const filled = (rows) => [...rows.children].map(values).filter(([name]) => name);
      const [way, best] = values(this.best);
      const asked = [
        ...filled(this.vary).map(([name, low, high]) => `--vary=${name}=${low}..${high}`),
        ...filled(this.need).map(([name, end, sign, value]) => `--need=${`${end} ${name} ${sign} ${value}`.trim()}`),
        ...(way ? [`--best=${way} ${best}`] : []),
      ];
      const area = this.parentElement.querySelector("marimo-text-area").shadowRoot.querySelector("textarea");
      const text = JSON.stringify({ number: ++count, options: asked });
      Object.getOwnPropertyDescriptor(HTMLTextAreaElement.prototype, "value").set.call(area, text);
      area.dispatchEvent(new InputEvent("input", { bubbles: true }));
      area.dispatchEvent(new FocusEvent("focusout", { bubbles: true }));
    }
  }
  customElements.define("ms-design", Design);
})();
