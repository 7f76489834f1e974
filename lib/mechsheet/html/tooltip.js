// A box with words, beside the pointer and within the window.
const tip = document.createElement("div");
tip.className = "ms-tip";
tip.hidden = true;
tip.setAttribute("role", "tooltip");

function place(x, y) {
  if (!tip.isConnected) document.body.append(tip);
  tip.hidden = false;
  const [wide, high] = [tip.offsetWidth, tip.offsetHeight];
  tip.style.left = `${Math.max(4, x + 14 + wide > innerWidth ? x - 14 - wide : x + 14)}px`;
  tip.style.top = `${y + 14 + high > innerHeight ? Math.max(4, y - 14 - high) : y + 14}px`;
}
