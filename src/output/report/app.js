// The report's behaviour: 3D view, selection, sorting, searching, plots.
// Texts reach the page through textContent only.
"use strict";
(() => {
  const scene = JSON.parse(document.getElementById("scene").textContent);
  const root = document.documentElement;
  const $ = (id) => document.getElementById(id);
  const style = (name) => getComputedStyle(root).getPropertyValue(name).trim();
  root.classList.add("script");

  // ---- packed geometry -------------------------------------------------------------------------

  function bytes(base64) {
    const text = atob(base64);
    const all = new Uint8Array(text.length);
    for (let i = 0; i < text.length; i++) all[i] = text.charCodeAt(i);
    return all.buffer;
  }
  const indices = ({ bits, base64 }) =>
    bits === 16 ? new Uint16Array(bytes(base64)) : new Uint32Array(bytes(base64));
  function points(base64) {
    const steps = new Uint16Array(bytes(base64));
    const { origin, step } = scene.grid;
    const places = new Float32Array(steps.length);
    for (let i = 0; i < steps.length; i++) places[i] = origin[i % 3] + steps[i] * step;
    return places;
  }

  // ---- colours ---------------------------------------------------------------------------------

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

  // ---- 3D view ---------------------------------------------------------------------------------

  const KIND = { interface: 0, branch: 1, junction: 2, end: 3 };
  const CHOSEN = "#ff1fc7";
  const REST = "#9aa0a8";
  const LOOKS = { isometric: [1, -1, 1], front: [0, -1, 0], top: [0, -1e-3, 1], side: [1, 0, 0] };

  class Viewer {
    constructor(host) {
      const V = Vendor;
      this.host = host;
      this.renderer = new V.WebGLRenderer({ antialias: true, alpha: true, preserveDrawingBuffer: true });
      this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
      host.append(this.renderer.domElement);
      this.scene = new V.Scene();
      this.camera = new V.PerspectiveCamera(35, 1, 0.1, 10);
      this.camera.up.set(0, 0, 1);
      this.controls = new V.OrbitControls(this.camera, host);
      this.controls.addEventListener("change", () => this.draw());
      this.scene.add(new V.AmbientLight(0xffffff, 1.3));
      const lamp = new V.DirectionalLight(0xffffff, 2.2);
      lamp.position.set(-0.4, 0.6, 1);
      this.camera.add(lamp);
      this.scene.add(this.camera);
      this.layers = {};
      this.build();
      this.resize();
      new ResizeObserver(() => this.resize()).observe(host);
      this.listen();
    }

    build() {
      const V = Vendor;
      const places = new V.BufferAttribute(points(scene.mesh.points), 3);
      this.size = scene.size || 1;
      this.layers.mesh = this.surface(places, scene.mesh.design, 0x9aa7b8, 0.22);
      this.layers.nonDesign = this.surface(places, scene.mesh.nonDesign, 0xc94b41, 0.2);
      this.layers.beams = this.solids();
      const { skeleton } = scene;
      const segments = skeleton.branches.flatMap((b) => b.slice(1).map((p, i) => [b[i], p]));
      this.layers.skeleton = this.lines(skeleton.points, segments, style("--ink"), true);
      const junctions = skeleton.points.filter((_, i) => skeleton.kinds[i] === KIND.junction);
      this.layers.junctions = this.balls(junctions, 0.0045, 0x6a3dff);
      this.layers.outside = this.balls(skeleton.outside.map((i) => skeleton.points[i]), 0.007, 0x000000);
      this.outside = [this.layers.outside];
      this.layers.outlines = this.outlines();
      this.layers.peers = new V.Group();
      scene.peers.forEach((peer, i) => {
        this.layers.peers.add(this.lines(peer.points, peer.segments, ["#8e24aa", "#00838f", "#c0392b", "#6d4c41"][i % 4], true));
        const outside = this.balls(peer.outside.map((k) => peer.points[k]), 0.006, 0x000000);
        this.layers.peers.add(outside);
        this.outside.push(outside);
      });
      this.pin = this.balls([[0, 0, 0]], 0.006, 0xff3d00);
      this.pin.visible = false;
      this.scene.add(this.pin, ...Object.values(this.layers));
    }

    surface(places, packed, colour, opacity) {
      const V = Vendor;
      const geometry = new V.BufferGeometry();
      geometry.setAttribute("position", places);
      geometry.setIndex(new V.BufferAttribute(indices(packed), 1));
      const material = new V.MeshLambertMaterial({ color: colour, transparent: true, opacity, flatShading: true, side: V.DoubleSide, forceSinglePass: true, depthWrite: false });
      const mesh = new V.Mesh(geometry, material);
      mesh.renderOrder = 2;
      mesh.frustumCulled = false;
      return mesh;
    }

    solids() {
      const V = Vendor;
      const geometry = new V.BufferGeometry();
      const places = points(scene.beamMesh.points);
      geometry.setAttribute("position", new V.BufferAttribute(places, 3));
      geometry.setAttribute("color", new V.BufferAttribute(new Float32Array(places.length), 3));
      geometry.setIndex(new V.BufferAttribute(indices(scene.beamMesh.indices), 1));
      return new V.Mesh(geometry, new V.MeshLambertMaterial({ vertexColors: true, flatShading: true }));
    }

    lines(places, segments, colour, onTop) {
      const V = Vendor;
      const geometry = new V.BufferGeometry();
      const ends = segments.flat().flatMap((i) => places[i]);
      geometry.setAttribute("position", new V.BufferAttribute(new Float32Array(ends), 3));
      const lines = new V.LineSegments(geometry, new V.LineBasicMaterial({ color: colour, depthTest: !onTop, transparent: true }));
      lines.renderOrder = 3;
      return lines;
    }

    outlines() {
      const places = points(scene.outlines.points);
      const list = [];
      for (let i = 0; i < places.length; i += 3) list.push([places[i], places[i + 1], places[i + 2]]);
      const { starts } = scene.outlines;
      const segments = starts.slice(1).flatMap((end, k) => {
        const count = end - starts[k];
        return Array.from({ length: count }, (_, i) => [starts[k] + i, starts[k] + ((i + 1) % count)]);
      });
      const lines = this.lines(list, segments, "#0b63ce", true);
      lines.visible = false;
      return lines;
    }

    balls(places, size, colour) {
      const V = Vendor;
      const ball = new V.SphereGeometry(size * this.size, 16, 10);
      const balls = new V.InstancedMesh(ball, new V.MeshBasicMaterial({ color: colour, depthTest: false, transparent: true }), Math.max(places.length, 1));
      balls.count = places.length;
      places.forEach((p, i) => balls.setMatrixAt(i, new V.Matrix4().makeTranslation(...p)));
      balls.frustumCulled = false;
      balls.renderOrder = 4;
      return balls;
    }

    /** Gives each beam its colour; the chosen ones stand out, the others pale. */
    paint(colours, chosen) {
      const { geometry } = this.layers.beams;
      const colour = geometry.getAttribute("color");
      const corners = geometry.getIndex().array;
      const { starts } = scene.beamMesh;
      colours.forEach((own, beam) => {
        const shown = chosen.includes(beam) ? new Vendor.Color(CHOSEN) : own.clone().lerp(new Vendor.Color(REST), chosen.length > 0 ? 0.6 : 0);
        for (let i = 3 * starts[beam]; i < 3 * starts[beam + 1]; i++) colour.setXYZ(corners[i], shown.r, shown.g, shown.b);
      });
      colour.needsUpdate = true;
      this.draw();
    }

    show(layer, visible) {
      this.layers[layer].visible = visible;
      this.draw();
    }

    look(name) {
      const towards = new Vendor.Vector3(...(LOOKS[name] ?? this.camera.position.clone().sub(this.controls.target).toArray())).normalize();
      const { target, distance } = this.fitting(towards);
      this.aim(target, towards, distance);
    }

    /** Where to look from a direction, and from how far, to see the whole mesh. */
    fitting(towards) {
      const V = Vendor;
      const right = new V.Vector3(0, 0, 1).cross(towards).normalize();
      const axes = [right, towards.clone().cross(right), towards];
      const places = this.layers.mesh.geometry.getAttribute("position").array;
      const along = (axis, i) => axis.x * places[i] + axis.y * places[i + 1] + axis.z * places[i + 2];
      const middle = axes.map((axis) => {
        let [low, high] = [Infinity, -Infinity];
        for (let i = 0; i < places.length; i += 3) {
          const at = along(axis, i);
          low = Math.min(low, at);
          high = Math.max(high, at);
        }
        return (low + high) / 2;
      });
      const tangent = Math.tan((this.camera.fov * Math.PI) / 360);
      let farthest = 0;
      for (let i = 0; i < places.length; i += 3) {
        const [x, y, z] = axes.map((axis, k) => along(axis, i) - middle[k]);
        farthest = Math.max(farthest, z + Math.max(Math.abs(x) / (tangent * this.camera.aspect), Math.abs(y) / tangent));
      }
      const distance = 1.06 * farthest || 1;
      const target = axes.reduce((sum, axis, k) => sum.addScaledVector(axis, middle[k]), new V.Vector3());
      return { target, distance };
    }

    aim(target, towards, distance) {
      this.controls.target.copy(target);
      this.camera.position.copy(target).addScaledVector(towards, distance);
      this.camera.near = this.size / 500;
      this.camera.far = this.size * 20;
      this.camera.updateProjectionMatrix();
      this.controls.update();
      this.draw();
    }

    flyTo(place, reach) {
      const towards = this.camera.position.clone().sub(this.controls.target).normalize();
      this.aim(new Vendor.Vector3(...place), towards, reach);
    }

    mark(place) {
      this.pin.visible = true;
      this.pin.setMatrixAt(0, new Vendor.Matrix4().makeTranslation(...place));
      this.pin.instanceMatrix.needsUpdate = true;
      this.flyTo(place, 0.45 * this.size);
    }

    /** The beam under a place on the screen, in a list; an empty one for none. */
    beamsAt(x, y) {
      if (!this.layers.beams.visible) return [];
      const frame = this.host.getBoundingClientRect();
      const at = new Vendor.Vector2(((x - frame.left) / frame.width) * 2 - 1, 1 - ((y - frame.top) / frame.height) * 2);
      const ray = new Vendor.Raycaster();
      ray.setFromCamera(at, this.camera);
      const [hit] = ray.intersectObject(this.layers.beams, false);
      return hit ? [scene.beamMesh.starts.findIndex((start) => start > hit.faceIndex) - 1] : [];
    }

    listen() {
      let down = null;
      this.host.addEventListener("pointerdown", (e) => (down = [e.clientX, e.clientY]));
      this.host.addEventListener("pointerup", (e) => {
        if (down && Math.hypot(e.clientX - down[0], e.clientY - down[1]) < 5) choose(this.beamsAt(e.clientX, e.clientY), false);
        down = null;
      });
      this.host.addEventListener("keydown", (e) => this.key(e));
    }

    key(event) {
      const turn = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1] }[event.key];
      const zoom = { "+": 0.87, "=": 0.87, "-": 1.15 }[event.key];
      if (turn) this.turn(...turn);
      else if (zoom) this.turn(0, 0, zoom);
      else if (event.key === "f" || event.key === "F") this.look("fit");
      else if (event.key === "Escape") {
        this.pin.visible = false;
        choose([], false);
      } else return;
      event.preventDefault();
    }

    turn(around, over, zoom = 1) {
      const arm = this.camera.position.clone().sub(this.controls.target);
      const length = arm.length() * zoom;
      const height = Math.min(Math.max(Math.acos(arm.z / arm.length()) + over, 0.01), Math.PI - 0.01);
      const angle = Math.atan2(arm.y, arm.x) + around;
      arm.set(Math.sin(height) * Math.cos(angle), Math.sin(height) * Math.sin(angle), Math.cos(height));
      this.aim(this.controls.target.clone(), arm, length);
    }

    theme() {
      this.layers.skeleton.material.color.set(style("--ink"));
      for (const balls of this.outside) balls.material.color.set(root.dataset.theme === "dark" ? "#ffffff" : "#000000");
      this.draw();
    }

    resize() {
      const { clientWidth: width, clientHeight: height } = this.host;
      if (!width || !height || matchMedia("print").matches) return;
      if (width === this.width && height === this.height) return;
      [this.width, this.height] = [width, height];
      this.renderer.setSize(width, height);
      this.camera.aspect = width / height;
      this.camera.updateProjectionMatrix();
      if (!this.fitted) {
        this.fitted = true;
        this.look("isometric");
      }
      this.draw();
    }

    /** Draws once before the next frame, however often it is asked to. */
    draw() {
      if (this.waiting) return;
      this.waiting = requestAnimationFrame(() => {
        this.waiting = 0;
        this.renderer.render(this.scene, this.camera);
        root.dataset.drawn = "true";
      });
    }
  }

  function makeViewer() {
    try {
      return new Viewer($("view"));
    } catch {
      root.classList.add("fixed");
      $("no-webgl").hidden = false;
      return null;
    }
  }

  /** The 3D view, once it is made; null where the browser has no WebGL. */
  let viewer = null;

  // ---- selection -------------------------------------------------------------------------------

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

  // ---- table of beams --------------------------------------------------------------------------

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

  // ---- plots -----------------------------------------------------------------------------------

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

  // ---- start -----------------------------------------------------------------------------------

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
})();
