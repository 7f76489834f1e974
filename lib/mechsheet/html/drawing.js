// A drawing laid out as in the worksheet: fitted into its size, its scales below, names in free places. Points are pairs
// of numbers: of the drawing in its unit, y up; of the picture in px round its middle, y down.
const PEN = {"": "currentColor", blue: "#3b82d0", red: "#e0483c", green: "#2c9c5c", orange: "#cf7a17"};
const [MARGIN, FAR, PART, CELL_OF_INK, GAP] = [42, 1e5, 0.2, 5, 6];
const [BODY, EDGE, THIN, ARROW, PIN, MASS, BARREL, ARC] = [2.4, 1.5, 0.9, 2, 4.5, 7, 7, 26];
const BLOCK = [14, 8];

const plus = (a, b) => [a[0] + b[0], a[1] + b[1]];
const minus = (a, b) => [a[0] - b[0], a[1] - b[1]];
const scaled = (k, a) => [k * a[0], k * a[1]];
const inCells = a => [a[0] / CELL_OF_INK, a[1] / CELL_OF_INK];
const across = a => [-a[1], a[0]];
const rotated = (a, b) => [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]];
const direction = angle => [Math.cos(angle), Math.sin(angle)];
const sizeOf = a => Math.hypot(a[0], a[1]);
const unitAlong = a => (sizeOf(a) ? [a[0] / sizeOf(a), a[1] / sizeOf(a)] : [0, 0]);
const finite = a => Number.isFinite(a[0]) && Number.isFinite(a[1]);
const rint = x => (Math.abs(x % 1) === 0.5 ? 2 * Math.round(x / 2) : Math.round(x));
const keyOf = p => `${rint(10 * p[0])} ${rint(10 * p[1])}`;
const reach = (half, n) => Math.abs(half[0] * n[0]) + Math.abs(half[1] * n[1]);

// Marks [points, width, radius, colour, opacity, trimmed] of one element after the other, and names with their places.
function newPicture() {
  const picture = {groups: [], texts: [], endLabels: [], pointLabels: [], labels: [], pins: new Map(), arms: new Map(), faint: false, marks: []};
  const arm = (p, q) => {
    const key = keyOf(p);
    picture.arms.has(key) ? picture.arms.get(key).push(q) : picture.arms.set(key, [q]);
  };
  return Object.assign(picture, {
    line(points, width = EDGE, colour = "", closed = false) {
      picture.marks.push({points: closed ? [...points, points[0]] : points, width, colour});
    },
    bar(a, b, width = BODY) {
      picture.marks.push({points: [a, b], width, colour: "", trimmed: true});
      if (picture.faint) return;
      arm(a, minus(b, a));
      arm(b, minus(a, b));
    },
    area(points, opacity = 1, colour = "") {
      picture.marks.push({points, width: 0, colour, opacity});
    },
    circle(p, radius, width = EDGE) {
      picture.marks.push({points: [p], width, radius, colour: ""});
    },
    pin(p, name, r = PIN) {
      picture.circle(p, r);
      picture.pins.set(keyOf(p), r);
      picture.labelRound(name, p, r);
    },
    hatch(a, b) {
      const u = unitAlong(minus(b, a)), n = Math.max(1, rint(sizeOf(minus(b, a)) / 7));
      picture.line([a, b]);
      for (let i = 0; i < n; i++) {
        const p = plus(a, scaled((i + 0.8) / n, minus(b, a)));
        picture.line([p, plus(p, scaled(7, rotated([-0.8, 1], u)))], THIN);
      }
    },
    arrow(p, q, colour) {
      const u = unitAlong(minus(q, p)), size = sizeOf(minus(q, p)), head = Math.min(12, 0.7 * size);
      const side = s => minus(q, scaled(head, rotated([1, s * 0.34], u)));
      picture.line([p, minus(q, scaled(0.8 * head, u))], ARROW, colour);
      picture.area([q, side(1), side(-1)], 1, colour);
      arm(p, minus(q, p));
    },
    label(name, places, ...where) {
      if (name && !picture.faint) picture.labels.push([name, half => places(half, ...where)]);
    },
    labelEnd(name, a, b) {
      if (name && !picture.faint) picture.endLabels.push([name, half => past(half, a, b)]);
    },
    labelRound(name, p, r) {
      if (name && !picture.faint) picture.pointLabels.push([name, half => around(picture, half, p, r)]);
    },
  });
}

function* around(picture, half, p, r) {
  const arms = (picture.arms.get(keyOf(p)) ?? []).filter(q => q[0] || q[1]).map(q => Math.atan2(q[1], q[0])).sort((a, b) => a - b);
  let best = -Math.PI / 4, widest = -Infinity;
  arms.forEach((start, i) => {
    const gap = Math.round(1e6 * ((i + 1 < arms.length ? arms[i + 1] : arms[0] + 2 * Math.PI) - start)) / 1e6;
    if (gap >= widest) (widest = gap), (best = start + gap / 2);
  });
  for (const distance of [r + 4, r + 12, r + 22, r + 34]) {
    for (const turn of [0, 0.5, -0.5, 1, -1, 1.6, -1.6, 2.3, -2.3, Math.PI]) {
      const n = direction(best + turn);
      yield plus(p, scaled(distance + reach(half, n), n));
    }
  }
}

function* beside(half, a, b, r = 0) {
  const n = scaled(-1, across(unitAlong(minus(b, a))));
  for (const t of [0.5, 0.36, 0.64, 0.24, 0.76]) {
    for (const side of [n, scaled(-1, n)]) {
      yield plus(plus(a, scaled(t, minus(b, a))), scaled(r + GAP + reach(half, side), side));
    }
  }
}

function* within(half, ...points) {
  const middle = scaled(1 / points.length, points.reduce(plus));
  yield middle;
  for (const [i, a] of points.entries()) {
    const b = points[(i + 1) % points.length], m = scaled(0.5, plus(a, b)), away = minus(m, middle);
    let n = across(unitAlong(minus(b, a)));
    if (n[0] * away[0] + n[1] * away[1] < 0) n = scaled(-1, n);
    yield plus(m, scaled(GAP + reach(half, n), n));
  }
}

function* past(half, a, b) {
  const u = unitAlong(minus(b, a)), size = sizeOf(minus(b, a)), v = across(u), w = scaled(-1, v);
  const ends = [[0, u], [5, v], [5, w], [20, v], [20, w]];
  const along = size > 4 * GAP ? [0.35, 0.6].flatMap(t => [[t * size, v], [t * size, w]]) : [];
  const farther = [0, 0.8, -0.8, 1.6, -1.6, 2.4, -2.4, Math.PI].map(turn => [0, rotated(direction(turn), u)]);
  for (const [gap, places] of [[GAP, ends], [2 * GAP, ends], [GAP, along], [4 * GAP, farther], [7 * GAP, farther]]) {
    for (const [back, n] of places) {
      yield plus(minus(b, scaled(back, u)), scaled(gap + reach(half, n), n));
    }
  }
}

function boxOf(points) {
  if (!points.length) return [[0, 0], [1, 1]];
  let [x0, x1, y0, y1] = [Infinity, -Infinity, Infinity, -Infinity];
  for (const [x, y] of points) {
    x0 = Math.min(x0, x), x1 = Math.max(x1, x), y0 = Math.min(y0, y), y1 = Math.max(y1, y);
  }
  const half = [x1 / 2 - x0 / 2, y1 / 2 - y0 / 2], least = Math.max(...half) > 1e-9 ? 1e-9 : 1;
  return [[x0 / 2 + x1 / 2, y0 / 2 + y1 / 2], half.map(x => Math.max(x, least))];
}

function cornersOf(points, margin) {
  const [centre, half] = boxOf(points), room = plus(half, [margin, margin]);
  return [minus(centre, room), plus(centre, room)];
}

// Runs of a trajectory where it is finite; its name is at the end of the last one.
function piecesOf(e) {
  if (e.kind !== "path") return [e];
  const runs = [[]];
  for (const p of e.points) finite(p) ? runs.at(-1).push(p) : runs.at(-1).length && runs.push([]);
  const drawn = runs.filter(run => run.length > 1);
  return drawn.map((points, n) => ({...e, points, name: n + 1 < drawn.length ? null : e.name}));
}

const endsOf = (e, scales) =>
  e.vector ? [...e.points, plus(e.points[0], scaled((e.into ? -1 : 1) * (scales.get(e.unit) ?? NaN), e.vector))] : e.points;

function layOut(drawing) {
  const elements = drawing.elements.flatMap(piecesOf), given = drawing.frame.filter(finite);
  let [centre, half] = boxOf(given.length ? given : elements.flatMap(e => (e.points.every(finite) ? e.points : [])));
  const longest = new Map();
  for (const e of elements) {
    if (e.vector && [...e.points, e.vector].every(finite)) longest.set(e.unit, Math.max(sizeOf(e.vector), longest.get(e.unit) ?? 0));
  }
  const auto = [...longest].map(([unit, v]) => [unit, v ? 2 * PART * Math.max(...half) / v : 0]);
  const scales = new Map([...auto, [drawing.unit, 1], ...Object.entries(drawing.scales)]);
  if (!given.length) {
    [centre, half] = boxOf(elements.flatMap(e => (endsOf(e, scales).every(finite) ? endsOf(e, scales) : [])));
  }
  const k = Math.min((drawing.width / 2 - MARGIN) / half[0], (drawing.height / 2 - MARGIN) / half[1]);
  const picture = newPicture(), colours = new Map();
  for (const e of elements) {
    if (e.vector && !colours.has(e.unit)) colours.set(e.unit, e.colour);
    const at = endsOf(e, scales).map(p => [k * (p[0] - centre[0]), -k * (p[1] - centre[1])]);
    if (!at.every(p => Math.abs(p[0]) < FAR && Math.abs(p[1]) < FAR)) continue;
    Object.assign(picture, {faint: e.faint, marks: []});
    LOOKS[e.kind](picture, e, ...at);
    if (picture.marks.length) picture.groups.push({kind: e.kind, tip: e.faint ? "" : tipOf(e), faint: e.faint, marks: picture.marks});
  }
  const bars = new Map([[drawing.unit, k], ...[...longest.keys()].map(unit => [unit, k * scales.get(unit)])]);
  return withNames(picture, given.length ? plus(scaled(k, half), [MARGIN, MARGIN]) : null, bars, colours);
}

function withNames(picture, view, bars, colours) {
  const lines = segments(picture), ends = [...lines.map(line => line[0]), ...lines.map(line => line[1])];
  placeNames(picture, lines, ...(view ? [scaled(-1, view), view] : cornersOf(ends, 60)));
  let [low, high] = view ? [scaled(-1, view), view] : [];
  if (!view) {
    const boxes = picture.texts.flatMap(t => [plus(t.centre, t.half), minus(t.centre, t.half)]);
    [low, high] = cornersOf([...ends, ...boxes], 4);
  }
  if (picture.groups.length) {
    const end = scaleBars(picture, bars, colours, low[0] + 8, high[1] + 20, PART * (high[0] - low[0]));
    high = [Math.max(high[0], end), high[1] + 28];
  }
  return {low, high, groups: picture.groups, texts: picture.texts, pins: picture.pins};
}

const CIRCLES = Object.fromEntries([4, 24].map(n => [n, Array.from({length: n + 1}, (_, i) => direction(2 * Math.PI * i / n))]));

// Start, end and weight of all lines; circles as polygons.
function segments(picture) {
  return picture.groups.flatMap(({marks, faint}) => marks.flatMap(({points, radius}) => {
    const corners = radius ? CIRCLES[radius > 10 ? 24 : 4].map(q => plus(points[0], scaled(radius, q))) : points;
    return corners.slice(1).map((b, i) => [corners[i], b, faint ? 3 : 20]);
  }));
}

function roundBelow(x) {
  const power = 10 ** Math.floor(Math.log10(x));
  return [5, 2].map(m => m * power).find(v => v <= x) ?? power;
}

// Bars of round length side by side at height y, one for each unit that there is; where they end.
function scaleBars(picture, bars, colours, left, y, longest) {
  for (const [unit, scale] of bars) {
    const most = scale ? longest / scale : 0;
    if (!unit || !(most > 0 && most < Infinity)) continue;
    const value = roundBelow(most), end = left + value * scale;
    Object.assign(picture, {faint: false, marks: []});
    if (unit === "m") picture.line([[left, y - 4], [left, y], [end, y], [end, y - 4]]);
    else picture.arrow([left, y - 3], [end, y - 3], colours.get(unit) ?? "");
    picture.groups.push({kind: "scale", tip: "", faint: false, marks: picture.marks});
    const name = [amount(value, unit), "", "", ""], half = halfOf(name);
    picture.texts.push({name, centre: [end + 8 + half[0], y - 3], half});
    left = end + 2 * half[0] + 32;
  }
  return left;
}

// Half the size of a name, estimated from its small, capital and wide characters.
const widthOf = (text, size) => size * [...text].reduce((sum, c) =>
  sum + (" .,:;'()|".includes(c) ? 0.3 : c !== c.toUpperCase() || /[\d²³¹⁰⁴-⁹₀-₉]/.test(c) ? 0.48 : c < "\u1100" ? 0.72 : 1), 0);
const halfOf = ([mark, base, lowered, rest]) => [(widthOf(mark + base + rest, 15) + widthOf(lowered, 11)) / 2, 8];

// Each name at the first of its places free of lines and other names, or at the least bad.
function placeNames(picture, lines, low, high) {
  const {table, columns, rows} = inkTable(lines, low, high), wide = columns + 1;
  const clamped = (x, most) => Math.min(Math.max(rint(x), 0), most);
  const cost = (centre, half) => {
    const room = plus(half, [3, 1]), [p, q] = [minus(centre, room), plus(centre, room)].map(z => inCells(minus(z, low)));
    const outside = p[0] < 0 || p[1] < 0 || q[0] > columns || q[1] > rows;
    const [i, j, m, n] = [clamped(p[0], columns), clamped(q[0], columns), clamped(p[1], rows), clamped(q[1], rows)];
    const ink = table[n * wide + j] - table[m * wide + j] - table[n * wide + i] + table[m * wide + i];
    let clashes = 0;
    for (const text of picture.texts) {
      clashes += Math.abs(text.centre[0] - centre[0]) < text.half[0] + half[0] + 10 && Math.abs(text.centre[1] - centre[1]) < text.half[1] + half[1] + 1;
    }
    return 0.3 * ink + 50 * clashes + 100 * outside;
  };
  for (const [name, places] of [...picture.endLabels, ...picture.pointLabels, ...picture.labels]) {
    const half = halfOf(name);
    let best = [0, 0], least = Infinity, rank = 0;
    for (const at of places(half)) {
      if (rank >= least) break;
      const total = rank + cost(at, half);
      if (total < least) (best = at), (least = total);
      rank++;
    }
    picture.texts.push({name, centre: best, half});
  }
}

// Sums of the ink of lines over a grid of cells: four look-ups give that in a box.
function inkTable(lines, low, high) {
  const size = inCells(minus(high, low)), columns = Math.trunc(size[0]) + 1, rows = Math.trunc(size[1]) + 1;
  const table = new Float64Array((rows + 1) * (columns + 1)), wide = columns + 1;
  for (const [from, to, weight] of lines) {
    const a = inCells(minus(from, low)), step = minus(inCells(minus(to, low)), a);
    const count = Math.trunc(sizeOf(step)) + 1;
    for (let i = 0; i <= count; i++) {
      const x = Math.floor(a[0] + step[0] * (i / count)), y = Math.floor(a[1] + step[1] * (i / count));
      if (x >= 0 && x < columns && y >= 0 && y < rows) table[(y + 1) * wide + x + 1] += weight;
    }
  }
  for (let y = 1; y <= rows; y++) {
    let row = 0;
    for (let x = 1; x <= columns; x++) {
      row += table[y * wide + x];
      table[y * wide + x] = table[(y - 1) * wide + x] + row;
    }
  }
  return {table, columns, rows};
}

// The bar of a link, cut off at the circles of its hinges.
function cutMark(mark, pins) {
  if (!mark.trimmed) return mark;
  const [a, b] = mark.points, r = [a, b].map(p => pins.get(keyOf(p)) ?? 0), u = unitAlong(minus(b, a));
  if (sizeOf(minus(b, a)) <= r[0] + r[1]) return null;
  return {...mark, points: [plus(a, scaled(r[0], u)), minus(b, scaled(r[1], u))]};
}

const penOf = ({width, colour, opacity}) => width
  ? `stroke-width="${width}"${colour && ` stroke="${PEN[colour]}"`}`
  : `stroke="none" fill="${PEN[colour]}" fill-opacity="${opacity}"`;

// One element; successive lines of one style are one path.
function groupSVG({kind, tip, marks}, pins) {
  const out = [];
  let path = "", pen = null;
  const end = () => {
    if (path) out.push(`<path ${pen} d="${path}"/>`);
    path = "";
  };
  for (const mark of marks.map(mark => cutMark(mark, pins)).filter(Boolean)) {
    const own = penOf(mark);
    if (mark.radius || own !== pen) end();
    pen = own;
    if (mark.radius) out.push(`<circle ${pen} cx="${one(mark.points[0][0])}" cy="${one(mark.points[0][1])}" r="${one(mark.radius)}"/>`);
    else path += `M${mark.points.map(p => `${one(p[0])} ${one(p[1])}`).join("L")}`;
  }
  end();
  return `<g data-shape="${kind}">${tip && `<title>${escaped(tip)}</title>`}${out.join("")}</g>`;
}

function nameSVG({name, centre}) {
  const [mark, base, lowered, rest] = name.map(escaped), slanted = /^[^\P{L}Α-Ω]$/u.test(name[1]);
  const index = lowered && `<tspan dy="4" font-size="11">${lowered}</tspan>`;
  const letter = slanted ? `<tspan font-style="italic">${base}</tspan>` : base;
  const after = rest && `<tspan dy="${index ? -4 : 0}">${rest}</tspan>`;
  return `<text x="${one(centre[0])}" y="${one(centre[1] + 0.33 * 15)}">${mark}${letter}${index}${after}</text>`;
}

function drawingSVG(drawing) {
  const {low, high, groups, texts, pins} = layOut(drawing), size = minus(high, low);
  const [faint, clear] = [true, false].map(kind => groups.filter(group => group.faint === kind).map(group => groupSVG(group, pins)).join(""));
  return `<svg xmlns="http://www.w3.org/2000/svg" width="${one(size[0])}" viewBox="${[...low, ...size].map(one).join(" ")}" ` +
    'style="max-width:100%;height:auto" fill="none" stroke="currentColor" stroke-linecap="round" stroke-linejoin="round">' +
    `<g opacity="0.3">${faint}</g>${clear}<g fill="currentColor" stroke="none" text-anchor="middle" font-size="15" ` +
    `font-family="STIX Two Math,'Times New Roman',serif">${texts.map(nameSVG).join("")}</g></svg>`;
}

// A drawing with the numbers of an evaluation: each is a number already, or the key of one or of a field.
function drawnWith(spec, results) {
  const read = x => (typeof x === "string" ? results.values[x] : x ?? NaN);
  const points = list => list.flatMap(([re, im]) => {
    const [x, y] = [read(re), read(im)], many = [x, y].find(v => typeof v !== "number");
    const at = (v, i) => (typeof v === "number" ? v : v[v.length === 1 ? 0 : i]);
    return many === undefined ? [[x, y]] : Array.from(many, (_, i) => [at(x, i), at(y, i)]);
  });
  const nameOf = name => {
    if (name?.if) return nameOf(read(name.if) ? name.then : name.else);
    const parts = name?.map(part => written(part, read));
    return parts?.some(Boolean) ? parts : null;
  };
  const elements = spec.elements.map(e => {
    const value = read(e.value ?? 0), known = Number.isFinite(value);
    return {
      ...{unit: "", faint: false}, ...e, value, name: nameOf(e.name),
      raw: written(e.raw ?? "", read), colour: written(e.colour ?? "", read),
      points: known ? points(e.points) : [[NaN, NaN]], into: Boolean(read(e.into ?? 0)), vector: e.vector ? points([e.vector])[0] : null,
    };
  });
  const scales = Object.fromEntries(Object.entries(spec.scales).map(([unit, x]) => [unit, read(x)]));
  return {...spec, elements, frame: points(spec.frame), scales};
}
