// Numbers as texts, digit by digit as Python writes them: ties go to the even digit, where the browser rounds them up.
const CELL = {minus: "-", none: "–"};
const AXIS = {minus: "−", none: "–"};
const HTML = {minus: "−", none: "none"};
const MATHML = {
  minus: '</mn><mo form="prefix">−</mo><mn>', none: "</mn><mtext>none</mtext><mn>",
  power: (x, power) => `${x}</mn><mo>⋅</mo><msup><mn>10</mn><mrow><mn>${power}</mn></mrow></msup><mn>`,
};

const unlimited = (x, to) => (x !== x ? to.none : (x < 0 ? to.minus : "") + "∞");

// Whether what is cut off behind the last digit is exactly half of it; then the digit that was rounded up is taken back.
const even = (rounded, longer, longest) =>
  longer.at(-1) === "5" && /[13579]$/.test(rounded) && /^0*$/.test(longest().slice(longer.length));

// A magnitude in so many significant digits: these, and the power of ten of the first one.
function digitsOf(x, count) {
  const size = Math.abs(x), to = n => size.toExponential(n).split("e")[0].replace(".", "");
  let mantissa = to(count - 1);
  const power = size.toExponential(count - 1).split("e")[1];
  const isTen = count === 1 && mantissa === "1" && to(1)[0] === "9"; // the even one of 9 and 10
  if (!isTen && even(mantissa, to(count), () => to(100))) mantissa = mantissa.slice(0, -1) + (mantissa.at(-1) - 1);
  return [mantissa, Number(power)];
}

function positional(mantissa, power) {
  if (power < 0) return `0.${"0".repeat(-power - 1)}${mantissa}`;
  const before = mantissa.slice(0, power + 1).padEnd(power + 1, "0");
  const behind = mantissa.slice(power + 1);
  return behind ? `${before}.${behind}` : before;
}

const trimmed = text => (text.includes(".") ? text.replace(/\.?0*$/, "") : text);

function plainFixed(x, decimals) {
  const size = Math.abs(x);
  if (size >= 1e21) return BigInt(size).toString() + (decimals ? `.${"0".repeat(decimals)}` : "");
  const rounded = size.toFixed(decimals);
  if (!even(rounded, size.toFixed(decimals + 1), () => size.toFixed(Math.min(100, decimals + 60)))) return rounded;
  return rounded.slice(0, -1) + (rounded.at(-1) - 1);
}

const SMALLEST = 1e-6; // in the unit of a column: what is smaller may be nothing but rounding

// So many decimals, or one or two more where no number has any behind them.
function inFull(values, decimals) {
  const known = Array.from(values).filter(Number.isFinite);
  const tell = more => known.every(x => Math.abs(x - Math.round(x * 10 ** more) / 10 ** more) <= 1e-6 * 10 ** -more);
  return [decimals, decimals + 1, decimals + 2].find(tell) ?? decimals;
}

// So many decimals, or more where these show numbers in full, or left less than two digits of the largest: then three.
// Of one with more than six digits before its point only so many that these are nine in all.
function enough(values, usual) {
  const decimals = inFull(values, usual);
  const largest = Math.max(0, ...Array.from(values, Math.abs).filter(Number.isFinite));
  if (largest < SMALLEST) return decimals;
  const place = Math.floor(Math.log10(largest));
  return largest >= 10 ** (1 - decimals) ? Math.min(decimals, Math.max(8 - place, 0)) : 2 - place;
}

function fixed(x, decimals, to) {
  if (!Number.isFinite(x)) return unlimited(x, to);
  const text = plainFixed(x, decimals);
  return x < 0 && /[1-9]/.test(text) ? to.minus + text : text;
}

const exponent = (power, least) => `e${power < 0 ? "-" : "+"}${String(Math.abs(power)).padStart(least, "0")}`;

function scientific(x, decimals, to) {
  if (!Number.isFinite(x)) return unlimited(x, to);
  const [mantissa, power] = x === 0 ? ["0".repeat(decimals + 1), 0] : digitsOf(x, decimals + 1);
  const text = mantissa[0] + (decimals ? `.${mantissa.slice(1)}` : "") + exponent(power, 2);
  return ((x < 0 ? "-" : "") + text).replaceAll("-", to.minus);
}

function significant(x, digits) {
  if (!Number.isFinite(x)) return x !== x ? "nan" : x < 0 ? "-inf" : "inf";
  if (x === 0) return Object.is(x, -0) ? "-0" : "0";
  const [mantissa, power] = digitsOf(x, digits);
  const sign = x < 0 ? "-" : "";
  if (power >= -4 && power < digits) return sign + trimmed(positional(mantissa, power));
  return sign + trimmed(`${mantissa[0]}.${mantissa.slice(1)}`) + exponent(power, 2);
}

// A number as Python's format writes it: "d" a whole one, "r" as many digits as it takes, ".4g", ".2f" and ".3e"; behind
// "+" with either sign, behind "," with a comma after each thousand; behind ">8" with blanks before it, so wide in all.
function formatted(x, spec) {
  const [, side, width, sign, comma, rest] = spec.match(/^(?:([<>^])(\d+))?(\+?)(,?)(.*)$/), text = unsigned(x, rest);
  const split = comma ? text.replace(/\d+/, whole => whole.replace(/\d(?=(\d{3})+$)/g, "$&,")) : text;
  const whole = (text.startsWith("-") ? "" : sign) + split, before = side === "^" ? (width - whole.length) >> 1 : 0;
  return side === ">" ? whole.padStart(width) : whole.padStart(whole.length + before).padEnd(width ?? 0);
}

function unsigned(x, spec) {
  if (spec === "d") return String(x);
  if (!Number.isFinite(x)) return x !== x ? "nan" : x < 0 ? "-inf" : "inf";
  const digits = Number(spec.slice(1, -1)), sign = x < 0 || Object.is(x, -0) ? "-" : "";
  if (spec.endsWith("f")) return sign + plainFixed(x, digits);
  if (spec.endsWith("g")) return significant(x, digits || 1);
  if (spec.endsWith("e")) return sign + scientific(Math.abs(x), digits, CELL);
  const [mantissa, power] = Math.abs(x).toExponential().split("e");
  if (x && (power < -4 || power > 15)) return `${sign}${mantissa}${exponent(Number(power), 2)}`;
  return sign + Math.abs(x) + (Number.isInteger(x) ? ".0" : "");
}

// A text with numbers in it; what `read` gives for their keys stands there.
const written = (text, read) => (typeof text === "string" ? text : text.map(part => piece(part, read)).join(""));

function piece(part, read) {
  if (typeof part === "string") return part;
  if ("of" in part) return (part.texts ?? typedIn.get(part.column))[read(part.of)] ?? "";
  if (!Array.isArray(part)) return written(read(part.if) ? part.then : part.else, read);
  const [key, spec, ...instead] = part, x = read(key);
  return instead.reduce((told, [old, now]) => told.replaceAll(old, () => now), formatted(typeof x === "number" ? x : x[0], spec));
}

// HTML of pieces: as they stand, of numbers and texts, or of the way of a choice that has markup of its own.
function htmlOf(pieces, read) {
  return pieces.map(part => {
    if (typeof part === "string") return part;
    return part.ways ? htmlOf(part.ways[read(part.by) ? 0 : 1], read) : escaped(piece(part, read));
  }).join("");
}

// Five significant digits or all before the point, six of what has no more; a power of ten outside 1e-3..1e6.
function usual(x, to) {
  if (!Number.isFinite(x)) return unlimited(x, to);
  if (x === 0) return "0";
  const size = Math.abs(x), sign = x < 0 ? to.minus : "";
  if (size >= 1e5 && size < 1e6) return sign + plainFixed(x, 0);
  const isShort = significant(x, 6) === significant(x, 12), [mantissa, power] = digitsOf(x, isShort ? 6 : 5);
  if (size >= 1e-3 && size < 1e6) return sign + trimmed(positional(mantissa, power));
  const shown = trimmed(`${mantissa[0]}.${mantissa.slice(1)}`);
  const raised = (power < 0 ? to.minus : "") + Math.abs(power);
  return sign + (to.power ? to.power(shown, raised) : `${shown}\u202f·\u202f10<sup>${raised}</sup>`);
}

const ALIKE = 1e-9; // of the span of a field: numbers no further from its end are shown as that end
const ROUNDING = 2 ** -48; // of the largest number of a field: what is less may be nothing but roundings

const elements = part => (typeof part === "number" ? [part] : part);

// Whether numbers that are sums of terms, by their magnitudes, are less than the most, and none but roundings of these.
function isRounding(parts, terms, most) {
  if (terms === undefined) return false;
  const sizes = elements(terms), [re, im] = parts.map(elements), least = Math.min(...sizes);
  const magnitudes = Array.from(re, (x, i) => Math.hypot(x, im ? im[i] : 0)), greatest = Math.max(...magnitudes);
  const isSum = greatest > 0 && greatest < most && sizes.some(x => x !== 0);
  return isSum && magnitudes.every((x, i) => x <= ROUNDING * (sizes.length === re.length ? sizes[i] : least));
}

// A value in SI, a field or a point of two parts, in its display unit: what stands between the equals sign and the meaning.
function valueText(parts, factor, behind) {
  const arrays = parts.map(elements);
  const [re, im] = arrays, size = Math.max(...arrays.map(a => a.length));
  if (!size) return "none";
  const at = (a, i) => a[a.length === 1 ? 0 : i];
  let most = 0;
  for (let i = 0; i < size; i++) {
    const magnitude = im ? Math.hypot(at(re, i), at(im, i)) : Math.abs(at(re, i));
    if (Number.isFinite(magnitude)) most = Math.max(most, magnitude);
  }
  const least = ROUNDING * most, shown = x => (x !== 0 && Math.abs(x) < least ? "≈ 0" : usual(x / factor, HTML));
  const end = i => (im ? `(${shown(at(re, i))}, ${shown(at(im, i))})` : shown(at(re, i)));
  const each = Array.from({length: Math.min(size, 16)}, (_, i) => i);
  const shape = parts.find(part => part.shape)?.shape ?? [];
  if (isInRows(shape)) {
    const rows = Array.from({length: shape[0]}, (_, r) => each.slice(r * shape[1], (r + 1) * shape[1]).map(end).join(", "));
    return `[${rows.join("; ")}]${behind}`;
  }
  if (size <= (im ? 4 : 10)) return each.slice(0, size).map(end).join(", ") + behind;
  if (im) return `(${span(re, shown)}, ${span(im, shown)})${behind}`;
  const lost = re.reduce((n, x) => n + (x !== x), 0);
  return span(re, shown) + behind + (lost && lost < size ? ` (${lost} of ${size} ${HTML.none})` : "");
}

const isInRows = shape => shape.length === 2 && Math.max(...shape) <= 4;

function span(numbers, shown) {
  return [...new Set(leastAndGreatest(numbers).map(shown))].join(" … ");
}

// Least and greatest number that there is; a NaN where there is none.
function leastAndGreatest(numbers) {
  let low = Infinity, high = -Infinity, known = false;
  for (const x of numbers) if (x === x) (known = true), (low = Math.min(low, x)), (high = Math.max(high, x));
  return known ? [low, high] : [numbers[0]];
}

// Where a field is least and greatest along the quantities over which it runs, as the page of marimo says it.
function whereText(parts, over, values) {
  const [field] = parts, shape = field.shape ?? [field.length];
  if (parts.length > 1 || typeof field === "number" || field.length <= 10 || isInRows(shape)) return "";
  const [low, high] = leastAndGreatest(field), several = shape.filter(n => n > 1).length > 1;
  const most = field.reduce((x, y) => (Number.isFinite(y) ? Math.max(x, Math.abs(y)) : x), 0);
  const axes = shape.map((n, k) => (over[k] && values[over[k].key]?.length === n ? over[k] : null));
  if (!(high - low > ROUNDING * most) || !(several || axes.some(Boolean))) return "";
  // Of several turns that differ by roundings alone, the first.
  const alike = Math.max(ROUNDING * most, Number.isFinite(high - low) ? ALIKE * (high - low) : 0);
  const at = end => placeText(field.findIndex(x => x === end || Math.abs(x - end) <= alike), shape, axes, values);
  return ` <span class="ms-where">least at ${at(low)}, greatest at ${at(high)}</span>`;
}

function placeText(index, shape, axes, values) {
  const told = [], elements = [];
  shape.forEach((n, k) => {
    const at = Math.floor(index / shape.slice(k + 1).reduce((x, y) => x * y, 1)) % n, axis = axes[k];
    if (axis) told.push(`${axis.named} = ${usual(values[axis.key][at] / axis.factor, HTML)}${axis.behind}`);
    else if (n > 1) elements.push([at + 1, n]);
  });
  const [element, of] = [0, 1].map(n => elements.map(each => each[n]).join(", "));
  if (elements.length) told.push(elements.length > 1 ? `element (${element}) of (${of})` : `element ${element} of ${of}`);
  return told.join(", ");
}

// Numbers with as many digits as tell unequal ones apart; 17 always do.
function apart(values, digits = 4) {
  for (; ; digits++) {
    const rounded = values.map(x => (x === 0 ? ["0", 0] : digitsOf(x, digits)));
    const texts = values.map((x, i) => (x < 0 || Object.is(x, -0) ? "-" : "") + bare(...rounded[i]));
    if (new Set(texts).size === new Set(values.map(x => x + 0)).size || digits === 17) return texts;
  }
}

function bare(mantissa, power) {
  const digits = mantissa.replace(/0+$/, "") || "0";
  if (power > -6 && power < 15) return trimmed(positional(digits, power));
  return trimmed(`${digits[0]}.${digits.slice(1)}`) + exponent(power, 1);
}

const cellText = (x, column) => (column.power ? scientific : fixed)(x, column.decimals, AXIS);

// Numbers, degrees and comparisons of a sentence as the page writes them; what stands between quotes is as it was typed.
const QUOTED = /((?<![\p{L}\p{N}_])(?:'[^']*'|&#x27;.*?&#x27;)(?![\p{L}\p{N}_]))/u;
const inWords = text => String(text).split(QUOTED).map((part, n) => (n % 2 ? part : rewritten(part))).join("");

const POWER = /(?<![\p{L}\p{N}_])(?<![\p{L}\p{N}_]\.)(\d+(?:\.\d*)?)e([+-]?)0*(\d+)\b/gu;
const rewritten = text =>
  text
    .replace(/(\d) deg\b/g, "$1°")
    .replace(POWER, (_, x, sign, power) => `${x}\u202f·\u202f10<sup>${sign === "-" ? "−" : ""}${power}</sup>`)
    .replace(/(?<![\p{L}\p{N}_.)])-(?=[\d.∞])|(?<=\.\.)-|(?<= )-(?= )/gu, "−")
    .replace(/(?:>|&gt;)=/g, "≥")
    .replace(/(?:<|&lt;)=/g, "≤");

// Numbers with the digits of a line, or with as many more as tell unequal ones apart.
function inLine(values) {
  const texts = values.map(x => usual(x, HTML));
  return new Set(texts).size === new Set(values).size ? texts : apart(values, 6);
}

// What a check compares: as in lines and told apart, with two digits where the residual is only rounding.
function compared(residual, limit, agrees) {
  if (!Number.isFinite(residual) || !Number.isFinite(limit)) return [residual, limit].map(x => significant(x, 4).replace("inf", "∞"));
  return agrees || Math.abs(residual) < 1e-3 * limit ? apart([residual, limit], 2) : inLine([residual, limit]);
}
