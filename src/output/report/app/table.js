// The table of beams: sorting, searching, copying.

const cells = (row) => [...row.cells].map((c) => c.textContent);
const number = (text) => (text === "–" ? -Infinity : Number(text));

document.querySelectorAll("#beam-table th").forEach((head, column) => {
  head.tabIndex = 0;
  const sort = () => {
    const down = head.getAttribute("aria-sort") === "ascending";
    for (const other of head.parentNode.cells) other.removeAttribute("aria-sort");
    head.setAttribute("aria-sort", down ? "descending" : "ascending");
    const of = (row) => row.cells[column].textContent;
    const order = head.dataset.sort === "number" ? (a, b) => number(of(a)) - number(of(b)) : (a, b) => of(a).localeCompare(of(b), "en", { numeric: true });
    rows.sort((a, b) => (down ? -order(a, b) : order(a, b)) || 0);
    document.querySelector("#beam-table tbody").append(...rows);
  };
  head.addEventListener("click", sort);
  head.addEventListener("keydown", (e) => e.key === "Enter" && sort());
});

function search() {
  const wanted = $("search").value.trim().toLowerCase();
  for (const row of rows) row.hidden = !cells(row).slice(0, 2).join(" ").toLowerCase().includes(wanted);
  const shown = rows.filter((row) => !row.hidden).length;
  $("count").textContent = wanted ? `${shown} of ${rows.length}` : "";
}
$("search").addEventListener("input", search);

$("copy").addEventListener("click", async () => {
  const head = [...document.querySelectorAll("#beam-table th")].map((h) => [...h.childNodes].map((n) => n.textContent).join(" "));
  const lines = [head, ...rows.filter((row) => !row.hidden).map(cells)].map((line) => line.join("\t"));
  const text = lines.join("\n") + "\n";
  try {
    await navigator.clipboard.writeText(text);
  } catch {
    copyByHand(text);
  }
  $("count").textContent = `${lines.length === 2 ? "1 beam" : `${lines.length - 1} beams`} copied`;
});

function copyByHand(text) {
  const area = document.createElement("textarea");
  area.value = text;
  document.body.append(area);
  area.select();
  document.execCommand("copy");
  area.remove();
}
