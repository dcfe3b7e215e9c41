"use strict";

// The contents of the page: the JSON of the report, and the scans, of which only what is shown is decoded.

const report = JSON.parse(document.getElementById("data").textContent);
const is_pair = report.kind === "pair";
const by_id = (id) => document.getElementById(id);

// What the page shows: what each control does can be read here.
const state = {
  ready: false,
  has_view: false,
  context_lost: false,
  layout: "together",
  colour: "scan",
  pose: 0,
  component: 0,
  visible: report.scans.map(() => true),
  point_size: 1,
  correspondence: 0, // points of either scan that are drawn: of the pair or the trihedron that the motion was found by
  plane: false,
  cut: false,
  picked: null,
  camera: null,
  drawn_points: 0,
  frames: 0,
  complete: false, // all that is shown is drawn, not a part of its points
  first_frame_ms: null,
  section: { axis: "x", position: 0.5, thickness: 2, points: 0, zoom: 1 },
  histogram: null,
  pair_filter: "all",
  theme: "auto",
};
window.report_state = state;

function bytes_of(id) {
  const element = by_id(id);
  const text = atob(element.textContent);
  element.textContent = "";
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

// Rows of 3 x 4 matrices: x -> m x.
const identity = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]];

function product(a, b) {
  return a.map((row) => [0, 1, 2, 3].map((j) =>
    row[0] * b[0][j] + row[1] * b[1][j] + row[2] * b[2][j] + (j === 3 ? row[3] : 0)));
}

function apply(m, p) {
  return m.map((row) => row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3]);
}

const plus = (a, b) => a.map((x, i) => x + b[i]);
const minus = (a, b) => a.map((x, i) => x - b[i]);
const times = (a, s) => a.map((x) => x * s);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const unit = (a) => times(a, 1 / Math.sqrt(dot(a, a)));
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const shift_by = (v) => identity.map((row, i) => [row[0], row[1], row[2], v[i]]);

function digits(x, n = 4) {
  return Number(x.toPrecision(n)).toString();
}

// A coordinate, to a hundredth of the sampling distance, however far away the origin is.
function coordinate(x) {
  const decimals = report.spacing > 0 ? Math.ceil(2 - Math.log10(report.spacing)) : 6;
  return x.toFixed(Math.min(15, Math.max(0, decimals)));
}

const most_of_places = 65535;

const scans = report.scans.map((data, i) => {
  const places = new Uint16Array(bytes_of("places_" + i).buffer);
  const scan = {
    ...data,
    index: i,
    places,
    normals: bytes_of("normals_" + i),
    count: places.length / 3,
    // From places, as numbers from 0 to 1, to the frame of the scan's file; of a flat box not singular: all are 0 there.
    box: [0, 1, 2].map((k) => [0, 1, 2, 3].map((j) =>
      (j === k ? data.size[k] || Math.max(...data.size) || 1 : j === 3 ? data.low[k] : 0))),
    met: report.poses.map((pose, k) => bytes_of("met_" + k + "_" + i)),
    css: "rgb(" + data.colour.join(",") + ")",
  };
  // The distance of the points that are shown, about; of a scan that was not prepared, as if they filled a square.
  const count = Math.max(1, scan.count);
  scan.shown_spacing = scan.spacing ? scan.spacing * Math.sqrt(scan.samples / count) : Math.max(...data.size) / Math.sqrt(count);
  return scan;
});

// A point in the frame of the scan's file.
function point_of(scan, i) {
  return [0, 1, 2].map((k) => scan.low[k] + (scan.size[k] * scan.places[3 * i + k]) / most_of_places);
}

// The normal, in the frame of the scan's file; null where none is known.
function normal_of(scan, i) {
  const a = scan.normals[2 * i], b = scan.normals[2 * i + 1];
  if (a === 0 && b === 0) return null;
  let x = a / 127.5 - 1, y = b / 127.5 - 1;
  const z = 1 - Math.abs(x) - Math.abs(y);
  if (z < 0) [x, y] = [Math.sign(x) * (1 - Math.abs(y)), Math.sign(y) * (1 - Math.abs(x))];
  return unit([x, y, z]);
}

// What a byte says: the distance in steps of reach / steps, or null, and whether the point is in free space.
function meeting_of(byte) {
  const code = byte & 127;
  return { step: code === 0 ? null : code - 1 - report.steps_of_reach, in_free_space: byte >= 128 };
}

const spacings_of_step = report.reach_in_spacings / report.steps_of_reach;

// The motion of a scan to the common frame, in the pose that is chosen.
function motion_of(scan) {
  const pose = report.poses[state.pose];
  return (pose && pose.motions[scan.index]) || identity;
}

function met_of(scan) {
  return scan.met[state.pose] || null;
}

const is_shown = (scan) => state.visible[scan.index] && (is_pair || scan.component === state.component);
const shown_scans = () => scans.filter(is_shown);

// The eight corners of a scan's box.
function corners_of(scan) {
  const corners = [];
  for (let k = 0; k < 8; ++k)
    corners.push([0, 1, 2].map((j) => scan.low[j] + ((k >> j) & 1) * scan.size[j]));
  return corners;
}

// Of the points of one of so many scans every n-th is looked at where all would take too long.
function step_of(scan, some) {
  const most = 40000;
  return Math.max(1, Math.floor((scan.count * some.length) / most));
}

// The box, in a frame to which `motion(scan)` leads, of points of some scans.
function bounds_of(some, motion) {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (const scan of some) {
    const m = product(motion(scan), scan.box);
    const step = step_of(scan, some);
    for (let i = 0; i < scan.count; i += step) {
      const p = [0, 1, 2].map((k) => scan.places[3 * i + k] / most_of_places);
      const q = apply(m, p);
      for (let k = 0; k < 3; ++k) {
        low[k] = Math.min(low[k], q[k]);
        high[k] = Math.max(high[k], q[k]);
      }
    }
  }
  if (!(low[0] <= high[0])) return { low: [0, 0, 0], high: [1, 1, 1] };
  return { low, high };
}

// Calls what depends on the scans that are shown, on the pose, or on the colours.
const listeners = [];
function changed(what) {
  for (const listener of listeners) listener(what);
}

// Makes an element: make("td", {class: "number"}, "text", child...).
function make(tag, attributes = {}, ...children) {
  const svg = ["svg", "rect", "line", "circle", "text", "title", "path", "g"].includes(tag);
  const element = svg ? document.createElementNS("http://www.w3.org/2000/svg", tag) : document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (value === true) element.setAttribute(name, "");
    else if (value !== false) element.setAttribute(name, value);
  }
  for (const child of children) element.append(child);
  return element;
}

function style_of(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

// A canvas as large as it is shown, for drawing in CSS pixels.
function fitted(canvas) {
  const ratio = window.devicePixelRatio || 1;
  const width = Math.max(1, Math.round(canvas.clientWidth * ratio));
  const height = Math.max(1, Math.round(canvas.clientHeight * ratio));
  if (canvas.width !== width || canvas.height !== height) {
    canvas.width = width;
    canvas.height = height;
  }
  return ratio;
}

// Turns of the wheel, drags, pinches and clicks on a canvas. `handle` has drag(dx, dy, is_shift), zoom(factor, x, y), and
// may have click(x, y); in CSS pixels from the corner of the canvas.
function listen_to_pointers(canvas, handle) {
  const pointers = new Map();
  let moved = 0;
  const place = (e) => {
    const box = canvas.getBoundingClientRect();
    return [e.clientX - box.left, e.clientY - box.top];
  };
  canvas.addEventListener("contextmenu", (e) => e.preventDefault());
  canvas.addEventListener("wheel", (e) => {
    e.preventDefault();
    const lines = e.deltaMode === 1 ? 16 : 1;
    handle.zoom(Math.exp(-Math.max(-300, Math.min(300, e.deltaY * lines)) * 0.0015), ...place(e));
  }, { passive: false });
  canvas.addEventListener("pointerdown", (e) => {
    canvas.setPointerCapture(e.pointerId);
    if (pointers.size === 0) moved = 0;
    pointers.set(e.pointerId, place(e));
  });
  canvas.addEventListener("pointermove", (e) => {
    const before = pointers.get(e.pointerId);
    if (!before) return;
    const now = place(e);
    const step = [now[0] - before[0], now[1] - before[1]];
    moved += Math.hypot(...step);
    if (pointers.size === 1) {
      if (moved > 3) handle.drag(step[0], step[1], e.shiftKey || e.buttons === 2 || e.buttons === 4);
    } else {
      const other = [...pointers].find(([id]) => id !== e.pointerId)[1];
      const apart = (p) => Math.hypot(p[0] - other[0], p[1] - other[1]);
      handle.drag(step[0] / 2, step[1] / 2, true);
      if (apart(before) > 0 && apart(now) > 0)
        handle.zoom(apart(now) / apart(before), (now[0] + other[0]) / 2, (now[1] + other[1]) / 2);
    }
    pointers.set(e.pointerId, now);
  });
  const end = (e) => {
    if (!pointers.delete(e.pointerId)) return;
    if (e.type === "pointerup" && pointers.size === 0 && moved <= 3 && e.button === 0 && handle.click)
      handle.click(...place(e));
  };
  canvas.addEventListener("pointerup", end);
  canvas.addEventListener("pointercancel", end);
}

// The keys that do the same.
function listen_to_keys(canvas, handle, reset) {
  const step = 24;
  const arrows = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, -step], ArrowDown: [0, step] };
  canvas.addEventListener("keydown", (e) => {
    const middle = [canvas.clientWidth / 2, canvas.clientHeight / 2];
    if (arrows[e.key]) handle.drag(...arrows[e.key], e.shiftKey);
    else if (e.key === "+" || e.key === "=") handle.zoom(1.2, ...middle);
    else if (e.key === "-") handle.zoom(1 / 1.2, ...middle);
    else if (e.key === "Home") reset();
    else return;
    e.preventDefault();
  });
}
