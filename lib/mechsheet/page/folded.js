// The editor's page opens for reading: the code of every cell is folded, one click unfolds it; a cell made later is open.
(() => {
  if (customElements.get("ms-folded")) return;

  const cells = () => document.querySelectorAll(".marimo-cell");
  const fold = (cell, folded) => cell.toggleAttribute("data-ms-folded", folded);

  class Folded extends HTMLElement {
    connectedCallback() {
      const shown = document.createElement("label");
      shown.innerHTML = '<input type="checkbox"> code of all cells';
      shown.firstChild.checked = ![...cells()].some((cell) => "msFolded" in cell.dataset) && opened;
      shown.firstChild.addEventListener("change", ({ target }) => cells().forEach((c) => fold(c, !target.checked)));
      this.replaceChildren(shown);
      if (opened) return;
      opened = true;
      cells().forEach((cell) => fold(cell, true));
    }
  }
  let opened = false;
  customElements.define("ms-folded", Folded);

  // One button for all cells, at the one under the pointer.
  const button = document.createElement("button");
  button.className = "ms-unfold";
  button.textContent = "code";
  let of; // the cell

  document.addEventListener("pointerover", ({ target }) => {
    if (target === button) return;
    of = target.closest?.(".marimo-cell");
    button.hidden = !of;
    if (!of) return;
    button.title = "msFolded" in of.dataset ? "show the code of this cell" : "fold the code of this cell";
    const box = of.getBoundingClientRect();
    if (!button.isConnected) document.body.append(button);
    button.style.left = `${box.right + 4}px`;
    button.style.top = `${Math.max(box.top, 0) + 4}px`;
  });
  document.addEventListener("scroll", () => (button.hidden = true), { capture: true, passive: true });
  button.addEventListener("click", () => fold(of, !("msFolded" in of.dataset)));

  // Two clicks on a text or a heading edit it, until the keyboard leaves it.
  document.addEventListener("dblclick", ({ target }) => {
    const cell = target.closest?.(".markdown, .ms-title") && target.closest(".marimo-cell[data-ms-folded]");
    if (!cell) return;
    fold(cell, false);
    getSelection().empty();
    cell.querySelector(".cm-content")?.focus();
    cell.addEventListener("focusout", function left({ relatedTarget }) {
      if (cell.contains(relatedTarget) || cell.matches(".needs-run")) return;
      cell.removeEventListener("focusout", left);
      fold(cell, true);
    });
  });

  // What leads to a cell shows it: a mistake in the title may be that of a cell without anything to read.
  document.addEventListener("click", ({ target }) => {
    const cell = document.querySelector(target.closest?.('a[href^="#cell-"]')?.getAttribute("href") ?? ":not(*)");
    if (cell) fold(cell, false);
  });
})();
