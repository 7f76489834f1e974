// How each element of a drawing looks, and what it tells under the pointer; as the worksheet has them.
const LOOKS = {
  link(picture, e, a, b) {
    picture.bar(a, b);
    picture.label(e.name, beside, a, b);
  },
  plate(picture, e, ...p) {
    picture.area(p, 0.1);
    p.forEach((a, i) => picture.bar(a, p[(i + 1) % p.length]));
    picture.label(e.name, within, ...p);
  },
  cylinder(picture, e, a, b, c) {
    const u = unitAlong(minus(b, a)), size = sizeOf(minus(b, a)), end = sizeOf(minus(c, a)), start = Math.min(12, end / 3);
    const piston = plus(a, scaled(start + size - end, u)), side = scaled(BARREL, across(u));
    picture.bar(a, plus(a, scaled(start, u)));
    picture.bar(piston, b);
    picture.line([plus(piston, side), minus(piston, side)], BODY);
    const near = plus(a, scaled(start, u)), far = plus(a, scaled(end, u));
    picture.line([plus(near, side), plus(far, side), minus(far, side), minus(near, side)], EDGE, "", true);
    picture.label(e.name, beside, a, b, BARREL);
  },
  slot(picture, e, a, b) {
    const u = unitAlong(minus(b, a)), r = BLOCK[1] + 2.5;
    const arc = Array.from({length: 13}, (_, i) => scaled(r, rotated(u, direction(Math.PI * (i - 6) / 12))));
    picture.line([...arc.map(q => plus(b, q)), ...arc.map(q => minus(a, q))], BODY, "", true);
    picture.label(e.name, beside, a, b, r);
  },
  slider(picture, e, p) {
    const u = direction(-e.value), a = scaled(BLOCK[0], u), b = scaled(BLOCK[1], across(u));
    const corners = [minus(minus(p, a), b), minus(plus(p, a), b), plus(plus(p, a), b), plus(minus(p, a), b)];
    picture.area(corners, 0.1);
    picture.line(corners, EDGE, "", true);
    picture.labelRound(e.name, p, sizeOf(BLOCK));
  },
  hinge(picture, e, p) {
    picture.pin(p, e.name);
  },
  support(picture, e, p) {
    const u = direction(-e.value), base = plus(p, scaled(17, u)), side = across(u);
    picture.bar(p, minus(base, scaled(10, side)), EDGE);
    picture.bar(p, plus(base, scaled(10, side)), EDGE);
    picture.hatch(plus(base, scaled(15, side)), minus(base, scaled(15, side)));
    picture.pin(p, e.name);
  },
  mass(picture, e, p) {
    for (const quarter of [0, 12]) {
      const arc = Array.from({length: 7}, (_, i) => plus(p, scaled(MASS, direction(Math.PI * (quarter + i) / 12))));
      picture.area([p, ...arc]);
    }
    picture.pin(p, e.name, MASS);
  },
  text(picture, e, p) {
    picture.texts.push({name: e.name, centre: p, half: halfOf(e.name)});
  },
  ground(picture, e, a, b) {
    picture.hatch(a, b);
  },
  guide(picture, e, a, b) {
    const aside = scaled(BLOCK[1], across(unitAlong(minus(b, a))));
    picture.hatch(plus(a, aside), plus(b, aside));
  },
  wheel(picture, e, p, q) {
    picture.circle(p, sizeOf(minus(q, p)), BODY);
    picture.circle(p, 0.55 * sizeOf(minus(q, p)), THIN);
    picture.circle(p, 2);
    picture.labelRound(e.name, p, 2);
  },
  polygon(picture, e, ...p) {
    picture.area(p, e.colour ? 0.15 : 0.05, e.colour);
    picture.line(p, EDGE, e.colour, true);
    picture.label(e.name, within, ...p);
  },
  path(picture, e, ...p) {
    picture.line(p, EDGE, e.colour);
    picture.labelEnd(e.name, ...p.slice(-2));
  },
  arrow(picture, e, p, q) {
    if (p[0] === q[0] && p[1] === q[1]) return;
    picture.arrow(...(e.into ? [q, p] : [p, q]), e.colour);
    picture.label(e.name, past, p, q);
  },
  moment(picture, e, p) {
    const sense = Math.sign(e.value);
    if (!sense) return;
    const arc = Array.from({length: 25}, (_, i) => plus(p, scaled(ARC, direction(-sense * (0.1 + 1.4 * i / 24) * Math.PI))));
    const end = arc[24], u = scaled(-sense, across(unitAlong(minus(end, p))));
    picture.line(arc, ARROW, e.colour);
    picture.area([plus(end, scaled(9, u)), plus(end, scaled(4, across(u))), minus(end, scaled(4, across(u)))], 1, e.colour);
    picture.labelRound(e.name, p, ARC);
  },
  dimension(picture, e, a, b) {
    const u = unitAlong(minus(b, a)), n = e.value > 0 ? scaled(-1, across(u)) : across(u);
    const p = plus(a, scaled(Math.abs(e.value), n)), q = plus(b, scaled(Math.abs(e.value), n));
    const tip = s => rotated([9, s * 2.5], u);
    picture.line([plus(a, scaled(3, n)), plus(p, scaled(5, n))], THIN);
    picture.line([plus(b, scaled(3, n)), plus(q, scaled(5, n))], THIN);
    picture.line([p, q], THIN);
    picture.area([p, plus(p, tip(1)), plus(p, tip(-1))]);
    picture.area([q, minus(q, tip(1)), minus(q, tip(-1))]);
    picture.label(e.name, beside, p, q);
  },
};

// What an element tells under the pointer.
const digits = x => significant(x, 4);
function amount(x, unit) {
  if (unit === "N" && Math.abs(x) > 999.95) return `${digits(x / 1000)} kN`;
  return unit === "m" && 0 < Math.abs(x) && Math.abs(x) < 0.099995 ? `${digits(x * 1000)} mm` : `${digits(x)} ${unit}`;
}
const distance = e => amount(sizeOf(minus(e.points[1], e.points[0])), "m");
const placeOf = e => `${digits(e.points[0][0])}, ${digits(e.points[0][1])} m`;
const MEASURED = {
  link: distance, cylinder: distance, slot: distance, dimension: distance,
  slider: placeOf, hinge: placeOf, support: placeOf, mass: placeOf,
  arrow: e => `${amount(sizeOf(e.vector), e.unit)} (${e.vector.map(digits).join(", ")})`,
  moment: e => amount(e.value, e.unit),
};
const tipOf = e => (e.kind === "text" ? "" : [e.raw, MEASURED[e.kind]?.(e)].filter(Boolean).join(": "));
