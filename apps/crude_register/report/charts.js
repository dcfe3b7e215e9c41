
// The tables and charts: histogram, motions, numbers, and what there is to say of an assembly.

const number_cell = (text) => make("td", { class: "number" }, text);
const percent = (share) => {
  if (share > 0.9999 && share < 1) return "> 99.99 %";
  if (share > 0 && share < 0.0001) return "< 0.01 %";
  return digits(100 * share, share > 0.99 ? 4 : 3) + " %";
};

// The distances of the points that are shown: of a pair a line a scan, of an assembly one of all.
function show_histogram() {
  const steps = report.steps_of_reach, group = 5, inner = 2 * steps - 1, bins = inner / group;
  const series = is_pair
    ? shown_scans().map((scan) => ({ name: scan.name, css: scan.css, scans: [scan] }))
    : [{ name: "all scans shown", css: style_of("--accent"), scans: shown_scans() }];
  const summary = [];
  for (const s of series) {
    const counts = new Array(256).fill(0);
    let points = 0;
    for (const scan of s.scans) {
      const met = met_of(scan);
      points += scan.count;
      if (met) for (let i = 0; i < met.length; ++i) ++counts[met[i]];
    }
    s.heights = new Array(Math.ceil(bins)).fill(0);
    let near = 0, beyond = 0, squares = 0, violating = 0;
    counts.forEach((count, byte) => {
      const m = meeting_of(byte);
      if (m.in_free_space) violating += count;
      if (m.step === null) return;
      if (Math.abs(m.step) === steps) {
        beyond += count;
        return;
      }
      near += count;
      squares += count * (m.step * spacings_of_step) ** 2;
      s.heights[Math.floor((m.step + steps - 1) / group)] += count;
    });
    s.near = near;
    summary.push({ name: s.name, points, near, beyond, violating, rms: near ? Math.sqrt(squares / near) : null });
    s.heights = s.heights.map((h) => (near ? h / near : 0));
  }
  state.histogram = summary;
  const width = 560, height = 240, left = 8, bottom = 34, top = 8;
  const most = Math.max(1e-9, ...series.flatMap((s) => s.heights));
  const x = (spacings) => left + ((spacings / report.reach_in_spacings + 1) / 2) * (width - 2 * left);
  const y = (share) => height - bottom - (share / most) * (height - bottom - top);
  const edge = (bin) => ((bin * group - inner / 2) * spacings_of_step);
  const svg = make("svg", { viewBox: "0 0 " + width + " " + height, role: "img", "aria-label": "Histogram of the distances" });
  for (const s of series) {
    let path = "M" + x(edge(0)) + " " + y(0);
    s.heights.forEach((h, b) => { path += "L" + x(edge(b)) + " " + y(h) + "L" + x(edge(b + 1)) + " " + y(h); });
    path += "L" + x(edge(s.heights.length)) + " " + y(0) + "Z";
    svg.append(make("path", { d: path, fill: s.css, "fill-opacity": 0.35, stroke: s.css, "stroke-width": 1.5 }));
  }
  svg.append(make("line", { class: "axis", x1: left, x2: width - left, y1: y(0), y2: y(0) }));
  for (const tick of [-1, -0.5, 0, 0.5, 1]) {
    const at = x(tick * report.reach_in_spacings);
    svg.append(make("line", { class: "axis", x1: at, x2: at, y1: y(0), y2: y(0) + 4 }));
    svg.append(make("text", { x: at, y: y(0) + 16, "text-anchor": tick === -1 ? "start" : tick === 1 ? "end" : "middle" }, digits(tick * report.reach_in_spacings)));
  }
  svg.append(make("text", { x: width / 2, y: height - 4, "text-anchor": "middle" }, "behind the other surface    \u2190   sampling distances   \u2192    in front of it"));
  by_id("histogram").replaceChildren(svg);
  const share = (n, of) => percent(of ? n / of : 0);
  by_id("histogram_text").replaceChildren(...summary.map((s, i) => make("span", { style: "display:block" },
    make("span", { class: "swatch", style: "background:" + series[i].css }), " " + s.name + ": " + share(s.near, s.points) + " of " +
    s.points.toLocaleString("en") + " points have a surface within " + report.reach_in_spacings + " sampling distances" +
    (s.rms === null ? "" : ", root mean square " + digits(s.rms, 3)) + "; " + share(s.violating, s.points) + " are in free space.")));
}

// The motions to choose from.
function show_poses(choose) {
  by_id("pose_part").hidden = !(is_pair && report.poses.length);
  if (by_id("pose_part").hidden) return;
  by_id("poses").replaceChildren(...report.poses.map((pose, k) => {
    const has = pose.probability !== undefined;
    return make("label", { class: "pose" },
      make("input", { type: "radio", name: "pose", value: k, checked: k === 0, onchange: () => choose(k) }),
      make("span", {}, pose.name),
      make("span", {}, has ? percent(pose.probability) : ""),
      has ? make("div", { class: "bar" }, make("div", { style: "width:" + 100 * pose.probability + "%" })) : "");
  }));
}

function mark_pose() {
  const pose = report.poses[state.pose];
  if (!is_pair || !pose) return;
  [...by_id("poses").children].forEach((row, k) => {
    row.classList.toggle("chosen", k === state.pose);
    row.querySelector("input").checked = k === state.pose;
  });
  by_id("pose_meaning").textContent = pose.meaning;
  by_id("pose_matrix").textContent = [...pose.motions[0], [0, 0, 0, 1]].map((row) => row.join(" ")).join("\n");
  by_id("previous_pose").disabled = state.pose === 0;
  by_id("next_pose").disabled = state.pose === report.poses.length - 1;
}

function show_numbers() {
  by_id("numbers").replaceChildren(...report.numbers.map((n) =>
    make("tr", {}, make("th", { scope: "row" }, n.name), make("td", {}, n.value), make("td", {}, n.meaning))));
  const all = scans.reduce((sum, scan) => sum + scan.samples, 0), shown = scans.reduce((sum, scan) => sum + scan.count, 0);
  by_id("thinned").textContent = shown < all
    ? "The page has " + shown.toLocaleString("en") + " of the " + all.toLocaleString("en") +
      " samples, evenly from each scan; the numbers above are of all."
    : "The page has all " + all.toLocaleString("en") + " samples.";
  by_id("notes").replaceChildren(...report.notes.map((note) => make("li", {}, note)));
  by_id("notes").hidden = report.notes.length === 0;
  by_id("licence").hidden = by_id("licence").querySelector("pre").textContent.trim() === "";
}

const words = { used: "used", dropped: "dropped", not_connecting: "not connecting", without_overlap: "without overlap" };

// Of an assembly. `show_only(scans)`: switches off all others.
function show_assembly(show_only) {
  if (is_pair) return;
  for (const part of ["left_out_part", "graph_part", "matrix_part", "residual_part", "pair_part"]) by_id(part).hidden = false;
  const look = (a, b) => make("button", { type: "button", "aria-label": "Show " + scans[a].name + " and " + scans[b].name + " only", onclick: () => show_only([a, b]) }, "look");
  const head = (...names) => make("thead", {}, make("tr", {}, ...names.map((n) => make("th", {}, n))));
  const may_look = (a, b) => (scans[a].component === scans[b].component ? look(a, b) : "");

  const alone = scans.filter((scan) => scan.reason);
  const refused = report.edges.filter((e) => e.status === "dropped" || e.status === "not_connecting");
  const left_out = [];
  left_out.push(make("p", {}, alone.length ? alone.length + (alone.length === 1 ? " scan is alone:" : " scans are alone:") : "No scan is alone."));
  if (alone.length) left_out.push(make("ul", {}, ...alone.map((scan) => make("li", {}, scan.name + ": " + scan.reason))));
  left_out.push(make("p", {}, refused.length
    ? refused.length + (refused.length === 1 ? " pair has a motion that is not used:" : " pairs have motions that are not used:")
    : "No pair that was registered contradicts the model."));
  if (refused.length)
    left_out.push(make("ul", {}, ...refused.map((e) => make("li", {}, scans[e.source].name + " and " + scans[e.target].name + ", " + words[e.status] + ": " + e.reason))));
  by_id("left_out").replaceChildren(...left_out);

  show_graph();
  show_matrix();

  const overlaps = [...report.overlaps].sort((a, b) => b.residual - a.residual);
  by_id("residuals").replaceChildren(make("table", {}, head("scan", "on", "overlap", "residual", ""),
    make("tbody", {}, ...overlaps.map((o) => make("tr", {}, make("td", {}, scans[o.source].name), make("td", {}, scans[o.target].name),
      number_cell(percent(o.overlap)), number_cell(digits(o.residual, 3)), make("td", {}, may_look(o.source, o.target)))))));

  const show_pairs = () => {
    state.pair_filter = by_id("pair_filter").value;
    const edges = report.edges.filter((e) => state.pair_filter === "all" || e.status === state.pair_filter);
    by_id("pairs").replaceChildren(make("table", {}, head("source", "target", "", "confidence", "overlap", "residual", "why", ""),
      make("tbody", {}, ...edges.map((e) => make("tr", {}, make("td", {}, scans[e.source].name), make("td", {}, scans[e.target].name),
        make("td", {}, words[e.status]), number_cell(percent(e.confidence)), number_cell(percent(e.overlap)), number_cell(digits(e.residual, 3)),
        make("td", { class: "why" }, e.reason), make("td", {}, may_look(e.source, e.target)))))));
    state.pairs = edges.length;
  };
  by_id("pair_filter").addEventListener("change", show_pairs);
  show_pairs();
}

// Each component a circle of its scans.
function show_graph() {
  const groups = [];
  for (const scan of scans) (groups[scan.component] = groups[scan.component] || []).push(scan.index);
  const place = [], dot_radius = 6;
  let x = 0, y = 0, row = 0, width = 0;
  for (const group of groups) {
    const radius = group.length === 1 ? 0 : Math.max(40, (group.length * 26) / (2 * Math.PI));
    const half = radius + (radius ? 112 : 60), half_height = radius + 34;
    if (x > 0 && x + 2 * half > 620) {
      x = 0;
      y += row;
      row = 0;
    }
    group.forEach((i, k) => {
      const angle = (2 * Math.PI * k) / group.length - Math.PI / 2;
      place[i] = [x + half + radius * Math.cos(angle), y + half_height + radius * Math.sin(angle), angle, radius];
    });
    x += 2 * half;
    row = Math.max(row, 2 * half_height);
    width = Math.max(width, x);
  }
  const svg = make("svg", { viewBox: "0 0 " + width + " " + (y + row), role: "img", "aria-label": "Graph of the pairs", style: "max-width:" + width + "px" });
  const looks = { used: ["var(--text)", ""], dropped: ["var(--bad)", "5 3"], not_connecting: ["var(--dim)", "3 3"] };
  state.graph_edges = 0;
  for (const e of report.edges) {
    if (!looks[e.status]) continue;
    const [a, b] = [place[e.source], place[e.target]], [stroke, dashes] = looks[e.status];
    ++state.graph_edges;
    svg.append(make("line", { x1: a[0], y1: a[1], x2: b[0], y2: b[1], style: "stroke:" + stroke, "stroke-width": 1 + 3 * e.overlap, "stroke-dasharray": dashes, "stroke-opacity": 0.75 },
      make("title", {}, scans[e.source].name + " and " + scans[e.target].name + ", " + words[e.status] + ", overlap " + percent(e.overlap) + (e.reason ? ": " + e.reason : ""))));
  }
  for (const scan of scans) {
    const [px, py, angle, radius] = place[scan.index];
    svg.append(make("circle", { cx: px, cy: py, r: dot_radius, fill: scan.css, style: "stroke:var(--text)" }, make("title", {}, scan.name)));
    const out = radius ? dot_radius + 4 : 0, to_left = radius && Math.cos(angle) < -0.01, above = Math.abs(Math.cos(angle)) <= 0.01;
    const short = scan.name.length > 16 ? scan.name.slice(0, 7) + "\u2026" + scan.name.slice(-8) : scan.name;
    svg.append(make("text", { x: px + out * Math.cos(angle), y: py + (radius ? (out + 4) * Math.sin(angle) + 4 : 20), "text-anchor": !radius || above ? "middle" : to_left ? "end" : "start" }, short));
  }
  by_id("graph").replaceChildren(svg, make("p", { class: "hint" }, "Full: used. Red dashes: dropped, as it contradicts the model. Grey dashes: not believed, between two components."));
}

function show_matrix() {
  const most = 60, n = scans.length;
  if (n > most) {
    by_id("matrix").replaceChildren(make("p", {}, "Of more than " + most + " scans no matrix is drawn: the residuals are listed pair by pair."));
    return;
  }
  const value = scans.map(() => new Array(n).fill(0));
  for (const o of report.overlaps) value[o.source][o.target] = o.overlap;
  const number = (i) => String(i + 1);
  by_id("matrix").replaceChildren(make("table", {},
    make("thead", {}, make("tr", {}, make("th", {}), ...scans.map((scan, j) => make("th", { scope: "col", title: scan.name }, number(j))))),
    make("tbody", {}, ...scans.map((scan, i) => make("tr", {}, make("th", { scope: "row" }, number(i) + " " + scan.name),
      ...value[i].map((share, j) => (i === j ? make("td", { class: "self" }) : make("td", {
        title: scan.name + " on " + scans[j].name,
        style: share > 0 ? "background:color-mix(in srgb, var(--accent) " + Math.round(15 + 60 * share) + "%, transparent)" : "" }, share > 0 ? Math.round(100 * share) : ""))))))));
}
