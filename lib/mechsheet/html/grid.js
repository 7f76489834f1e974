// Lists and tables among the inputs as rows of cells; an empty row at the end is there to be filled in.
const KEYS = "Enter, ↑, ↓: along the column; Ctrl+Enter: a row in between; Ctrl+Delete: away with the row";

const gridOf = field => document.querySelector(`[data-grid="${field.name}"] table`);
const cellsIn = row => [...row.querySelectorAll("input")];
const valuesIn = row => cellsIn(row).map(cell => cell.value.trim());
const isFilled = row => valuesIn(row).some(Boolean);
const cellsOf = field => [...gridOf(field).tBodies[0].rows].map(valuesIn).filter(cells => cells.some(Boolean));

// Rows as they stand in a text; of a list each number is a row, however it is written.
function rowsIn(text, width) {
  const rows = text.split(/[\n|]/).filter(row => row.trim()).map(row => row.split(/[;\t]/).map(cell => cell.trim()));
  return width > 1 ? rows : rows.flat().map(cell => [cell]);
}

// Its rows under their heads, as they are printed.
const onPaper = field => `<table>${gridOf(field).tHead.outerHTML}<tbody>${cellsOf(field).map((cells, k) =>
  `<tr><th>${k + 1}</th>${cells.map((text, n) => (field.columns[n].texts
    ? `<td class="ms-text">${escaped(text)}</td>` : `<td>${inWords(escaped(text))}</td>`)).join("")}</tr>`).join("")}</tbody></table>`;

function fillGrid(field, text) {
  const grid = gridOf(field), width = field.columns.length;
  grid.title = KEYS;
  grid.tBodies[0].replaceChildren(...rowsIn(text, width).map(cells => gridRow(width, cells)));
  number(field, grid);
}

function gridRow(width, cells = []) {
  const row = document.createElement("tr");
  row.innerHTML = "<th></th>" + '<td><input type="text" inputmode="decimal" spellcheck="false"></td>'.repeat(width) +
    '<td><button type="button" tabindex="-1" aria-label="away with the row">×</button></td>';
  cellsIn(row).forEach((cell, n) => (cell.value = cells[n] ?? ""));
  return row;
}

// Only rows with something in them have a number.
function number(field, grid) {
  const [body] = grid.tBodies, names = field.columns.map(column => column.name.split(".").at(-1));
  if (!body.lastElementChild || isFilled(body.lastElementChild)) body.append(gridRow(names.length));
  let k = 0;
  for (const row of body.rows) {
    const own = isFilled(row) ? ++k : "";
    row.cells[0].textContent = own;
    cellsIn(row).forEach((cell, n) => {
      cell.ariaLabel = `${names[n]}, row ${own || "to be filled in"}`;
      cell.inputMode = field.columns[n].texts ? "text" : "decimal";
    });
  }
}

// Rows and columns from a cell on; what is more than the columns hold stays in the last, and is refused there.
function fillFrom(cell, text) {
  const from = cell.closest("td").cellIndex - 1, width = cellsIn(cell.closest("tr")).length, most = width - from;
  let row = cell.closest("tr");
  rowsIn(text, width).forEach((cells, k) => {
    if (k) row = row.nextElementSibling ?? row.parentElement.appendChild(gridRow(width));
    const kept = cells.length > most ? [...cells.slice(0, most - 1), cells.slice(most - 1).join("; ")] : cells;
    kept.forEach((text, n) => (cellsIn(row)[from + n].value = text));
  });
}

function takeAway(row) {
  const next = row.nextElementSibling ?? row.previousElementSibling;
  row.remove();
  return next;
}

const MOVES = {
  Enter: row => row.nextElementSibling,
  ArrowDown: row => row.nextElementSibling,
  ArrowUp: row => row.previousElementSibling,
  "Shift+Enter": row => row.previousElementSibling,
  "Ctrl+Enter": row => (row.after(gridRow(cellsIn(row).length)), row.nextElementSibling),
  "Ctrl+Delete": takeAway,
};

for (const field of told.inputs.fields.filter(field => field.kind === "rows")) {
  const grid = gridOf(field), changed = () => (number(field, grid), refresh());
  fillGrid(field, field.text);
  grid.addEventListener("input", () => number(field, grid));
  grid.addEventListener("paste", event => {
    const text = event.clipboardData.getData("text/plain");
    if (!/[\t\n;|]/.test(text.trim())) return; // one cell, which goes where the caret is
    event.preventDefault();
    fillFrom(event.target, text);
    changed();
  });
  grid.addEventListener("keydown", event => {
    const row = event.target.closest("tr"), at = event.target.closest("td")?.cellIndex;
    const key = (event.ctrlKey || event.metaKey ? "Ctrl+" : "") + (event.shiftKey ? "Shift+" : "") + event.key;
    if (!(key in MOVES) || !event.target.matches("input")) return;
    event.preventDefault();
    const next = MOVES[key](row);
    changed();
    next?.cells[at].querySelector("input")?.select();
  });
  grid.addEventListener("click", event => {
    if (!event.target.matches("button")) return;
    takeAway(event.target.closest("tr"));
    changed();
  });
}
