// What the address says holds from the beginning.
sum();
if (location.hash.includes("=")) readAddress();
refresh();
document.body.dataset.ready = "";
