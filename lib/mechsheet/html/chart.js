// Line charts as the worksheet lays them out: axes in round numbers, curves, marks, legend, and what hovering tells.
const COLOURS = ["#3b82d0", "#e0483c", "#2c9c5c", "#cf7a17", "#8b6fd6", "#1aa3a8", "#c2528b", "#8a8a3a"];
const DASHES = ["", "9 3", "3 3", "9 3 2 3"];
const [WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM, MARKED] = [660, 330, 74, 24, 34, 46, 60];
const PLOT = {width: WIDTH - LEFT - RIGHT, height: HEIGHT - TOP - BOTTOM};
const STEPS = [1, 2, 2.5, 5, 10], STEPS_OF_A_CIRCLE = {1: [1.5, 3, 4.5, 6, 9, 18], 2: [1.8, 3.6, 7.2, 10.8]};


// Ends, step and last decimal of an axis that holds all finite values.
function axisOf(arrays, unit, count = 6) {
  let low = Infinity, high = -Infinity;
  for (const values of arrays) for (const x of values) if (Number.isFinite(x)) (low = Math.min(low, x)), (high = Math.max(high, x));
  if (low > high) [low, high] = [0, 1];
  if (!(high - low > Math.max(1e-9 * Math.abs(low), 1e-9 * Math.abs(high), 1e-300))) {
    const half = Math.abs(low) / 2 || 0.5;
    [low, high] = [low - half, high + half];
  }
  const rough = (high - low) / count, power = Math.floor(Math.log10(rough)), ten = Number(`1e${power}`);
  const steps = (["deg", "°"].includes(unit) && STEPS_OF_A_CIRCLE[power]) || STEPS;
  const factor = steps.find(m => m * ten >= 0.999 * rough), step = factor * ten;
  const rounded = i => Number((i * step).toFixed(Math.max(0, Math.min(100, 1 - power))));
  const axis = {low: rounded(Math.floor(low / step + 1e-9)), high: rounded(Math.ceil(high / step - 1e-9)), step};
  const places = (factor === 2.5) - Math.floor(Math.log10(step) + 1e-9);
  const largest = Math.max(Math.abs(axis.low), Math.abs(axis.high));
  axis.power = largest >= 1e-2 && largest < 1e5 ? 0 : 3 * Math.floor(Math.log10(largest) / 3);
  const [from, to] = [axis.low, axis.high].map(end => Math.round(end / step));
  axis.ticks = Array.from({length: to - from + 1}, (_, i) => (from + i) * step);
  axis.text = (tick, power = axis.power) => fixed(tick / 10 ** power, Math.max(0, places + power), AXIS);
  return axis;
}

const raised = n => String(n).replace(/[-\d]/g, sign => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(sign)]);

// Symbols and units of an axis; a power of ten goes before the unit.
function axisTitle(columns, power) {
  const groups = [];
  for (const column of columns) {
    if (groups.at(-1)?.[0].unit === column.unit) groups.at(-1).push(column);
    else groups.push([column]);
  }
  const factor = power ? `10${raised(power)} ` : "";
  return groups.map(members => {
    const unit = `${factor}${escaped(members[0].printed)}`.trim() || (groups.length > 1 ? "-" : "");
    return members.map(column => column.drawn).join(", ") + (unit ? ` [${unit}]` : "");
  }).join("; ");
}

function one(x) {
  const tenths = Math.round(10 * x), isClear = Math.abs(10 * x - tenths) < 0.499 && Math.abs(x) < 1e9;
  return isClear ? (tenths % 10 ? String(tenths / 10) : `${tenths / 10}.0`) : fixed(x, 1, CELL);
}

const textAt = (x, y, anchor, inside) => `<text x="${one(x)}" y="${one(y)}" text-anchor="${anchor}" fill="currentColor" stroke="none">${inside}</text>`;

// Points that curves of many need to look as they are: see `thinned` of the document.
const PIECES = 400, MOST = 4 * PIECES;

function pointsShown(columns) {
  const count = columns[0].length, shown = new Uint8Array(count);
  if (count <= MOST) return undefined;
  for (let piece = 0; piece < PIECES; piece++) {
    const [from, end] = [piece, piece + 1].map(k => Math.floor(k * count / PIECES));
    shown[from] = shown[end - 1] = 1;
    for (const values of columns) {
      let least = -1, greatest = -1;
      for (let i = from; i < end; i++) {
        if (!Number.isFinite(values[i])) continue;
        if (least < 0 || values[i] < values[least]) least = i;
        if (greatest < 0 || values[i] > values[greatest]) greatest = i;
      }
      if (least >= 0) shown[least] = shown[greatest] = 1;
    }
  }
  for (const values of columns)
    for (let i = 1; i < count; i++)
      if (Number.isFinite(values[i]) !== Number.isFinite(values[i - 1])) shown[i] = shown[i - 1] = 1;
  return Array.from(shown.keys()).filter(i => shown[i]);
}

function curveSVG(n, px, py, every) {
  const colour = COLOURS[n % 8], dash = DASHES[n % 4] && ` stroke-dasharray="${DASHES[n % 4]}"`;
  let path = "", drawing = false;
  const dots = [], marked = Math.ceil(px.length / every) <= MARKED;
  for (let i = 0; i < px.length; i++) {
    const known = Number.isFinite(px[i] + py[i]);
    if (known) path += `${drawing ? "L" : "M"}${one(px[i])} ${one(py[i])}`;
    if (known && marked && i % every === 0) dots.push(`<circle cx="${one(px[i])}" cy="${one(py[i])}" r="2.6"/>`);
    drawing = known;
  }
  const line = `<path stroke="${colour}" stroke-width="1.8"${dash} d="${path}"/>`;
  return marked ? `${line}<g fill="${colour}" stroke="none">${dots.join("")}</g>` : line;
}

function legendSVG(lines) {
  let left = LEFT;
  return lines.map((line, n) => {
    const dash = DASHES[n % 4] && ` stroke-dasharray="${DASHES[n % 4]}"`;
    const sample = `<path stroke="${COLOURS[n % 8]}" stroke-width="2.2"${dash} fill="none" d="M${left} 17h26"/>${textAt(left + 31, 21, "start", line.drawn)}`;
    left += 31 + 9 * line.letters + 16;
    return sample;
  }).join("");
}

function chartSVG(spec, whole, results) {
  const at = pointsShown(whole), columns = at ? whole.map(values => at.map(i => values[i])) : whole;
  const [x, ...lines] = spec.columns, [xs, ...ys] = columns, every = at ? 1 : argument(spec.every, results);
  const marks = spec.marks.map(mark => ({...mark, x: mark.key === undefined ? mark.x : results.values[mark.key] / x.factor}));
  const across = axisOf([xs, ...marks.map(mark => [mark.x])], x.unit), up = axisOf(ys, lines[0].unit);
  const kx = PLOT.width / (across.high - across.low), ky = -PLOT.height / (up.high - up.low);
  const px = Float64Array.from(xs, v => kx * (v - across.low));
  const curves = ys.map((y, n) => curveSVG(n, px, Float64Array.from(y, v => PLOT.height + ky * (v - up.low)), every));
  const grid = across.ticks.map(t => `M${one(kx * (t - across.low))} 0V${PLOT.height}`).join("") +
    up.ticks.map(t => `M0 ${one(PLOT.height + ky * (t - up.low))}H${PLOT.width}`).join("");
  const marked = marks.map(mark => {
    const u = kx * (mark.x - across.low);
    if (!Number.isFinite(u)) return "";
    return `<path class="ms-mark" stroke-dasharray="5 4" stroke-opacity=".7" d="M${one(u)} 0V${PLOT.height}"/>${textAt(u + 5, 14, "start", mark.drawn)}`;
  });
  const under = HEIGHT - BOTTOM + 17;
  const texts = [
    ...across.ticks.map(t => textAt(LEFT + kx * (t - across.low), under, "middle", across.text(t))),
    ...up.ticks.map(t => textAt(LEFT - 7, TOP + PLOT.height + ky * (t - up.low) + 4, "end", up.text(t))),
    textAt(LEFT + PLOT.width / 2, HEIGHT - 8, "middle", axisTitle([x], across.power)),
    `<g transform="translate(16 ${one(TOP + PLOT.height / 2)}) rotate(-90)">${textAt(0, 0, "middle", axisTitle(lines, up.power))}</g>`,
  ];
  const readings = {
    at: Array.from(px, u => (Number.isFinite(u) ? Math.round(10 * (LEFT + u)) / 10 : null)),
    names: spec.columns.map(column => column.named),
    units: spec.columns.map(column => column.printed),
    texts: spec.columns.map((column, n) => Array.from(columns[n], v => (Number.isFinite(v) ? fixed(v, column.decimals, AXIS) : AXIS.none))),
  };
  const moving = `transform:translateX(calc((var(--at-${x.symbol},-1e30) - ${across.low * x.factor}) / ${x.factor / kx} * 1px))`;
  return `<svg xmlns="http://www.w3.org/2000/svg" class="ms-chart" width="${WIDTH}" viewBox="0 0 ${WIDTH} ${HEIGHT}" style="max-width:100%;height:auto" fill="none" stroke="currentColor" stroke-linejoin="round" data-values="${escaped(JSON.stringify(readings))}">` +
    `<path stroke-opacity=".6" d="M${LEFT} ${TOP}V${TOP + PLOT.height}H${LEFT + PLOT.width}"/>` +
    `<svg x="${LEFT}" y="${TOP}" width="${PLOT.width}" height="${PLOT.height}" viewBox="0 0 ${PLOT.width} ${PLOT.height}">` +
    `<path stroke-opacity=".16" stroke-width="1" d="${grid}"/>${curves.join("")}${marked.join("")}` +
    `<path class="ms-at" stroke="#e0483c" stroke-width="1.5" d="M0 0V${PLOT.height}" style="${moving}"/></svg>` +
    `<g fill="currentColor" stroke="none" font-size="13">${texts.join("")}${lines.length > 1 ? legendSVG(lines) : ""}</g></svg>`;
}
