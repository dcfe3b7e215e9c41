
// The section: what is near a plane that can be moved, drawn in it.

function make_section() {
  const canvas = by_id("section");
  const axes = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1] };
  let frame = null;            // normal, right and up
  let range = { low: 0, high: 1 }; // along the normal
  let middle = [0, 0], scale = 1, zoom = 1, offset = [0, 0];
  let is_asked_for = false;

  // In the common frame: where the plane may be.
  function set_frame(the_view) {
    const axis = state.section.axis;
    if (axis === "view" && the_view) {
      const normal = unit(the_view.towards()), right = unit(the_view.right());
      frame = { normal, right, up: cross(normal, right) };
    } else {
      const normal = axes[axis] || axes.x;
      const up = axis === "z" ? [0, 1, 0] : [0, 0, 1];
      frame = { normal, right: cross(up, normal), up };
    }
    set_range();
  }

  function set_range() {
    const ranges = [[Infinity, -Infinity], [Infinity, -Infinity], [Infinity, -Infinity]];
    for (const scan of shown_scans()) {
      const motion = motion_of(scan), step = Math.max(1, Math.floor(scan.count / 5000));
      for (let i = 0; i < scan.count; i += step) {
        const p = apply(motion, point_of(scan, i));
        [frame.normal, frame.right, frame.up].forEach((d, k) => {
          const x = dot(p, d);
          ranges[k][0] = Math.min(ranges[k][0], x);
          ranges[k][1] = Math.max(ranges[k][1], x);
        });
      }
    }
    if (!(ranges[0][0] <= ranges[0][1])) ranges.fill([0, 1]);
    range = { low: ranges[0][0], high: ranges[0][1] };
    middle = [1, 2].map((k) => (ranges[k][0] + ranges[k][1]) / 2);
    range.half = [1, 2].map((k) => (ranges[k][1] - ranges[k][0]) / 2);
  }

  const position = () => range.low + state.section.position * (range.high - range.low);
  const thickness = () => state.section.thickness * (report.spacing || (range.high - range.low) / 100);

  function draw() {
    is_asked_for = false;
    const ratio = fitted(canvas), context = canvas.getContext("2d");
    const width = canvas.clientWidth, height = canvas.clientHeight;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.fillStyle = style_of("--view");
    context.fillRect(0, 0, width, height);
    const filled = 0.92;
    const fitting = filled * Math.min(width / (2 * range.half[0] || 1), height / (2 * range.half[1] || 1));
    scale = fitting * zoom;
    const at = position(), half = thickness() / 2;
    let number = 0;
    for (const scan of shown_scans()) {
      // Rows of the numbers along the normal and in the plane, of places from 0 to 1.
      const m = product([frame.normal, frame.right, frame.up].map((d) => [...d, 0]), product(motion_of(scan), scan.box));
      const [n, u, v] = m.map((row) => [row[0] / most_of_places, row[1] / most_of_places, row[2] / most_of_places, row[3]]);
      const places = scan.places;
      const size = Math.max(1.6, Math.min(5, 0.7 * scan.shown_spacing * scale));
      context.fillStyle = scan.css;
      for (let i = 0; i < 3 * scan.count; i += 3) {
        const x = places[i], y = places[i + 1], z = places[i + 2];
        if (Math.abs(n[0] * x + n[1] * y + n[2] * z + n[3] - at) > half) continue;
        ++number;
        const px = width / 2 + offset[0] + scale * (u[0] * x + u[1] * y + u[2] * z + u[3] - middle[0]);
        const py = height / 2 + offset[1] - scale * (v[0] * x + v[1] * y + v[2] * z + v[3] - middle[1]);
        context.fillRect(px - size / 2, py - size / 2, size, size);
      }
    }
    draw_bar(context, width, height);
    state.section = { ...state.section, points: number, zoom, value: at };
    by_id("section_text").textContent = number.toLocaleString("en") + " points within " + digits(thickness() / 2, 3) +
      " of the plane " + (state.section.axis === "view" ? "across the view" : state.section.axis + " = " + coordinate(at)) +
      ", " + digits(thickness(), 3) + " thick (" + state.section.thickness + " sampling distances).";
  }

  // The length of some sampling distances, or a round length where that is too short.
  function draw_bar(context, width, height) {
    const wanted = 110 / scale;
    const unit_length = 10 ** Math.floor(Math.log10(wanted));
    const length = [5, 2, 1].map((k) => k * unit_length).find((l) => l <= wanted) || unit_length;
    context.fillStyle = context.strokeStyle = style_of("--text");
    context.lineWidth = 2;
    context.beginPath();
    context.moveTo(14, height - 14);
    context.lineTo(14 + length * scale, height - 14);
    context.stroke();
    context.font = "12px sans-serif";
    const spacings = report.spacing ? " (" + digits(length / report.spacing, 3) + " sampling distances)" : "";
    context.fillText(digits(length, 3) + spacings, 14, height - 21);
  }

  function ask() {
    if (is_asked_for) return;
    is_asked_for = true;
    requestAnimationFrame(draw);
  }

  const handle = {
    drag(dx, dy) {
      offset = [offset[0] + dx, offset[1] + dy];
      ask();
    },
    zoom(factor, x, y) {
      const next = Math.min(2000, Math.max(0.2, zoom * factor)), f = next / zoom;
      const from = [x - canvas.clientWidth / 2, y - canvas.clientHeight / 2];
      offset = offset.map((o, k) => from[k] - f * (from[k] - o));
      zoom = next;
      ask();
    },
  };
  function reset() {
    zoom = 1;
    offset = [0, 0];
    ask();
  }
  listen_to_pointers(canvas, handle);
  listen_to_keys(canvas, handle, reset);
  new ResizeObserver(ask).observe(canvas);
  return {
    ask,
    reset,
    set_frame,
    set_range,
    zoom: (factor) => handle.zoom(factor, canvas.clientWidth / 2, canvas.clientHeight / 2),
    plane: () => ({ normal: frame.normal, position: position() }),
    // Of the plane, in the common frame.
    corners: () => [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([a, b]) =>
      plus(times(frame.normal, position()),
        plus(times(frame.right, middle[0] + 1.05 * a * range.half[0]), times(frame.up, middle[1] + 1.05 * b * range.half[1])))),
  };
}
