// The verdict of a solve block in words: what was found and how well, or why there is nothing. Of an array of problems
// it has one verdict each. A unit is its factor with what stands behind a number; `plain` are names without markup.
const LISTED = 8; // solutions that a verdict lists
const amounts = (values, [factor], digits) => apart(values.map(x => x / factor), digits);
const withUnit = (x, unit, digits) => amounts([x], unit, digits)[0] + unit[1];
const spanOf = texts => [...new Set(texts)].join("..");
const largestOf = values => Math.max(...values.filter(x => x === x).map(Math.abs));
// Least..greatest, one number where they are equal but for rounding.
const extent = (values, unit) => {
  const ends = leastAndGreatest(values.filter(x => x === x)), isOne = ends[1] - ends[0] <= 2 ** -48 * largestOf(ends);
  return spanOf(inLine((isOne ? ends.slice(0, 1) : ends).map(x => x / unit[0]))) + unit[1];
};

const signed = branch => `${branch < 0 ? "" : "+"}${branch}`;

function reasonForOne(words, verdict) {
  const places = verdict.branches?.flatMap(([s, {roots}]) =>
    roots.map(root => `at ${withUnit(root.value, words.unknown_unit)} on branch ${signed(s)}`)) ?? [];
  return reasonOnBranch(words, verdict) + (places.length ? `; it is reached ${places.join(", ")}` : "");
}

function reasonOnBranch(words, {reason, reached, interval, jump, samples, equals}) {
  const by = ` by ${samples} samples`;
  if (reason === "nothing") return `nothing to solve for ${words.unknown}: its interval, target or guess is NaN`;
  if (reason === "closes") {
    const nowhere = `is NaN at each of ${samples} samples in ${extent(interval, words.unknown_unit)}`;
    return `${words.unknown}: ${words.quantity} ${nowhere}, as of a group that does not close, or a square root of a negative number`;
  }
  if (!["outside", "jumps", "level"].includes(reason)) return reason;
  const [low, high, target] = amounts([...reached, equals], words.unit), [, behind] = words.unit;
  if (reason === "level") {
    const everywhere = `is ${target}${behind} at each of ${samples} samples in ${extent(interval, words.unknown_unit)}`;
    return `${words.unknown}: ${words.quantity} ${everywhere}: any value would do`;
  }
  const reach = `${words.unknown}: ${words.quantity} reaches ${spanOf([low, high])}${behind}${by}`;
  if (reason === "outside") return `${reach}, ${target}${behind} is outside`;
  return `${reach} but jumps over ${target}${behind}${jump === jump ? ` at ${withUnit(jump, words.unknown_unit)}` : ""}`;
}

const pointOf = ({names, units}, x) => names.map((name, k) => `${name} = ${extent([x[k]], units[k])}`).join(", ");

function reasonForSeveral(words, verdict, isAlone) {
  const {reason, nearest} = verdict, unknowns = words.names.join(", ");
  if (reason === "nothing") return `nothing to solve for ${unknowns}: an interval, a guess or a target is NaN`;
  if (reason === "depend") {
    const [one, other] = verdict.pair.map(x => pointOf(words, x));
    const solved = `${one} solves them, and so does ${other}`;
    return `no single solution for ${unknowns}: the equations depend on each other, ${solved}`;
  }
  if (reason !== "unsolved") return reason;
  const how = `no solution for ${unknowns} ${words.guessed ? "from the guess" : `by ${verdict.starts} starts`}`;
  const lost = nearest.residual.findIndex(x => x !== x);
  if (lost >= 0) return `${how}: ${words.equations[lost]} has no number there`;
  const rests = nearest.slopes.findIndex(row => row.every(x => x === 0));
  if (rests >= 0 && nearest.residual.every(x => x === 0)) {
    const same = `${words.equations[rests]} rests on none of them near ${pointOf(words, nearest.x)}`;
    return `no single solution for ${unknowns}: ${same}`;
  }
  const worst = nearest.left.indexOf(Math.max(...nearest.left));
  const left = withUnit(nearest.residual[worst], words.equation_units[worst]);
  const others = words.guessed && isAlone ? verdict.solutions.map(x => pointOf(words, x)) : [];
  const nearer = others.length === 1 ? "it" : "one of them";
  return `${how}: ${words.equations[worst]} leaves ${left} at the nearest, ${pointOf(words, nearest.x)}` +
    (others.length ? `; starts around it see ${others.slice(0, LISTED).join("; ")}: give a guess nearer to ${nearer}` : "");
}

// Unknowns with their values, and how many problems are solved.
function headOf(words, verdicts, reasons, isAlone) {
  const several = words.names, unknowns = several?.join(", ") ?? words.unknown, valued = verdicts.filter((_, k) => !reasons[k]);
  if (isAlone && reasons[0]) return unknowns;
  if (isAlone) return several ? pointOf(words, valued[0].x) : `${unknowns} = ${extent([valued[0].value], words.unknown_unit)}`;
  const count = `${valued.length} of ${verdicts.length} problems ${words.least ? "fitted" : "solved"}`;
  if (!valued.length) return `${unknowns}, ${count}`;
  const spans = several?.map((name, k) => `${name} = ${extent(valued.map(v => v.x[k]), words.units[k])}`);
  return `${spans?.join(", ") ?? `${unknowns} = ${extent(valued.map(v => v.value), words.unknown_unit)}`}, ${count}`;
}

function rowsOfOne(words, verdicts, reasons, isAlone) {
  const valued = verdicts.filter((_, k) => !reasons[k]), [first] = verdicts, all = name => verdicts.flatMap(v => v[name]);
  const {branch, branches} = first, on = branch === undefined ? "" : ` on branch ${signed(branch)}`;
  const rows = [["condition", `${words.quantity} = ${extent(all("equals"), words.unit)}${on}`]];
  if (valued.length) rows.push([isAlone ? "missed by" : "missed at most by", withUnit(largestOf(valued.map(v => v.residual)), words.unit, 2)]);
  if (isAlone && valued.length) rows.push(["value within", withUnit(first.bracket[1] - first.bracket[0], words.unknown_unit, 2)]);
  if (isAlone) {
    const every = branches ?? [[null, first]], samples = every.reduce((n, [, v]) => n + v.samples, 0);
    const roots = every.flatMap(([s, v]) => v.roots.map(({value}) => [value, s])).sort(([a], [b]) => a - b);
    const [factor, behind] = words.unknown_unit, texts = inLine(roots.map(([x]) => x / factor));
    const shown = roots.map(([, s], k) => texts[k] + behind + (branches ? ` (branch ${signed(s)})` : ""));
    rows.push([`roots seen by ${samples} samples`, shown.join("; ") || "none"]);
  }
  if (all("interval").every(Number.isFinite)) rows.push(["searched", extent(all("interval"), words.unknown_unit)]);
  return rows;
}

function rowsOfSeveral(words, verdicts, reasons, isAlone) {
  const valued = verdicts.filter((_, k) => !reasons[k]), rows = [];
  if (valued.length) {
    const left = words.equation_units.map((unit, m) => withUnit(largestOf(valued.map(v => v.residual[m])), unit, 2));
    rows.push([isAlone ? "missed by" : "missed at most by", left.join("; ")]);
    const worst = largestOf(valued.map(v => v.condition));
    rows.push([isAlone ? "errors grow" : "errors grow at most", Number.isFinite(worst) ? `${significant(worst, 2)} times` : "infinite: the slopes are singular"]);
  }
  if (isAlone && !words.least) {
    const {solutions, starts} = verdicts[0], more = solutions.length - LISTED;
    const listed = solutions.slice(0, LISTED).map(x => pointOf(words, x));
    const where = `${starts} starts${words.guessed ? " around the guess" : ""}`;
    rows.push([`solutions seen by ${where}`, [...listed, ...(more > 0 ? [`and ${more} more`] : [])].join("; ") || "none"]);
  }
  const searched = words.names.map((name, k) => {
    const ends = verdicts.flatMap(v => v.asked[k]), isGuessed = verdicts.every(v => new Set([v.asked[k]].flat()).size === 1);
    return `${name} ${isGuessed ? "from" : "in"} ${extent(ends, words.units[k])}`;
  });
  return [...rows, ["searched", searched.join("; ")]];
}

function foundHTML(words, found) {
  const isAlone = !Array.isArray(found), verdicts = isAlone ? [found] : found;
  const why = words.names ? reasonForSeveral : reasonForOne, plain = {...words, ...words.plain};
  const reasons = verdicts.map(verdict => verdict.reason && why(plain, verdict, isAlone));
  const failed = reasons.flatMap((reason, k) => (reason ? [isAlone ? reason : `problem ${k + 1}: ${reason}`] : []));
  const failures = failed.length > 3 ? [...failed.slice(0, 3), `and ${failed.length - 3} more`] : failed;
  const waits = verdicts.every(v => v.reason === "nothing"), isLeast = words.least && !failures.length;
  const word = isLeast ? "least squares" : waits ? "not evaluated" : failures.length ? "not found" : "found";
  const kind = isLeast || waits ? "OPEN" : failures.length ? "FAIL" : "PASS";
  const rows = waits ? [] : (words.names ? rowsOfSeveral : rowsOfOne)(words, verdicts, reasons, isAlone);
  if (!waits) rows.push(["computed", `${verdicts.reduce((n, v) => n + v.evaluations, 0)} times`]);
  const head = inWords(headOf(words, verdicts, reasons, isAlone));
  return `<div><span class="ms-badge ms-${kind}">${word}</span> <b>${head}</b></div>` +
    failures.map(text => `<div>${inWords(text)}</div>`).join("") +
    `<table>${rows.map(([what, text]) => `<tr><th>${what}</th><td>${inWords(text)}</td></tr>`).join("")}</table>`;
}
