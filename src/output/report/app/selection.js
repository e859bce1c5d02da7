// Beams and pieces are chosen everywhere at once.

const rows = [...document.querySelectorAll("tr[data-beam]")];
let chosen = [];
let colours = colouring("profile");

/** Beams of each piece of the cut list, and all that shows it: its row and its places on bars. */
const pieces = new Map();
const beamOf = new Map(scene.beams.map((b, i) => [b.mark, i]));
for (const row of document.querySelectorAll("tr[data-piece]")) {
  const beams = row.querySelector(".marks").textContent.split(" ").map((mark) => beamOf.get(mark));
  pieces.set(row.dataset.piece, { beams, shown: [row] });
}
for (const place of document.querySelectorAll(".piece")) pieces.get(place.dataset.piece).shown.push(place);

const select = (element, is) => element.setAttribute("aria-selected", String(is));

/** Chooses beams everywhere: in the view, the tables and the nesting diagram. */
function choose(beams, fly) {
  chosen = beams;
  for (const row of rows) select(row, beams.includes(Number(row.dataset.beam)));
  for (const { beams: own, shown } of pieces.values()) {
    const is = beams.some((beam) => own.includes(beam));
    for (const element of shown) select(element, is);
  }
  viewer?.paint(colours.beams, beams);
  const all = beams.map((beam) => scene.beams[beam]);
  $("label").hidden = all.length === 0;
  if (all.length === 0) return;
  const marks = all.slice(0, 4).map((b) => b.mark).join(" ") + (all.length > 4 ? ` and ${all.length - 4} more` : "");
  $("label").textContent = `${marks} ${all[0].profile}`;
  if (all[0].branches.length > 0) showBranch(all[0].branches[0]);
  if (fly) flyToBeams(all);
  else rows.find((row) => Number(row.dataset.beam) === beams[0])?.scrollIntoView({ block: "nearest" });
}

function flyToBeams(all) {
  if (!viewer) return;
  if (all.length > 1) return viewer.look("fit");
  const [a, z] = all[0].ends;
  viewer.flyTo(a.map((x, i) => (x + z[i]) / 2), Math.max(2.2 * Math.hypot(...a.map((x, i) => x - z[i])), 0.5 * viewer.size));
}

/** Lets a click, and Enter or space where it has the focus, choose the beams an element stands for. */
function chooses(element, beams) {
  element.addEventListener("click", () => choose(beams, true));
  element.addEventListener("keydown", (e) => {
    if (e.key === "Enter" || e.key === " ") {
      e.preventDefault();
      choose(beams, true);
    }
  });
}

for (const row of rows) chooses(row, [Number(row.dataset.beam)]);
for (const { beams, shown } of pieces.values()) for (const element of shown) chooses(element, beams);
