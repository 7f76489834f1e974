// Above the page the sections are listed on request.
document.querySelector("nav details").open = matchMedia("(width >= 62em)").matches;
// What the address says holds from the beginning.
sum();
if (location.hash.includes("=")) readAddress();
refresh();
document.body.dataset.ready = "";
