// Inputs that differ from the document's own as texts: in an address, and as a scene file.
const addressOf = given => given.map(({name, text}) => `${name}=${encodeURIComponent(text)}`).join("&");

function textsIn(hash) {
  const parts = hash.slice(1).split("&").filter(part => part.includes("="));
  return new Map(parts.map(part => {
    const at = part.indexOf("=");
    try {
      return [part.slice(0, at), decodeURIComponent(part.slice(at + 1))];
    } catch {
      return [part.slice(0, at), part.slice(at + 1)]; // a percent sign as it stands
    }
  }));
}

// Numbers in display units, texts in quotes.
function sceneText(given) {
  const quoted = text => JSON.stringify(text).replaceAll("\u007f", "\\u007f");
  const lines = given.map(({name, kind, text}) => {
    const number = kind === "number" && /^[+-]?\d+(\.\d+)?([eE][+-]?\d+)?$/.test(text);
    if (kind === "switch") return `${name} = ${text === "yes"}`;
    return `${name} = ${number ? text : quoted(text)}`;
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
