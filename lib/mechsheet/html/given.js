// Inputs that differ from the document's own as texts: in an address, and as a scene file.
const addressOf = given => given.map(({name, text}) => [name, text].map(encodeURIComponent).join("=")).join("&");

function textsIn(hash) {
  const decoded = text => {
    try {
      return decodeURIComponent(text.replace(/%(?![\da-f]{2})/gi, "%25")); // a percent sign as it stands
    } catch {
      return text;
    }
  };
  const parts = hash.slice(1).split("&").filter(part => part.includes("="));
  return new Map(parts.map(part => {
    const at = part.indexOf("=");
    return [decoded(part.slice(0, at)).normalize("NFKC"), decoded(part.slice(at + 1))]; // as Python reads a name
  }));
}

// Why no input takes what an address gives, by its names; `options` are the texts that an input may have, if not any.
function strange(given, options) {
  const why = (name, text) => {
    if (!options.has(name)) return `there is no input ${name}`;
    return options.get(name)?.includes(text) === false ? `${name} has no option ${text}` : "";
  };
  return new Map([...given].map(([name, text]) => [name, why(name, text)]).filter(([, told]) => told));
}

// Numbers in display units, texts in quotes.
function sceneText(given) {
  const quoted = text => JSON.stringify(text).replaceAll("\u007f", "\\u007f");
  const lines = given.map(({name, kind, text}) => {
    const number = kind === "number" && /^[+-]?\d+(\.\d+)?([eE][+-]?\d+)?$/.test(text);
    const value = kind === "switch" ? text === "yes" : number ? text : quoted(text);
    return `${/^\w+$/.test(name) ? name : quoted(name)} = ${value}`;
  });
  return `[inputs]\n${lines.join("\n")}\n`;
}

function saveScene(name, given) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([sceneText(given)], {type: "application/toml"}));
  link.download = `${name}.toml`;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}
