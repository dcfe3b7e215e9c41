
// The view that can be turned: all scans as points, by three.js.

const colours_of_distance = { behind: [0.13, 0.4, 0.75], on: [0.93, 0.92, 0.84], before: [0.85, 0.37, 0.05], none: [0.5, 0.5, 0.53] };
const colour_of_violation = [0.86, 0.08, 0.5];
const css_of = (c) => "rgb(" + c.map((x) => Math.round(255 * x)).join(",") + ")";
const glsl_of = (c) => "vec3(" + c.map((x) => x.toFixed(3)).join(",") + ")";

const glsl = Object.fromEntries(Object.entries(colours_of_distance).map(([name, c]) => [name, glsl_of(c)]));
const steps = report.steps_of_reach.toFixed(1);

const vertex_shader = `
attribute vec2 oct;
attribute float met;
uniform mat3 turn;
uniform vec3 scan_colour;
uniform float size, pixels;
uniform int colour_by;
uniform vec4 plane;
uniform bool cut;
varying vec3 colour;

vec3 decoded(vec2 p)
{
  vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
  if (n.z < 0.0) n.xy = (1.0 - abs(n.yx)) * vec2(n.x < 0.0 ? -1.0 : 1.0, n.y < 0.0 ? -1.0 : 1.0);
  return normalize(n);
}

void main()
{
  bool in_free_space = met > 127.5;
  float code = in_free_space ? met - 128.0 : met;
  vec3 base = scan_colour;
  if (colour_by == 1) {
    float t = clamp((code - 1.0 - ${steps}) / ${steps}, -1.0, 1.0);
    base = code < 0.5 ? ${glsl.none} : t < 0.0 ? mix(${glsl.on}, ${glsl.behind}, -t) : mix(${glsl.on}, ${glsl.before}, t);
  } else if (colour_by == 2) base = in_free_space ? ${glsl_of(colour_of_violation)} : mix(scan_colour, vec3(0.6), 0.75);

  vec4 place = modelViewMatrix * vec4(position, 1.0);
  float light = 0.8;
  if (oct != vec2(0.0)) {
    vec3 n = turn * decoded(2.0 * oct - 1.0), viewer = normalize(-place.xyz);
    vec3 lamp = normalize(2.0 * viewer + vec3(-1.0, 1.0, 0.0));
    light = dot(n, viewer) >= 0.0 ? 0.3 + 0.75 * max(dot(n, lamp), 0.0) : 0.2 + 0.35 * max(-dot(n, lamp), 0.0);
    if (colour_by != 0) light = 0.35 + 0.65 * light;
  }
  colour = light * base;
  gl_Position = projectionMatrix * place;
  gl_PointSize = clamp(size * pixels / -place.z, 1.5, 64.0);
  if (cut && dot(plane.xyz, (modelMatrix * vec4(position, 1.0)).xyz) > plane.w) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
}`;

const fragment_shader = `
varying vec3 colour;
void main()
{
  vec2 d = gl_PointCoord - 0.5;
  if (dot(d, d) > 0.25) discard;
  gl_FragColor = vec4(colour, 1.0);
}`;

// Where a scan lies in the position that is chosen.
let apart = []; // the shift of each scan, side by side
function placed(scan) {
  if (state.layout === "together") return motion_of(scan);
  if (state.layout === "files") return identity;
  return shift_by(apart[scan.index] || [0, 0, 0]);
}

// The side that the normals show, upright, as in pictures.
function view_directions() {
  let sum = [0, 0, 0], number = 0;
  const motion = state.layout === "together" ? motion_of : () => identity;
  const some = shown_scans();
  for (const scan of some) {
    const m = motion(scan), step = step_of(scan, some);
    for (let i = 0; i < scan.count; i += step) {
      const n = normal_of(scan, i);
      if (!n) continue;
      sum = plus(sum, minus(apply(m, n), apply(m, [0, 0, 0])));
      ++number;
    }
  }
  const one_sided = 0.1; // mean of unit vectors: of a closed surface it is nought
  return directions_towards(number > 0 && dot(sum, sum) > (one_sided * number) ** 2 ? unit(sum) : unit([1, -2, 1]));
}

function directions_towards(towards) {
  const upright = Math.abs(towards[2]) < 0.75 ? [0, 0, 1] : [0, 1, 0];
  const right = unit(cross(upright, towards));
  return { towards, right, up: cross(towards, right) };
}

// Side by side in rows, as the view is at first.
function set_apart(directions) {
  apart = [];
  const some = shown_scans();
  const columns = Math.ceil(Math.sqrt(some.length) - 1e-9);
  const extents = some.map((scan) => {
    const corners = corners_of(scan);
    const range = (d) => {
      const x = corners.map((c) => dot(c, d));
      return [Math.min(...x), Math.max(...x)];
    };
    return { x: range(directions.right), y: range(directions.up), z: range(directions.towards) };
  });
  const gap = 1.1;
  const width = gap * Math.max(...extents.map((e) => e.x[1] - e.x[0]));
  const height = gap * Math.max(...extents.map((e) => e.y[1] - e.y[0]));
  some.forEach((scan, i) => {
    const e = extents[i], middle = (r) => (r[0] + r[1]) / 2;
    const shift = plus(
      plus(times(directions.right, (i % columns) * width - middle(e.x)),
        times(directions.up, -Math.floor(i / columns) * height - middle(e.y))),
      times(directions.towards, -middle(e.z)));
    apart[scan.index] = shift;
  });
}

// The points that the motion was found by, each of the source with the one of the target that it was matched with, in the
// frames of the files.
const correspondence = report.correspondence || [];

function make_view() {
  const canvas = by_id("view");
  const options = { antialias: false, preserveDrawingBuffer: true, alpha: false };
  const context = window.THREE && canvas.getContext("webgl", options);
  if (!context) return null;
  const fov = 30, tangent = Math.tan((fov * Math.PI) / 360);
  const renderer = new THREE.WebGLRenderer({ canvas, context, ...options });
  const scene = new THREE.Scene();
  const camera = new THREE.PerspectiveCamera(fov, 1, 0.01, 10);
  const view = { turn: new THREE.Quaternion(), target: new THREE.Vector3(), distance: 3 };
  let to_scene = { centre: [0, 0, 0], scale: 1 }; // scene from the common frame
  let is_asked_for = false, marked = null;
  // Where all points take too long to follow the hand, a part of them is drawn until it rests; and at first.
  const first_points = 20000, quick_ms = 80, rest_ms = 250;
  let points_a_ms = first_points / quick_ms, is_moving = true, resting = null;

  canvas.addEventListener("webglcontextlost", (e) => {
    e.preventDefault();
    state.context_lost = true;
    by_id("no_view").textContent = "The browser has taken the graphics away from this page: load it again to see the scans.";
    by_id("no_view").hidden = false;
  });

  const material = (scan) => new THREE.ShaderMaterial({
    vertexShader: vertex_shader,
    fragmentShader: fragment_shader,
    uniforms: {
      turn: { value: new THREE.Matrix3() },
      scan_colour: { value: new THREE.Vector3(...scan.colour.map((c) => c / 255)) },
      size: { value: 1 },
      pixels: { value: 1 },
      colour_by: { value: 0 },
      plane: { value: new THREE.Vector4() },
      cut: { value: false },
    },
  });
  const objects = scans.map((scan) => {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(scan.places, 3, true));
    geometry.setAttribute("oct", new THREE.BufferAttribute(scan.normals, 2, true));
    scan.met_attributes = scan.met.map((bytes) => new THREE.BufferAttribute(bytes, 1, false));
    scan.no_met_attribute = scan.met.length ? null : new THREE.BufferAttribute(new Uint8Array(scan.count), 1, false);
    const object = new THREE.Points(geometry, material(scan));
    object.frustumCulled = false;
    object.matrixAutoUpdate = false;
    scene.add(object);
    return object;
  });

  // On top of the scans, whatever is before them.
  const links = new THREE.LineSegments(new THREE.BufferGeometry(),
    new THREE.LineBasicMaterial({ transparent: true, opacity: 0.55, depthTest: false }));
  const ends = new THREE.Points(new THREE.BufferGeometry(),
    new THREE.PointsMaterial({ transparent: true, size: 8 * (window.devicePixelRatio || 1), sizeAttenuation: false, depthTest: false }));
  const edges = Array.from({ length: is_pair ? 2 * Math.max(0, correspondence.length - 1) : 0 }, () =>
    new THREE.Mesh(new THREE.CylinderBufferGeometry(1, 1, 1, 8), new THREE.MeshBasicMaterial({ transparent: true, depthTest: false })));
  const plane = new THREE.Mesh(new THREE.BufferGeometry(),
    new THREE.MeshBasicMaterial({ transparent: true, opacity: 0.22, side: THREE.DoubleSide, depthWrite: false }));
  const frame = new THREE.LineLoop(new THREE.BufferGeometry(), new THREE.LineBasicMaterial());
  for (const object of [links, ends, ...edges, plane, frame]) {
    object.frustumCulled = false;
    object.visible = false;
    scene.add(object);
  }

  const in_scene = (p) => times(minus(p, to_scene.centre), to_scene.scale);

  function set_points(object, points) {
    object.geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(points.flat()), 3));
  }

  function place_scans() {
    const by = { scan: 0, distance: 1, free_space: 2 }[state.colour];
    const section = the_section.plane();
    const n = new THREE.Vector4(...section.normal, to_scene.scale * (section.position - dot(section.normal, to_scene.centre)));
    state.drawn_points = 0;
    scans.forEach((scan, i) => {
      const object = objects[i], uniforms = object.material.uniforms;
      object.visible = is_shown(scan);
      if (!object.visible) return;
      state.drawn_points += scan.count;
      const motion = placed(scan), m = product(motion, scan.box), s = to_scene.scale;
      const rows = m.map((row, k) => [s * row[0], s * row[1], s * row[2], s * (row[3] - to_scene.centre[k])]);
      object.matrix.set(...rows[0], ...rows[1], ...rows[2], 0, 0, 0, 1);
      object.turn = new THREE.Matrix4().set(...motion[0], ...motion[1], ...motion[2], 0, 0, 0, 1);
      object.geometry.setAttribute("met", scan.met_attributes[state.pose] || scan.no_met_attribute);
      uniforms.colour_by.value = by;
      object.size = 1.5 * state.point_size * scan.shown_spacing * s;
      uniforms.plane.value = n;
      uniforms.cut.value = state.cut && state.layout === "together";
    });
  }

  function place_correspondence() {
    const is_wanted = by_id("correspondence").checked && is_shown(scans[0]) && is_shown(scans[1]);
    const places = [0, 1].map((side) => (is_wanted ? correspondence.map((pair) => in_scene(apply(placed(scans[side]), pair[side]))) : []));
    const count = places[0].length;
    state.correspondence = count;
    show_correspondence(count);
    links.visible = ends.visible = count > 0;
    for (const edge of edges) edge.visible = count > 0;
    if (!count) return;
    set_points(links, places[0].flatMap((p, i) => [p, places[1][i]]));
    set_points(ends, [...places[0], ...places[1]]);
    // Of either side from the first point to each of the others: long and thin along y.
    edges.forEach((edge, k) => {
      const side = places[k % 2], from = new THREE.Vector3(...side[0]), to = new THREE.Vector3(...side[1 + Math.floor(k / 2)]);
      const along = to.clone().sub(from), width = 0.0025;
      edge.position.copy(from).add(to).multiplyScalar(0.5);
      edge.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), along.clone().normalize());
      edge.scale.set(width, along.length(), width);
    });
    for (const object of [links, ends, ...edges]) object.material.color.set(style_of("--text"));
  }

  function place_plane() {
    plane.visible = frame.visible = state.plane && state.layout === "together";
    if (!plane.visible) return;
    const corners = the_section.corners().map(in_scene);
    set_points(plane, [0, 1, 2, 0, 2, 3].map((i) => corners[i]));
    set_points(frame, corners);
    for (const object of [plane, frame]) object.material.color.set(style_of("--accent"));
  }

  function update() {
    place_scans();
    place_correspondence();
    place_plane();
    ask();
  }

  // In the scene: the place on the canvas, in CSS pixels.
  function projected(p) {
    const v = new THREE.Vector3(...p).project(camera);
    return [((v.x + 1) / 2) * canvas.clientWidth, ((1 - v.y) / 2) * canvas.clientHeight];
  }

  function aim() {
    const offset = new THREE.Vector3(0, 0, view.distance).applyQuaternion(view.turn);
    camera.quaternion.copy(view.turn);
    camera.position.copy(view.target).add(offset);
    camera.aspect = canvas.clientWidth / Math.max(1, canvas.clientHeight);
    const far = camera.position.length() + 2;
    camera.far = far;
    camera.near = Math.max(view.distance - 1.5, 0.002 * view.distance);
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
  }

  function draw() {
    is_asked_for = false;
    if (state.context_lost) return;
    const ratio = fitted(canvas);
    renderer.setViewport(0, 0, canvas.width, canvas.height);
    renderer.setClearColor(new THREE.Color(style_of("--view")));
    aim();
    const turn = new THREE.Matrix4();
    const share = is_moving ? Math.min(1, (points_a_ms * quick_ms) / Math.max(1, state.drawn_points)) : 1;
    for (const object of objects) {
      if (!object.visible) continue;
      object.geometry.setDrawRange(0, Math.ceil(share * object.geometry.attributes.position.count));
      object.material.uniforms.size.value = object.size / Math.sqrt(share);
      turn.multiplyMatrices(camera.matrixWorldInverse, object.turn);
      object.material.uniforms.turn.value.setFromMatrix4(turn);
      object.material.uniforms.pixels.value = canvas.height / (2 * tangent);
    }
    const begin = performance.now();
    renderer.render(scene, camera);
    if (share === 1 || state.frames === 0) {
      context.readPixels(0, 0, 1, 1, context.RGBA, context.UNSIGNED_BYTE, new Uint8Array(4)); // waits until it is drawn
      if (state.frames > 0) points_a_ms = state.drawn_points / Math.max(1, performance.now() - begin);
    }
    if (++state.frames === 1) state.first_frame_ms = performance.now();
    state.complete = share === 1;
    if (!state.complete) {
      clearTimeout(resting);
      resting = setTimeout(() => ask(true), rest_ms);
    }
    const mark = by_id("pick_mark");
    mark.hidden = !marked;
    if (marked) {
      const m = placed(scans[marked.scan]);
      const [x, y] = projected(in_scene(apply(m, point_of(scans[marked.scan], marked.index))));
      mark.style.left = x + "px";
      mark.style.top = y + "px";
    }
    state.camera = { turn: view.turn.toArray(), target: view.target.toArray(), distance: view.distance, ratio };
  }

  function ask(is_at_rest = false) {
    is_moving = !is_at_rest;
    state.complete = false;
    if (is_asked_for) return;
    is_asked_for = true;
    requestAnimationFrame(draw);
  }

  // As large as what is shown fits.
  function fit(directions) {
    const bounds = bounds_of(shown_scans(), placed);
    const size = Math.hypot(...minus(bounds.high, bounds.low)) || 1;
    to_scene = { centre: times(plus(bounds.low, bounds.high), 0.5), scale: 1 / size };
    const axes = new THREE.Matrix4().makeBasis(...["right", "up", "towards"].map((d) => new THREE.Vector3(...directions[d])));
    view.turn.setFromRotationMatrix(axes);
    const ranges = ["right", "up", "towards"].map(() => [Infinity, -Infinity]);
    const some = shown_scans();
    for (const scan of some) {
      const m = placed(scan), step = step_of(scan, some);
      for (let i = 0; i < scan.count; i += step) {
        const p = in_scene(apply(m, point_of(scan, i)));
        ["right", "up", "towards"].forEach((d, k) => {
          const x = dot(p, directions[d]);
          ranges[k] = [Math.min(ranges[k][0], x), Math.max(ranges[k][1], x)];
        });
      }
    }
    if (!(ranges[0][0] <= ranges[0][1])) return;
    const middle = ranges.map((r) => (r[0] + r[1]) / 2), half = ranges.map((r) => (r[1] - r[0]) / 2);
    const target = ["right", "up", "towards"].reduce((sum, d, k) => plus(sum, times(directions[d], middle[k])), [0, 0, 0]);
    view.target.set(...target);
    const aspect = canvas.clientWidth / Math.max(1, canvas.clientHeight), filled = 0.94;
    view.distance = Math.max(half[1] / tangent, half[0] / (tangent * aspect)) / filled + half[2];
  }

  function reset(directions) {
    const seen_from = directions || view_directions();
    if (state.layout === "apart") set_apart(seen_from);
    fit(seen_from);
    update();
  }

  const axis = { x: new THREE.Vector3(1, 0, 0), y: new THREE.Vector3(0, 1, 0) };
  const handle = {
    drag(dx, dy, is_shift) {
      if (is_shift) {
        const step = (2 * tangent * view.distance) / Math.max(1, canvas.clientHeight);
        view.target.add(new THREE.Vector3(-dx * step, dy * step, 0).applyQuaternion(view.turn));
      } else {
        const speed = 0.008;
        view.turn.multiply(new THREE.Quaternion().setFromAxisAngle(axis.y, -dx * speed));
        view.turn.multiply(new THREE.Quaternion().setFromAxisAngle(axis.x, -dy * speed)).normalize();
      }
      ask();
    },
    zoom(factor, x, y) {
      const step = (2 * tangent * view.distance) / Math.max(1, canvas.clientHeight);
      const off = new THREE.Vector3((x - canvas.clientWidth / 2) * step, (canvas.clientHeight / 2 - y) * step, 0);
      view.target.add(off.multiplyScalar(1 - 1 / factor).applyQuaternion(view.turn));
      view.distance = Math.min(20, Math.max(1e-4, view.distance / factor));
      ask();
    },
    // The point that is drawn nearest to the viewer within some pixels.
    click(x, y) {
      const most = 8, section = the_section.plane(), is_cut = state.cut && state.layout === "together";
      aim();
      let best = null;
      for (const scan of shown_scans()) {
        const object = objects[scan.index];
        const m = new THREE.Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse).multiply(object.matrix).elements;
        const motion = placed(scan);
        for (let i = 0; i < scan.count; ++i) {
          const px = scan.places[3 * i] / most_of_places, py = scan.places[3 * i + 1] / most_of_places, pz = scan.places[3 * i + 2] / most_of_places;
          const w = m[3] * px + m[7] * py + m[11] * pz + m[15];
          if (!(w > 0)) continue;
          const dx = ((m[0] * px + m[4] * py + m[8] * pz + m[12]) / w + 1) / 2 * canvas.clientWidth - x;
          const dy = (1 - (m[1] * px + m[5] * py + m[9] * pz + m[13]) / w) / 2 * canvas.clientHeight - y;
          if (dx * dx + dy * dy > most * most) continue;
          const depth = (m[2] * px + m[6] * py + m[10] * pz + m[14]) / w;
          if (is_cut && dot(section.normal, apply(motion, point_of(scan, i))) > section.position) continue;
          if (!best || depth < best.depth) best = { scan: scan.index, index: i, depth };
        }
      }
      marked = best;
      show_picked(best);
      ask();
    },
  };
  listen_to_pointers(canvas, handle);
  listen_to_keys(canvas, handle, () => reset());
  new ResizeObserver(() => ask()).observe(canvas);
  return {
    update,
    reset,
    ask,
    unmark() {
      marked = null;
      show_picked(null);
    },
    zoom: (factor) => handle.zoom(factor, canvas.clientWidth / 2, canvas.clientHeight / 2),
    towards: () => new THREE.Vector3(0, 0, 1).applyQuaternion(view.turn).toArray(),
    right: () => new THREE.Vector3(1, 0, 0).applyQuaternion(view.turn).toArray(),
  };
}
