// Units under the hand: a click on one offers those that measure the same, for all that shows this quantity.
const chosen = new Map(); // by the name of what is shown, while the page is open

const offersOf = spec => told.units[spec.unit] ?? [];
const unitNow = spec => offersOf(spec).find(([label]) => label === chosen.get(spec.of)) ?? offersOf(spec)[0];
const isSwitched = spec =>
  [spec, ...(spec.columns ?? []), ...(spec.over ?? [])].some(each => each?.of && each.unit && chosen.has(each.of));

// A column in the unit that is chosen, not finer than it is in its own; of its greatest number five digits are enough.
function inUnit(column, results) {
  const [own] = offersOf(column), now = unitNow(column);
  if (now === own) return column;
  const [label, factor] = now, other = {...column, own: column.factor, unit: label, printed: label, factor};
  const sizes = Array.from(columnValues(other, results) ?? [], Math.abs).filter(Number.isFinite);
  const before = Number(Math.max(0, ...sizes).toExponential().split("e")[1]) + 1;
  const same = column.decimals + Math.round(Math.log10(factor / column.factor));
  return {...other, decimals: column.power ? column.decimals : Math.max(0, Math.min(same, 5 - before))};
}

// The quantity along an axis of a field in the unit that is chosen for it where its own numbers are switched.
function axisNow(axis) {
  if (!axis || !chosen.has(axis.of)) return axis;
  const [, factor, behind] = unitNow(axis);
  return {...axis, factor, behind: behind.replace(/<\/?ms-unit>/g, "")};
}

// An axis has one unit: that of its first quantity for which another one is chosen; one of several units keeps them.
function chartInUnits(spec, results) {
  const [x, ...lines] = spec.columns, first = lines.find(isSwitched);
  const alike = first && lines.every(line => line.unit === first.unit);
  const across = inUnit(x, results), up = alike ? lines.map(line => inUnit({...line, of: first.of}, results)) : lines;
  const marks = spec.marks.map(mark => (mark.key === undefined ? {...mark, x: mark.x * (x.factor / across.factor)} : mark));
  return {...spec, columns: [across, ...up], marks};
}

customElements.define("ms-unit", class extends HTMLElement {
  connectedCallback() {
    this.tabIndex = 0;
    this.role = "button";
    this.ariaHasPopup = "menu";
  }
});

const menu = document.createElement("div");
menu.className = "ms-menu";
menu.role = "menu";
menu.popover = "auto";

const shownAt = unit => told.shown[unit.closest("[data-n]").dataset.n];
const switchedBy = unit => (unit.closest("th") ? shownAt(unit).columns[unit.closest("th").cellIndex] : shownAt(unit));

function offer(unit) {
  const spec = switchedBy(unit), [now] = unitNow(spec);
  menu.replaceChildren(...offersOf(spec).map(([label]) => {
    const item = document.createElement("button");
    Object.assign(item, {textContent: label, role: "menuitemradio", ariaChecked: label === now});
    item.onclick = () => choose(unit.closest("[data-n]"), spec, label);
    return item;
  }));
  document.body.append(menu);
  menu.showPopover();
  const {left, bottom, top} = unit.getBoundingClientRect();
  menu.style.left = `${Math.min(left, innerWidth - menu.offsetWidth - 8)}px`;
  menu.style.top = `${bottom + menu.offsetHeight > innerHeight ? top - menu.offsetHeight : bottom}px`;
  menu.querySelector("[aria-checked=true]").focus();
}

function choose(element, {of, unit}, label) {
  if (label === told.units[unit][0][0]) chosen.delete(of);
  else chosen.set(of, label);
  document.querySelectorAll(".ms-table ms-unit").forEach(each => (each.textContent = unitNow(switchedBy(each))[0]));
  menu.hidePopover();
  refresh();
  settleAll();
  [...element.querySelectorAll("ms-unit")].find(each => switchedBy(each).of === of)?.focus();
}

const isUnit = target => target.matches?.("[data-n] ms-unit");
document.addEventListener("click", ({target}) => isUnit(target) && offer(target));
document.addEventListener("keydown", event => {
  const step = {ArrowDown: "nextElementSibling", ArrowUp: "previousElementSibling"}[event.key];
  if (isUnit(event.target) && (event.key === "Enter" || event.key === " ")) offer(event.target);
  else if (!(step && menu.contains(event.target))) return;
  else event.target[step]?.focus();
  event.preventDefault();
});
