// Colours of the beams and their legend.

// Viridis (Smith and van der Walt, 2015) in seven steps: even in brightness, safe for the colour-blind.
const RAMP = ["#440154", "#443983", "#31688e", "#21918c", "#35b779", "#90d743", "#fde725"];
const MISSING = "#8a8f98";
const QUANTITIES = {
  offset: { label: "off-centre, section radii", value: (b) => b.offset },
  area: { label: "area, mm²", value: (b) => b.area },
  deviation: { label: "deviation, mm", value: (b) => b.deviation },
  error: { label: "match error, %", value: (b) => (b.error === null ? null : 100 * b.error) },
};
const css = (rgb) => (rgb ? `rgb(${rgb.join(" ")})` : MISSING);
const figure = (x) => (x === null || x === undefined ? "–" : Math.abs(x) < 1e-6 ? "0" : Number(x.toPrecision(3)).toString());

function ramp(t) {
  const at = Math.min(Math.max(t, 0), 1) * (RAMP.length - 1);
  const k = Math.min(Math.floor(at), RAMP.length - 2);
  return new Vendor.Color(RAMP[k]).lerp(new Vendor.Color(RAMP[k + 1]), at - k);
}

/** Colour of every beam and the rows of the legend. */
function colouring(kind) {
  if (kind === "profile") {
    const profiles = new Map(scene.beams.map((b) => [b.profile, css(b.colour)]));
    return {
      beams: scene.beams.map((b) => new Vendor.Color(...(b.colour ?? [138, 143, 152]).map((c) => c / 255)).convertSRGBToLinear()),
      title: "",
      rows: [...profiles].map(([name, colour]) => [colour, name]),
    };
  }
  const { label, value } = QUANTITIES[kind];
  const known = scene.beams.map(value).filter((v) => v !== null);
  const [low, high] = [Math.min(...known), Math.max(...known)];
  const of = (v) => (v === null ? new Vendor.Color(MISSING) : ramp(high > low ? (v - low) / (high - low) : 0));
  const steps = known.length === 0 ? [] : high > low ? [0, 0.25, 0.5, 0.75, 1] : [0];
  const rows = steps.map((t) => [`#${ramp(t).getHexString()}`, figure(low + t * (high - low))]);
  if (known.length < scene.beams.length) rows.push([MISSING, "not measured"]);
  return { beams: scene.beams.map((b) => of(value(b))), title: label, rows };
}

function swatch(colour) {
  const SVG = "http://www.w3.org/2000/svg";
  const svg = document.createElementNS(SVG, "svg");
  svg.setAttribute("width", "14");
  svg.setAttribute("height", "14");
  const rect = document.createElementNS(SVG, "rect");
  for (const [name, value] of [["width", 14], ["height", 14], ["rx", 3], ["fill", colour]]) rect.setAttribute(name, value);
  svg.append(rect);
  return svg;
}

function showLegend({ title, rows }) {
  const lines = rows.map(([colour, text]) => {
    const line = document.createElement("div");
    line.append(swatch(colour), text);
    return line;
  });
  if (title) {
    const head = document.createElement("div");
    head.textContent = title;
    lines.unshift(head);
  }
  $("legend").replaceChildren(...lines);
}
