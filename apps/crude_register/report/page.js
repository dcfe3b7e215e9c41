
// What ties the controls to what they change.

const the_section = make_section();
const the_view = (the_section.set_frame(null), make_view());

function radio(name, value, text, is_checked, choose) {
  return make("label", {}, make("input", { type: "radio", name, value, checked: is_checked, onchange: choose }), " " + text);
}

function update_all() {
  if (the_view) the_view.update();
  update_rest();
}
function update_rest() {
  the_section.ask();
  show_legend();
  show_histogram();
}

// Where the scans lie.
const has_poses = report.poses.length > 0;
const layouts = [
  ["together", is_pair ? "after: as the motion that is chosen moves them" : "after: as the model has them"],
  ["files", "before: as they are in their files"],
  ["apart", "before: side by side"],
].filter(([value]) => value !== "together" || has_poses);
function choose_layout(layout) {
  state.layout = layout;
  document.querySelector('input[name="layout"][value="' + layout + '"]').checked = true;
  if (the_view) the_view.reset();
  update_all();
}
by_id("layouts").append(...layouts.map(([value, text]) =>
  radio("layout", value, text, false, () => choose_layout(value))));

for (const input of document.getElementsByName("colour"))
  input.addEventListener("change", () => {
    state.colour = input.value;
    update_all();
  });

// The switches of the scans.
const switches = scans.map((scan) => make("input", { type: "checkbox", checked: true, "data-scan": scan.index, onchange: (e) => {
  state.visible[scan.index] = e.target.checked;
  scans_changed();
} }));
const rows = scans.map((scan, i) => make("label", {}, switches[i], " ",
  make("span", { class: "swatch", style: "background:" + scan.css }), " " + (scan.role ? scan.role + ": " : "") + scan.name));
by_id("scan_switches").append(make("div", { class: "list" }, ...rows));
function scans_changed() {
  if (state.picked && !is_shown(scans[state.picked.scan]) && the_view) the_view.unmark();
  the_section.set_range();
  update_all();
}
function show_only(some) {
  state.visible = scans.map((scan) => !some || some.includes(scan.index));
  if (some && some.length) set_component(scans[some[0]].component);
  switches.forEach((input, i) => { input.checked = state.visible[i]; });
  scans_changed();
}
if (scans.length > 2)
  by_id("scan_switches").append(make("div", { class: "buttons" },
    make("button", { type: "button", id: "show_all", onclick: () => show_only(null) }, "all"),
    make("button", { type: "button", id: "show_none", onclick: () => show_only([]) }, "none")));

// The component whose scans are shown.
function set_component(component) {
  if (component === state.component) return;
  state.component = component;
  by_id("component").value = component;
  list_switches();
  the_section.set_frame(the_view);
  if (the_view) {
    the_view.unmark();
    the_view.reset();
  }
}
function list_switches() {
  rows.forEach((row, i) => { row.hidden = !is_pair && scans[i].component !== state.component; });
}
list_switches();
if (!is_pair && report.components > 1) {
  by_id("component_choice").hidden = false;
  for (let c = 0; c < report.components; ++c) {
    const members = scans.filter((scan) => scan.component === c);
    by_id("component").append(make("option", { value: c }, c + 1 + ": " + (members.length === 1 ? members[0].name : members.length + " scans")));
  }
  by_id("component").addEventListener("change", (e) => {
    set_component(Number(e.target.value));
    update_all();
  });
}

function choose_pose(k) {
  state.pose = Math.max(0, Math.min(report.poses.length - 1, k));
  mark_pose();
  the_section.set_range();
  if (state.picked && the_view) the_view.unmark();
  if (state.layout !== "together") choose_layout("together"); // to see what it does
  else update_all();
}
show_poses(choose_pose);
by_id("previous_pose").addEventListener("click", () => choose_pose(state.pose - 1));
by_id("next_pose").addEventListener("click", () => choose_pose(state.pose + 1));

// Of the view.
if (the_view) {
  by_id("reset_view").addEventListener("click", () => the_view.reset());
  by_id("zoom_in").addEventListener("click", () => the_view.zoom(1.25));
  by_id("zoom_out").addEventListener("click", () => the_view.zoom(1 / 1.25));
  for (const [name, towards] of Object.entries({ x: [1, 0, 0], y: [0, -1, 0], z: [0, 0, 1] }))
    by_id("look_" + name).addEventListener("click", () => the_view.reset(directions_towards(towards)));
  by_id("point_size").addEventListener("input", (e) => {
    state.point_size = Number(e.target.value);
    the_view.update();
  });
  by_id("correspondence").addEventListener("change", () => the_view.update());
  by_id("correspondence_choice").hidden = !correspondence.length;
}
function section_changed() {
  the_section.ask();
  if (the_view) the_view.update();
}
for (const [id, name] of [["show_plane", "plane"], ["cut", "cut"]])
  by_id(id).addEventListener("change", (e) => {
    state[name] = e.target.checked;
    section_changed();
  });

// Of the section.
by_id("section_axis").addEventListener("change", (e) => {
  state.section.axis = e.target.value;
  the_section.set_frame(the_view);
  the_section.reset();
  section_changed();
});
by_id("section_position").addEventListener("input", (e) => {
  state.section.position = Number(e.target.value) / 1000;
  section_changed();
});
by_id("section_thickness").addEventListener("input", (e) => {
  state.section.thickness = Number(e.target.value);
  section_changed();
});
by_id("section_zoom_in").addEventListener("click", () => the_section.zoom(1.5));
by_id("section_zoom_out").addEventListener("click", () => the_section.zoom(1 / 1.5));
by_id("section_reset").addEventListener("click", () => the_section.reset());

function set_theme(theme) {
  state.theme = theme;
  if (theme === "auto") delete document.documentElement.dataset.theme;
  else document.documentElement.dataset.theme = theme;
  update_all();
}
by_id("theme").addEventListener("change", (e) => set_theme(e.target.value));
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", update_all);

if (!the_view) {
  for (const id of ["view_frame", "view_hint", "legend", "controls"]) by_id(id).hidden = true;
  const note = by_id("no_view");
  note.hidden = false;
  note.textContent = window.THREE
    ? "This browser shows no WebGL, which the view of the scans needs: the section and the rest of the page do without."
    : "The program that made this page was built without three.js, which a view to turn needs.";
}
state.has_view = Boolean(the_view);
state.layout = has_poses && report.have_common_frame ? "together" : "apart";
document.querySelector('input[name="layout"][value="' + state.layout + '"]').checked = true;
if (the_view) the_view.reset();

// All else waits for the first frame of the view; a page that nobody looks at has none.
function fill() {
  if (state.ready) return;
  show_numbers();
  show_assembly(show_only);
  mark_pose();
  update_rest();
  state.ready = true;
}
if (the_view) {
  const longest_wait_ms = 1000;
  requestAnimationFrame(() => setTimeout(fill));
  setTimeout(fill, longest_wait_ms);
} else fill();
