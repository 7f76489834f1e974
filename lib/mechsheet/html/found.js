// The verdict of a solve block in words: what was found and how well, or why there is nothing.
const amounts = (values, factor, digits) => apart(values.map(x => x / factor), digits);
const spanOf = texts => [...new Set(texts)].join("..");

function reasonFor(words, {reason, reached, interval, jump, samples, equals}) {
  const place = (values, digits) => spanOf(amounts(values, words.unknown_factor, digits)) + words.unknown_suffix;
  const by = ` by ${samples} samples`;
  if (reason === "nothing") return `nothing to solve for ${words.unknown}: its interval, target or guess is NaN`;
  if (reason === "closes") {
    const nowhere = `is NaN at each of ${samples} samples in ${place(interval)}`;
    return `${words.unknown}: ${words.quantity} ${nowhere}, as of a group that does not close, or a square root of a negative number`;
  }
  if (reason !== "outside" && reason !== "jumps") return reason;
  const [low, high, target] = amounts([...reached, equals], words.factor);
  const reach = `${words.unknown}: ${words.quantity} reaches ${spanOf([low, high])}${words.suffix}${by}`;
  if (reason === "outside") return `${reach}, ${target}${words.suffix} is outside`;
  return `${reach} but jumps over ${target}${words.suffix}${jump === jump ? ` at ${place([jump])}` : ""}`;
}

function foundHTML(words, verdict) {
  const unknown = (x, digits) => amounts([x], words.unknown_factor, digits)[0] + words.unknown_suffix;
  const between = ends => spanOf(amounts(ends, words.unknown_factor)) + words.unknown_suffix;
  const reason = reasonFor(words, verdict), on = words.branch && ` on branch ${words.branch}`;
  const roots = verdict.roots.map(root => unknown(root.value, 6)).join("; ");
  const rows = [["condition", `${words.quantity} = ${amounts([verdict.equals], words.factor)[0]}${words.suffix}${on}`]];
  if (!reason) {
    rows.push(["residual", amounts([Math.abs(verdict.residual)], words.factor, 2)[0] + words.suffix]);
    const [low, high] = verdict.bracket;
    rows.push(["bracket", `${amounts([high - low], words.unknown_factor, 2)[0]}${words.unknown_suffix} wide`]);
  }
  rows.push([`roots by ${verdict.samples} samples`, roots ? roots + on : "none"]);
  if (verdict.interval.every(Number.isFinite)) rows.push(["searched", between(verdict.interval)]);
  rows.push(["evaluations", verdict.evaluations]);
  const head = reason ? words.unknown : inWords(`${words.unknown} = ${unknown(verdict.value, 6)}`);
  return `<div><span class="ms-badge ms-${reason ? "FAIL" : "PASS"}">${reason ? "not found" : "found"}</span> <b>${head}</b></div>` +
    (reason && `<div>${reason}</div>`) +
    `<table>${rows.map(([what, text]) => `<tr><th>${what}</th><td>${inWords(text)}</td></tr>`).join("")}</table>`;
}
