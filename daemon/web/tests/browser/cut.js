// Texts that do not fit: cut off by a box that hides what is beyond it, beyond the edge of the screen, or below another box.
const hides = (style) => [style.overflowX, style.overflowY].some((value) => ["hidden", "clip"].includes(value));
const scrolls = (style) => [style.overflowX, style.overflowY].some((value) => ["auto", "scroll"].includes(value));
const cut = [];
const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
for (let node = walker.nextNode(); node; node = walker.nextNode()) {
  const own = node.parentElement;
  if (!node.data.trim() || own.closest(".sr, [hidden], .skip, option, svg, script") || !own.getClientRects().length) continue;
  const range = document.createRange();
  range.selectNodeContents(node);
  const at = range.getBoundingClientRect();
  if (at.width === 0) continue;
  let box = null;
  for (let above = own; above && !box; above = above.parentElement) {
    const style = getComputedStyle(above);
    // what only assistive technology reads is cut off on purpose
    if (style.clipPath !== "none") box = "scrolls";
    else if (above !== document.body && scrolls(style)) box = "scrolls";
    else if (above !== document.body && hides(style)) box = above.getBoundingClientRect();
  }
  if (box === "scrolls") continue;
  const right = Math.min(box?.right ?? Infinity, document.documentElement.clientWidth);
  const bottom = box?.bottom ?? Infinity;
  if (at.right > right + 1 || at.bottom > bottom + 2 || at.left < (box?.left ?? 0) - 1) {
    cut.push(`${own.tagName}.${own.className} #${own.closest("[id]")?.id} "${node.data.trim().slice(0, 40)}"`);
  }
}
// boxes of a view that lie upon each other
const tiles = [...document.querySelectorAll(".b-tile, .d-tile, .card")].filter((tile) => tile.getClientRects().length > 0);
tiles.forEach((tile, k) => {
  const own = tile.getBoundingClientRect();
  for (const other of tiles.slice(k + 1).map((one) => one.getBoundingClientRect())) {
    const wide = Math.min(own.right, other.right) - Math.max(own.left, other.left);
    const high = Math.min(own.bottom, other.bottom) - Math.max(own.top, other.top);
    if (wide > 1 && high > 1) cut.push(`${tile.className} lies upon another`);
  }
});
return cut;
