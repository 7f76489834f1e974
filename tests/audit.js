// What keeps someone from reading or using a page: each fault as a text, none of a page that is well.
() => {
  const faults = new Set(), all = selector => [...document.querySelectorAll(selector)];
  const seen = e => e.checkVisibility({visibilityProperty: true});
  const words = elements => elements.map(e => e?.textContent ?? "").join(" ");
  const others = e => (e.getAttribute("aria-labelledby") ?? "").split(" ").map(id => document.getElementById(id));
  const named = e => (e.ariaLabel || words(others(e)).trim() || words([...(e.labels ?? [])]) || e.textContent).trim();
  const what = e => `${e.localName}${e.id && `#${e.id}`}${e.classList.length ? `.${[...e.classList].join(".")}` : ""}`;

  if (!document.documentElement.lang) faults.add("no language");
  if (!document.title.trim()) faults.add("no title");
  if (all("h1").length !== 1) faults.add(`${all("h1").length} headings of the first level`);
  if (!document.querySelector("main")) faults.add("no main part");
  const ids = all("[id]").map(e => e.id);
  ids.filter((id, n) => ids.indexOf(id) < n).forEach(id => faults.add(`two elements are called ${id}`));
  for (const e of all("[aria-describedby]")) {
    for (const id of e.getAttribute("aria-describedby").split(" ")) if (!document.getElementById(id)) faults.add(`${what(e)} is described by nothing`);
  }
  for (const e of all("a[href^='#']")) if (!document.getElementById(decodeURIComponent(e.hash.slice(1)))) faults.add(`${e.hash} leads nowhere`);
  for (const e of all("input, select, textarea, button, a, summary, [role], [tabindex]")) {
    if (seen(e) && !named(e) && !["status", "alert", "tooltip", "img"].includes(e.role)) faults.add(`${what(e)} has no name`);
  }
  const {scrollWidth} = document.documentElement;
  if (scrollWidth > innerWidth) faults.add(`the page is ${scrollWidth} px wide in a window of ${innerWidth}`);
  let level = 0;
  for (const e of all("h1, h2, h3, h4, h5, h6")) {
    const own = Number(e.localName[1]);
    if (own > level + 1) faults.add(`${e.innerText} skips a level`);
    level = own;
  }
  for (const e of all("main svg:not(svg svg)")) {
    const image = e.closest("[role=img]");
    if (seen(e) && !(image && (image.ariaLabel || words(others(image)).trim()))) faults.add(`${what(e)} has no name`);
  }

  // How a text stands out from what is behind it: relative luminance as WCAG has it.
  const part = c => (c / 255 <= 0.04045 ? c / 255 / 12.92 : ((c / 255 + 0.055) / 1.055) ** 2.4);
  const light = ([r, g, b]) => 0.2126 * part(r) + 0.7152 * part(g) + 0.0722 * part(b);
  const colour = text => (([r, g, b, a = 1]) => [r, g, b, a])(text.match(/[\d.]+/g).map(Number));
  const over = ([r, g, b, a], under) => [r, g, b].map((c, k) => c * a + under[k] * (1 - a));
  const behind = e => {
    const own = colour(getComputedStyle(e).backgroundColor);
    return own[3] === 1 ? own : over(own, e.parentElement ? behind(e.parentElement) : [255, 255, 255]);
  };
  const faint = e => (e ? Number(getComputedStyle(e).opacity) * faint(e.parentElement) : 1);
  const texts = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  for (let text; (text = texts.nextNode()); ) {
    const e = text.parentElement;
    if (!text.data.trim() || e.closest("script, style, template") || !seen(e)) continue;
    const style = getComputedStyle(e), under = behind(e), own = colour(e.closest("svg") ? style.fill : style.color);
    const shown = over([...own.slice(0, 3), own[3] * faint(e)], under);
    const [low, high] = [light(shown), light(under)].sort((a, b) => a - b);
    const contrast = (high + 0.05) / (low + 0.05);
    if (contrast < 4.5) faults.add(`${contrast.toFixed(2)}:1 ${what(e)} in ${what(e.parentElement)}`);
  }
  return [...faults];
}
