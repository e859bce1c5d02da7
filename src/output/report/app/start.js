// Wires up the controls and starts the 3D view.

const dark = matchMedia("(prefers-color-scheme: dark)");
function setTheme(name) {
  root.dataset.theme = name;
  viewer?.theme();
  plotAll();
}
$("theme").addEventListener("click", () => setTheme(root.dataset.theme === "dark" ? "light" : "dark"));
dark.addEventListener("change", (e) => setTheme(e.matches ? "dark" : "light"));

let before = "light";
addEventListener("beforeprint", () => {
  before = root.dataset.theme;
  plotted = true;
  setTheme("light");
});
addEventListener("afterprint", () => setTheme(before));

for (const [i] of scene.skeleton.branches.entries()) $("branch").append(new Option(`${i + 1}`, String(i)));
$("branch").addEventListener("change", plotBranch);

const layers = document.querySelectorAll("input[data-layer]");
for (const box of layers) box.addEventListener("change", () => viewer?.show(box.dataset.layer, box.checked));
document.querySelector("[data-needs=peers]").hidden = scene.peers.length === 0;
for (const button of document.querySelectorAll("[data-look]")) button.addEventListener("click", () => viewer?.look(button.dataset.look));
for (const button of document.querySelectorAll("[data-finding]")) {
  button.addEventListener("click", () => viewer?.mark(scene.findings[Number(button.dataset.finding)]));
}
$("colour").addEventListener("change", () => {
  colours = colouring($("colour").value);
  showLegend(colours);
  viewer?.paint(colours.beams, chosen);
});
showLegend(colours);
setTheme(dark.matches ? "dark" : "light");
// Words and tables are on the screen before the 3D view, which takes its time without a graphics card.
requestAnimationFrame(() => setTimeout(() => {
  viewer = makeViewer();
  for (const box of layers) viewer?.show(box.dataset.layer, box.checked);
  viewer?.paint(colours.beams, chosen);
  viewer?.theme();
}));
new IntersectionObserver((entries, watch) => {
  if (!entries.some((e) => e.isIntersecting)) return;
  watch.disconnect();
  plotted = true;
  plotAll();
}, { rootMargin: "50%" }).observe($("plots"));
let settled;
addEventListener("resize", () => {
  clearTimeout(settled);
  settled = setTimeout(plotAll, 150);
});
