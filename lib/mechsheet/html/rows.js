// Rows of a narrow table stand side by side: as many times as there is room for the table as wide as it is just now.
if (!customElements.get("ms-rows"))
  customElements.define(
    "ms-rows",
    class extends HTMLElement {
      connectedCallback() {
        const tables = () => [...this.querySelectorAll("table")]; // in another unit another one is shown
        const sized = new ResizeObserver(() => {
          const width = Math.max(...tables().map((table) => table.rows[0].offsetWidth)); // of a part: a table has that of all
          if (width) this.style.setProperty("--each", `${width}px`);
        });
        const observe = () => tables().forEach((table) => sized.observe(table));
        const changed = new MutationObserver(observe);
        changed.observe(this, { childList: true, subtree: true });
        observe();
        this.end = () => [sized, changed].forEach((each) => each.disconnect());
      }

      disconnectedCallback() {
        this.end();
      }
    },
  );
