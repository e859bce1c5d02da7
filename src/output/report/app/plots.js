// Plots, drawn once they come near the screen.

const plots = {};
/** Whether the plots have come near the screen: before that nothing is drawn. */
let plotted = false;

/** Draws a plot into its place, in the colours of the theme and as wide as there is room. */
function plot(id, options, data) {
  if (!plotted) return;
  plots[id]?.destroy();
  const host = $(id);
  const axis = { values: (u, ticks) => ticks.map(figure), stroke: style("--soft"), grid: { stroke: style("--line"), width: 1 }, ticks: { stroke: style("--line"), width: 1 } };
  const axes = options.axes.map((own) => ({ ...axis, ...own }));
  plots[id] = new Vendor.uPlot({ width: Math.max(host.clientWidth, 240), height: 230, scales: { x: { time: false } }, ...options, axes }, data, host);
}

function branchData(branch) {
  const { points: places, areas, radii } = scene.skeleton;
  const ids = scene.skeleton.branches[branch];
  let way = 0;
  const along = ids.map((p, i) => (i ? (way += Math.hypot(...places[p].map((x, k) => x - places[ids[i - 1]][k]))) : 0));
  return [along, ids.map((p) => areas[p]), ids.map((p) => radii[p])];
}

function plotBranch() {
  const branch = Number($("branch").value);
  if (!scene.skeleton.branches[branch]) return;
  plot("plot-branch", {
    scales: { x: { time: false }, area: { range: (u, low, high) => [0, 1.1 * high || 1] }, radius: { range: (u, low, high) => [0, 1.1 * high || 1] } },
    series: [
      { label: "from the start, mm", value: (u, v) => figure(v) },
      { label: "area, mm²", scale: "area", stroke: "#0072b2", width: 2, spanGaps: true, points: { show: true, size: 4 }, value: (u, v) => figure(v) },
      { label: "radius, mm", scale: "radius", stroke: "#d55e00", width: 2, spanGaps: true, points: { show: true, size: 4 }, value: (u, v) => figure(v) },
    ],
    axes: [{ label: "from the start, mm" }, { scale: "area", label: "area, mm²", size: 60 }, { scale: "radius", side: 1, label: "radius, mm", grid: { show: false } }],
  }, branchData(branch));
}

function showBranch(branch) {
  $("branch").value = String(branch);
  plotBranch();
}

const BINS = 20;
function plotOffsets() {
  const known = scene.skeleton.offsets.filter((x) => x !== null);
  const top = Math.max(...known, 1e-6);
  const counts = new Array(BINS).fill(0);
  for (const x of known) counts[Math.min(Math.floor((x / top) * BINS), BINS - 1)]++;
  const middles = counts.map((_, i) => ((i + 0.5) * top) / BINS);
  plot("plot-offset", bars("offset, radii", "points", "#009e73", [0, top]), [middles, counts]);
}

function plotErrors() {
  const errors = scene.beams.map((b) => (b.error === null ? null : 100 * b.error));
  const options = bars("beam", "error, %", "#cc79a7", [0.4, errors.length + 0.6]);
  options.series[0].value = (u, v) => scene.beams[v - 1]?.mark ?? "–";
  // There is no beam two and a half.
  options.axes[0].incrs = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000];
  plot("plot-error", options, [errors.map((_, i) => i + 1), errors]);
}

function bars(x, y, colour, range) {
  return {
    scales: { x: { time: false, range }, y: { range: (u, low, high) => [0, 1.1 * high || 1] } },
    series: [
      { label: x, value: (u, v) => figure(v) },
      { label: y, stroke: colour, fill: colour, paths: Vendor.uPlot.paths.bars({ size: [0.85, 60] }), points: { show: false }, value: (u, v) => figure(v) },
    ],
    axes: [{ label: x }, { label: y, size: 60 }],
  };
}

function plotAll() {
  plotBranch();
  plotOffsets();
  plotErrors();
}
