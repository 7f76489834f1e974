// What the page does by itself: numbers in formulas, the verdict in sight, play buttons, what is copied from tables.
(() => {
  if (customElements.get("ms-numbers")) return;

  // The switch may be set before this script is there.
  const withNumbers = () => document.querySelector(".ms-switch")?.checked;

  // The formula once more with numbers for its symbols; there only while the reader asks for them.
  class Numbers extends HTMLElement {
    static observedAttributes = ["formula"];

    connectedCallback() {
      this.show();
    }

    attributeChangedCallback() {
      if (this.isConnected) this.show();
    }

    show() {
      this.innerHTML = withNumbers() ? this.getAttribute("formula") : "";
    }
  }
  customElements.define("ms-numbers", Numbers);

  // Font and style of formulas, which the page in one file has in it.
  class Formulas extends HTMLElement {
    connectedCallback() {
      if (document.querySelector("style.ms-of-formulas")) return;
      const style = document.createElement("style");
      Object.assign(style, { className: "ms-of-formulas", textContent: this.getAttribute("css") });
      document.head.append(style);
      document.fonts.add(new FontFace("STIX Two Math", `url(${this.getAttribute("font")})`));
    }
  }
  customElements.define("ms-formulas", Formulas);

  // The style of a worksheet that names no style sheet, as marimo would have it in the page: it reaches formulas too.
  class Style extends HTMLElement {
    connectedCallback() {
      if (document.querySelector("style.ms-style")) return;
      const style = document.createElement("style");
      Object.assign(style, { className: "ms-style", title: "marimo-custom", textContent: this.getAttribute("css") });
      document.head.append(style);
    }
  }
  customElements.define("ms-style", Style);

  // The verdict stays in sight: of a page long enough to lose it, a bar tells it wherever one reads.
  const bar = document.createElement("div");
  bar.className = "ms-bar";
  bar.role = "status";

  class InBar extends HTMLElement {
    static observedAttributes = ["bar"];

    connectedCallback() {
      this.seen = new IntersectionObserver(([{ isIntersecting }]) => {
        this.isSeen = isIntersecting;
        InBar.show();
      });
      this.seen.observe(this);
      InBar.show();
    }

    disconnectedCallback() {
      this.seen.disconnect();
      InBar.show();
    }

    attributeChangedCallback() {
      InBar.show();
    }

    // What failed first, then what was not found; nothing as long as all of it is in sight.
    static show() {
      const all = ["ms-failed", "ms-unfound", "ms-verdict"].map((kind) => [...document.querySelectorAll(kind)]);
      const [failed, unfound, verdicts] = all;
      const told = [...failed.slice(0, 1), ...unfound.slice(0, 1), ...verdicts];
      bar.hidden = told.every(({ isSeen }) => isSeen ?? true);
      bar.innerHTML = bar.hidden ? "" : told.map((each) => each.getAttribute("bar")).join("");
      if (told.length) document.body.append(bar);
      else bar.remove();
    }
  }
  customElements.define("ms-verdict", class extends InBar {});
  customElements.define("ms-failed", class extends InBar {});
  customElements.define("ms-unfound", class extends InBar {});

  document.addEventListener("change", (event) => {
    if (!event.target.matches(".ms-switch")) return;
    document.querySelectorAll("ms-numbers").forEach((line) => line.show());
  });

  // marimo marks every output while its cell runs. As long as a style sheet asks for [class~="x"], each such mark makes the
  // browser style all that stands below again; the same selector as .x does not.
  function selectByClass() {
    const roots = [document, ...[...document.querySelectorAll("*")].map((e) => e.shadowRoot).filter(Boolean)];
    const within = (rules) =>
      [...rules].forEach((rule) => {
        if (rule.selectorText?.includes("[class~="))
          rule.selectorText = rule.selectorText.replace(/\[class~="([\w-]+)"\]/g, ".$1");
        if (rule.cssRules?.length) within(rule.cssRules);
      });
    new Set(roots.flatMap((root) => [...root.styleSheets, ...root.adoptedStyleSheets])).forEach((sheet) => {
      if (!sheet.href || sheet.href.startsWith(location.origin)) within(sheet.cssRules); // others cannot be read
    });
  }

  selectByClass();

  // marimo's controls have their labels beside them: a screen reader would say a number alone. They are drawn when they
  // are, late and more than once.
  function call(host) {
    const control = host.shadowRoot?.querySelector("[role=slider], input, select, textarea");
    if (!control || control.ariaLabel) return;
    const label = document.createElement("div");
    label.innerHTML = JSON.parse(host.dataset.label) ?? "";
    if (label.textContent) control.ariaLabel = label.textContent;
  }
  let calling;
  const drawn = new MutationObserver(() => (calling ??= setTimeout(callAll, 100)));
  function callAll() {
    calling = undefined;
    document.querySelectorAll("marimo-ui-element > [data-label]").forEach((host) => {
      call(host);
      if (host.shadowRoot) drawn.observe(host.shadowRoot, { childList: true, subtree: true });
    });
    document.dispatchEvent(new Event("ms-drawn"));
  }
  drawn.observe(document.body, { childList: true, subtree: true });

  // A server that was started anew takes nothing from a page of before: its numbers would be of other inputs than it shows.
  const refused = ({ responseStatus, name }) => responseStatus === 401 && name.startsWith(`${location.origin}/`);
  new PerformanceObserver((seen) => {
    if (!seen.getEntries().some(refused) || document.querySelector(".ms-anew")) return;
    const anew = document.createElement("div");
    Object.assign(anew, { className: "ms-written ms-anew", role: "alert" });
    anew.textContent = "the server was started anew: this page computes nothing until it is loaded again ";
    Object.assign(anew.style, { top: "1em", bottom: "auto" }); // below, marimo tells that it was refused
    const again = document.createElement("button");
    again.textContent = "load again";
    again.addEventListener("click", () => location.reload());
    anew.append(again);
    document.body.append(anew);
  }).observe({ type: "resource" });

  // Cells out of sight are laid out once, so that the browser knows their heights and the outline leads to its places.
  const page = document.documentElement;

  function measure() {
    selectByClass();
    page.classList.add("ms-measure");
    requestAnimationFrame(() =>
      requestAnimationFrame(() => {
        page.classList.remove("ms-measure");
        page.dataset.measured = "";
        document.dispatchEvent(new Event("ms-measured"));
      }),
    );
  }

  let quiet = setTimeout(measure, 1000);
  const awaited = new MutationObserver(() => {
    clearTimeout(quiet);
    quiet = setTimeout(() => (awaited.disconnect(), measure()), 1000);
  });
  awaited.observe(document.body, { childList: true, subtree: true });

  // Play: the slider is moved by its own keys, so that everything that hangs on it follows as under the hand.
  const TICK = 50; // ms
  const playing = new Map();

  function play(button) {
    const thumb = button.parentElement.querySelector("marimo-slider")?.shadowRoot?.querySelector("[role=slider]");
    if (!thumb) return stop(button);
    const at = Number(thumb.ariaValueNow ?? thumb.getAttribute("aria-valuenow"));
    const [low, high] = ["aria-valuemin", "aria-valuemax"].map((name) => Number(thumb.getAttribute(name)));
    const run = playing.get(button);
    let key = run.back ? "ArrowLeft" : "ArrowRight";
    if (at >= high && !run.back) {
      run.back = !("turning" in button.dataset);
      key = run.back ? "ArrowLeft" : "Home";
    } else if (at <= low && run.back) {
      run.back = false;
      key = "ArrowRight";
    }
    thumb.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true, composed: true }));
  }

  function stop(button) {
    clearInterval(playing.get(button)?.timer);
    playing.delete(button);
    button.textContent = "▶";
    button.ariaLabel = "play";
  }

  document.addEventListener("click", (event) => {
    const button = event.target.closest(".ms-play");
    if (!button) return;
    if (playing.has(button)) return stop(button);
    const timer = setInterval(() => (button.isConnected ? play(button) : stop(button)), TICK);
    playing.set(button, { timer, back: false });
    button.textContent = "❚❚";
    button.ariaLabel = "pause";
  });

  // Copied from a table, a minus is a hyphen: a spreadsheet reads no other.
  document.addEventListener("copy", (event) => {
    const selection = getSelection();
    if (!selection.anchorNode?.parentElement?.closest(".ms-table")) return;
    const copy = document.createElement("div");
    copy.append(selection.getRangeAt(0).cloneContents());
    event.clipboardData.setData("text/plain", selection.toString().replaceAll("−", "-"));
    event.clipboardData.setData("text/html", copy.innerHTML.replaceAll("−", "-"));
    event.preventDefault();
  });
})();
