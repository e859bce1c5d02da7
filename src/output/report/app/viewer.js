// The 3D view.

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
    // Ctrl and F find, Ctrl and + enlarge: those are the browser's.
    if (event.ctrlKey || event.metaKey || event.altKey) return;
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
