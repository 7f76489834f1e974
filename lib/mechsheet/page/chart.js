// Charts under the pointer: moving positions, all values where it is, and the part of the axes that is dragged out.
(() => {
  if (customElements.get("ms-figure")) return;

  // Shown in every chart by a variable of its own: a style sheet for all would be read again whole.
  const marks = new Map();

  function mark(chart) {
    marks.forEach((at, name) => chart?.style.setProperty(name, at));
  }

  class Marks extends HTMLElement {
    static observedAttributes = ["at"];

    attributeChangedCallback() {
      this.getAttribute("at").split(";").forEach((each) => marks.set(...each.split(":")));
      document.querySelectorAll("svg.ms-chart").forEach(mark);
    }
  }
  customElements.define("ms-marks", Marks);

  const MOST = 20; // times that a part is enlarged: tenths of a pixel, in which curves are drawn, are not seen then
  const LEAST = 8; // px that are dragged on purpose
  const parts = new Map(); // of the axes, by the caption of the figure: a part stays while the page is open

  const plotOf = (chart) => chart.querySelector("svg");
  const sizeOf = (plot) => ["width", "height"].map((name) => Number(plot.getAttribute(name)));
  const told = (chart) => JSON.parse(chart.dataset.values);

  // A chart of which a part is shown stays as it is, and is hidden behind the copy that shows it.
  class Figure extends HTMLElement {
    connectedCallback() {
      const watched = { childList: true, subtree: true, attributes: true, attributeFilter: ["data-values", "d"] };
      const changes = new MutationObserver(() => show());
      const show = () => {
        this.show();
        this.querySelectorAll("svg.ms-chart").forEach(mark);
        changes.takeRecords();
      };
      changes.observe(this, watched);
      this.redraw = show;
      show();
    }

    get whole() {
      return this.querySelector("svg.ms-chart.ms-chosen") ?? this.querySelector("svg.ms-chart:not(.ms-part)");
    }

    get name() {
      return this.querySelector(".ms-caption")?.id;
    }

    show() {
      const [whole, part] = [this.whole, parts.get(this.name)];
      this.querySelectorAll(":scope > .ms-part").forEach((each) => each.remove());
      this.toggleAttribute("enlarged", Boolean(whole && part));
      if (!whole || !part) return;
      const copy = whole.cloneNode(true);
      copy.classList.add("ms-part");
      copy.classList.remove("ms-chosen");
      this.firstElementChild.after(copy, back(this));
      enlarge(copy, part);
    }
  }
  customElements.define("ms-figure", Figure);

  function back(figure) {
    const button = document.createElement("button");
    button.className = "ms-part ms-screen";
    button.textContent = "part of the axes: show the whole";
    button.onclick = () => choose(figure, undefined);
    return button;
  }

  function choose(figure, part) {
    if (part) parts.set(figure.name, part);
    else parts.delete(figure.name);
    figure.redraw();
  }

  // Parts are kept in the units of the axes as declared, whose ends may move: here where they lie in the plot.
  function inPlot(chart, part) {
    return told(chart).axes.map(({ low, high, factor }, up) => {
      const [from, to] = part[up].map((x) => (x * factor - low) / (high - low));
      return up ? [1 - to, 1 - from] : [from, to];
    });
  }

  function enlarge(chart, part) {
    const plot = plotOf(chart);
    const [width, height] = sizeOf(plot);
    const [[left, right], [top, bottom]] = inPlot(chart, part);
    const view = [left * width, top * height, (right - left) * width, (bottom - top) * height];
    const [x, y] = [right - left, bottom - top]; // what a length in the plot is to be multiplied by to stay as it is
    plot.setAttribute("viewBox", view.join(" "));
    plot.setAttribute("preserveAspectRatio", "none");
    const still = (element, u, from, to) =>
      element.setAttribute("transform", `translate(${u} ${to}) scale(${x} ${y}) translate(${-u} ${-from})`);
    plot.querySelectorAll("path").forEach((path) => path.setAttribute("vector-effect", "non-scaling-stroke"));
    plot.querySelectorAll("circle").forEach((dot) => {
      const [u, v] = ["cx", "cy"].map((name) => dot.getAttribute(name));
      still(dot, u, v, v);
    });
    plot.querySelectorAll("text").forEach((text) => still(text, text.getAttribute("x"), 0, view[1]));
    told(chart).axes.forEach(({ low, high, power, unit, factor }, up) => {
      const ends = part[up].map((end) => end * factor);
      const length = up ? height : width;
      const axis = axisOf([ends], unit, up ? 6 : 8);
      const at = axis.ticks.filter((t) => t >= ends[0] - 1e-9 * axis.step && t <= ends[1] + 1e-9 * axis.step);
      const places = at.map((t) => (length * (t - low)) / (high - low));
      const texts = at.map((t) => axis.text(t, power));
      customElements.get("ms-axes").along(chart, up, { at: up ? places.map((u) => length - u) : places, texts });
    });
  }

  // A place in the window as parts of the axes, in the units as declared; and back, as one of the picture.
  function partAt(chart, event) {
    const plot = plotOf(chart);
    const [box, { x, y, width, height }] = [plot.getScreenCTM().inverse(), plot.viewBox.baseVal];
    const point = new DOMPoint(event.clientX, event.clientY).matrixTransform(box);
    const inside = [Math.min(Math.max(point.x, x), x + width), Math.min(Math.max(point.y, y), y + height)];
    return told(chart).axes.map(({ low, high, factor }, up) => {
      const part = inside[up] / sizeOf(plot)[up];
      return (low + (up ? 1 - part : part) * (high - low)) / factor;
    });
  }

  const wholePart = (chart) => told(chart).axes.map(({ low, high, factor }) => [low / factor, high / factor]);

  // A part as it may be shown: within the axes, and not too small.
  function shownPart(chart, ends) {
    return wholePart(chart).map(([low, high], up) => {
      const size = Math.max(Math.abs(ends[up][1] - ends[up][0]), (high - low) / MOST);
      const middle = (ends[up][0] + ends[up][1]) / 2;
      const from = Math.max(low, Math.min(high - size, middle - size / 2));
      return size >= high - low ? [low, high] : [from, from + size];
    });
  }

  const isWhole = (chart, part) => wholePart(chart).every(([low, high], up) => part[up][1] - part[up][0] >= (1 - 1e-9) * (high - low));

  function take(chart, ends) {
    const part = shownPart(chart, ends);
    choose(chart.closest("ms-figure"), isWhole(chart, part) ? undefined : part);
  }

  const frame = document.createElement("div");
  frame.className = "ms-dragged";
  let drag; // the chart, where it began, and the rectangle in the window

  const chartOf = (event) => {
    const chart = event.target.closest?.("ms-figure svg.ms-chart");
    return chart?.dataset.values ? chart : null;
  };

  document.addEventListener("mousedown", (event) => {
    const chart = event.button ? null : chartOf(event);
    if (!chart) return;
    event.preventDefault(); // nothing is selected
    drag = { chart, event };
  });

  document.addEventListener("mousemove", (event) => {
    if (!drag) return;
    if (!event.buttons) return end();
    const { left, right, top, bottom } = plotBox(drag.chart);
    const [wide, high] = [event.clientX - drag.event.clientX, event.clientY - drag.event.clientY].map(Math.abs);
    if (Math.max(wide, high) < LEAST) return frame.remove();
    const within = (a, b, low, high) => [Math.max(low, Math.min(a, b)), Math.min(high, Math.max(a, b))];
    const [x0, x1] = wide < LEAST ? [left, right] : within(drag.event.clientX, event.clientX, left, right);
    const [y0, y1] = high < LEAST ? [top, bottom] : within(drag.event.clientY, event.clientY, top, bottom);
    Object.assign(frame.style, { left: `${x0}px`, top: `${y0}px`, width: `${x1 - x0}px`, height: `${y1 - y0}px` });
    document.body.append(frame);
    drag.corners = [{ clientX: x0, clientY: y1 }, { clientX: x1, clientY: y0 }];
  });

  document.addEventListener("mouseup", () => {
    const { chart, corners } = drag ?? {};
    const taken = corners && frame.isConnected && chart.isConnected;
    end();
    if (!taken) return;
    const [from, to] = corners.map((corner) => partAt(chart, corner));
    take(chart, from.map((low, up) => [low, to[up]]));
  });

  function end() {
    frame.remove();
    drag = undefined;
  }

  // The plot in the window.
  function plotBox(chart) {
    const { left, top } = chart.getBoundingClientRect();
    const [plot, scale] = [plotOf(chart), scaleOf(chart)];
    const [x, y] = ["x", "y"].map((name) => Number(plot.getAttribute(name)) * scale);
    const [width, height] = sizeOf(plot).map((length) => length * scale);
    return { left: left + x, right: left + x + width, top: top + y, bottom: top + y + height };
  }

  const scaleOf = (chart) => chart.getBoundingClientRect().width / chart.viewBox.baseVal.width;

  document.addEventListener("dblclick", (event) => {
    const figure = chartOf(event)?.closest("ms-figure");
    if (figure) choose(figure, undefined);
  });

  // With Ctrl, as the browser enlarges a page, or by two fingers: a wheel alone moves the page.
  document.addEventListener(
    "wheel",
    (event) => {
      const chart = event.ctrlKey ? chartOf(event) : null;
      if (!chart) return;
      event.preventDefault();
      const now = parts.get(chart.closest("ms-figure").name) ?? wholePart(chart);
      const factor = Math.exp(Math.max(-0.3, Math.min(0.3, event.deltaY / 300)));
      const at = partAt(chart, event);
      take(chart, now.map((ends, up) => ends.map((end) => at[up] + factor * (end - at[up]))));
    },
    { passive: false },
  );

  // Values of a chart where the pointer is: of all its curves.
  let shown; // the values of a chart and their text

  document.addEventListener("pointermove", (event) => {
    const chart = drag ? null : event.target.closest?.("svg.ms-chart");
    if (!chart) {
      tip.hidden = true;
      return;
    }
    const text = chart.dataset.values;
    if (shown?.text !== text) shown = { text, ...JSON.parse(text) };
    const { left, right } = plotBox(chart);
    const plot = plotOf(chart);
    const { x, width } = plot.viewBox.baseVal;
    const corner = Number(plot.getAttribute("x"));
    const inWindow = (at) => left + ((at - corner - x) / width) * (right - left);
    let [best, near] = [-1, Infinity];
    shown.at.forEach((at, i) => {
      const u = at === null ? NaN : inWindow(at);
      if (u < left - 1 || u > right + 1 || !(Math.abs(u - event.clientX) < near)) return;
      [best, near] = [i, Math.abs(u - event.clientX)];
    });
    tip.hidden = best < 0;
    if (best < 0) return;
    tip.innerHTML = shown.names
      .map((name, i) => `<div>${name} = ${shown.texts[i][best]} ${shown.units[i]}</div>`)
      .join("");
    place(inWindow(shown.at[best]), event.clientY);
  });
})();
