// Formulas with numbers for their symbols, while the reader asks for them.
const root = document.documentElement;
const isPutIn = () => root.classList.contains("ms-with-numbers");

// Values in SI of the numbers of a formula; null where one is not known.
function numbersOf(spec, results) {
  const at = positionOf(spec) ?? 0, own = !state.changed.size && ![...moving.keys()].some(isSlid);
  const found = spec.numbers.map(number => (number.own && !own ? null : number.parts.map(part => {
    const x = typeof part === "string" ? results.values[part] : part ?? NaN;
    if (x === undefined || typeof x === "number") return x;
    return x[(x.shape ?? [x.length]).at(-1) > at ? at : 0];
  })));
  return found.every(parts => parts && !parts.includes(undefined)) ? found : null;
}

// What a number needs beside it depends on its kind.
function kindOf([x, y], factor) {
  if (y !== undefined) return x < 0 ? "minus" : "plain";
  const size = Math.abs(x / factor);
  if (size === Infinity) return x < 0 ? "minus infinite" : "none";
  if (size !== size) return "none";
  const isPlain = size === 0 || (size >= 1e-3 && size < 1e6);
  return x < 0 ? (isPlain ? "minus" : "minus power") : isPlain ? "plain" : "power";
}

function measure(parts, {factor, behind}) {
  const [x, y] = parts.map(part => usual(part / factor, MATHML));
  const text = y === undefined ? x : `</mn><mo>(</mo><mn>${x}</mn><mo>,</mo><mn>${y}</mn><mo>)</mo><mn>`;
  return `<mrow>${`<mn>${text}${behind}</mn>`.replace(/<(mn|mtext)><\/\1>/g, "")}</mrow>`;
}

function withNumbers(spec, known) {
  const kinds = known.map((parts, n) => kindOf(parts, spec.numbers[n].factor));
  const text = spec.text.replace(/<mo[^>]*>([\uf000-\uf8ff])<\/mo>/g, (_, letter) => {
    const [sign, needed] = spec.signs[letter.charCodeAt() - 0xf000];
    if (needed.some(([n, kind]) => kinds[n] === kind)) return `<mo>${sign}</mo>`;
    return sign === "⋅" ? '<mspace width=".17em"/>' : "";
  });
  const put = letter => measure(known[letter.charCodeAt() - 0xe000], spec.numbers[letter.charCodeAt() - 0xe000]);
  return `<math displaystyle="true"><mo>=</mo>${text.replace(/<mtext>([\ue000-\uefff])<\/mtext>/g, (_, letter) => put(letter))}</math>`;
}

document.addEventListener("change", ({target}) => {
  if (!target.matches(".ms-switch")) return;
  root.classList.toggle("ms-with-numbers", target.checked);
  refresh();
});
