// Sections: a click on a heading closes what stands below it, another one opens it; so it stays while the page runs.
(() => {
  if (window.msSections) return;
  window.msSections = true;

  const HEADINGS = ".markdown :is(h2, h3)";
  const place = `ms-closed ${location.pathname}${location.search}`;
  const closed = new Set(JSON.parse(sessionStorage.getItem(place) ?? "[]"));

  // A style sheet hides the cells by their ids: what marimo draws anew in them stays hidden.
  const style = document.head.appendChild(document.createElement("style"));

  // In the editor a cell stands in a frame that takes room without it.
  const hiding = (id) => `#${id},[data-is-dragging]:has(> #${id})`;

  // Each heading with its name, its cell and the cells below it, up to the next heading of its level or a higher one.
  function sections() {
    const found = [];
    let chapter = "";
    for (const cell of document.querySelectorAll(".marimo-cell")) {
      const headings = [...cell.querySelectorAll(HEADINGS)];
      for (const heading of headings) {
        if (heading.matches("h2")) chapter = heading.id;
        const own = { heading, cell, level: heading.tagName, name: `${chapter}/${heading.id}`, cells: [] };
        found.filter((each) => each.level >= own.level).forEach((each) => (each.ended = true));
        found.push(own);
      }
      const below = ({ ended, cell: own }) => !ended && own !== cell;
      found.filter(below).forEach(({ cells }) => cells.push(cell));
    }
    return found;
  }

  function show() {
    const all = sections();
    for (const { heading, name } of all) {
      heading.ariaExpanded = !closed.has(name);
      heading.tabIndex = 0;
    }
    const rules = all
      .filter(({ name }) => closed.has(name))
      .flatMap(({ heading, level, cell, cells }) => {
        const own = `#${CSS.escape(cell.id)} #${CSS.escape(heading.id)}`;
        const next = `${own} ~ ${level === "H2" ? "h2" : ":is(h2,h3)"}`; // in the same text
        const hidden = [`${own} ~ :not(${next},${next} ~ *)`, ...cells.map(({ id }) => hiding(CSS.escape(id)))];
        return [`${hidden.join(",")}{display:none!important}`, `${own}::after{content:" …"}`, `${own}::before{content:"▸"}`];
      });
    style.textContent = rules.length ? `@media screen{${rules.join("")}}` : "";
    sessionStorage.setItem(place, JSON.stringify([...closed]));
  }

  // Whatever leads to a place in closed sections opens them.
  function open(to) {
    const cell = to?.closest(".marimo-cell");
    const round = sections().filter(({ heading, cells, cell: own }) => {
      const after = own === cell && heading.compareDocumentPosition(to) & Node.DOCUMENT_POSITION_FOLLOWING;
      return cells.includes(cell) || after;
    });
    if (!round.map(({ name }) => closed.delete(name)).some(Boolean)) return;
    show();
    lead(to, 3);
  }

  // What has been opened takes its heights as it comes into sight, and moves the place, or is drawn anew, meanwhile.
  function lead(to, times) {
    (document.getElementById(to.id) ?? to).scrollIntoView({ block: "center" });
    if (times) requestAnimationFrame(() => requestAnimationFrame(() => lead(to, times - 1)));
  }

  const SECOND = 250; // ms within which a second click on a heading of the editor edits it, and closes nothing
  let second;

  const targetOf = (link) => document.getElementById(decodeURIComponent(link.hash.slice(1)));

  document.addEventListener(
    "click",
    (event) => {
      const { target } = event;
      const link = target.closest?.('a[href^="#"]');
      const to = link && targetOf(link);
      if (to) {
        // The address stays: it carries the inputs, and by the page's base a fragment may lead from the worksheet.
        event.preventDefault();
        event.stopPropagation();
        open(to);
        return lead(to, 3);
      }
      const heading = target.closest?.(HEADINGS);
      if (heading) {
        clearTimeout(second);
        if (getSelection().toString()) return;
        const { name } = sections().find((each) => each.heading === heading);
        const toggle = () => {
          if (!closed.delete(name)) closed.add(name);
          show();
        };
        if (!event.detail || !heading.closest(".interactive")) return toggle();
        if (event.detail === 1) second = setTimeout(toggle, SECOND);
        return;
      }
      if (!closed.size || target.closest?.(".marimo-cell")) return;
      const text = target.textContent?.trim(); // an entry of marimo's outline
      open([...document.querySelectorAll(HEADINGS)].find((each) => each.textContent.trim() === text));
    },
    { capture: true },
  );
  document.addEventListener("keydown", (event) => {
    if (event.key !== "Enter" || !event.target.matches?.(HEADINGS)) return;
    event.preventDefault();
    event.target.click();
  });
  document.addEventListener("ms-lead", ({ target }) => open(target));
  document.addEventListener("ms-measured", show); // once everything is there
  document.addEventListener("ms-drawn", () => {
    const isNew = (heading) => heading.ariaExpanded === null; // drawn anew with its cell
    if ([...document.querySelectorAll(HEADINGS)].some(isNew)) show();
  });
})();
