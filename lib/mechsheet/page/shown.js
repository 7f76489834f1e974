// A value as HTML in an attribute: the browser reads it itself, and of what is there only what differs is changed.
(() => {
  if (customElements.get("ms-shown")) return;

  // Each node that was read knows the one that stands in the page for it, beside which scripts may have put others.
  function pair(read, shown) {
    read.shown = shown;
    let [part, made] = [read.firstChild, shown.firstChild];
    for (; part; part = part.nextSibling, made = made.nextSibling) pair(part, made);
  }

  function placed(read) {
    const made = document.importNode(read, true);
    pair(read, made);
    return made;
  }

  // marimo's own elements, such as a formula, read what stands in them once.
  const stays = (was, now) => was.nodeName === now.nodeName && !was.nodeName.startsWith("MARIMO-");

  function follow(was, now) {
    const { shown } = was;
    now.shown = shown;
    if (now.nodeType !== Node.ELEMENT_NODE) {
      if (was.data !== now.data) shown.data = now.data;
      return;
    }
    if (was.hasAttributes() || now.hasAttributes()) {
      for (const name of now.getAttributeNames()) {
        const value = now.getAttribute(name);
        if (was.getAttribute(name) !== value) shown.setAttribute(name, value);
      }
      for (const name of was.getAttributeNames()) if (!now.hasAttribute(name)) shown.removeAttribute(name);
    }
    followIn(shown, was, now);
  }

  function followIn(shown, was, now) {
    let [old, node, last] = [was.firstChild, now.firstChild, null]; // behind the last one is put what is new
    while (node) {
      const next = old && old.nextSibling;
      if (old && old.isEqualNode(node)) {
        node.replaceWith(old); // it knows what stands for it, and all in it does
        node = old;
      } else if (old && stays(old, node)) follow(old, node);
      else if (old) old.shown.replaceWith(placed(node));
      else if (last) last.after(placed(node));
      else shown.prepend(placed(node));
      [last, node, old] = [node.shown, node.nextSibling, next];
    }
    for (; old; old = old.nextSibling) old.shown.remove();
  }

  class Shown extends HTMLElement {
    static observedAttributes = ["html"];

    attributeChangedCallback(_name, _before, html) {
      const template = document.createElement("template");
      template.innerHTML = html;
      this.place ??= this.appendChild(document.createElement("div")); // as marimo has a value in one
      followIn(this.place, this.was ?? document.createDocumentFragment(), template.content);
      this.was = template.content;
    }
  }
  customElements.define("ms-shown", Shown);
})();
