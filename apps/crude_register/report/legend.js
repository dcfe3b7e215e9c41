
// What is said below the view: of the point that was picked, and of the colours.

function show_picked(best) {
  const text = by_id("picked");
  if (!best) {
    state.picked = null;
    text.textContent = "";
    return;
  }
  const scan = scans[best.scan], own = point_of(scan, best.index), common = apply(motion_of(scan), own);
  const met = met_of(scan), m = met ? meeting_of(met[best.index]) : { step: null, in_free_space: false };
  const spacings = m.step === null ? null : m.step * spacings_of_step;
  const place = (p) => "(" + p.map(coordinate).join(", ") + ")";
  const limit = report.reach_in_spacings;
  let distance = "no surface of " + (is_pair ? "the other scan" : "another scan") + " near";
  if (spacings !== null) {
    const is_far = Math.abs(m.step) === report.steps_of_reach;
    distance = (is_far ? limit + " or more" : digits(Math.abs(spacings), 2)) + " sampling distances (" +
      (is_far ? "from " : "") + digits(Math.abs(spacings) * report.spacing, 3) + ") " +
      (spacings < 0 ? "behind" : spacings > 0 ? "in front of" : "from") + " the other surface";
  }
  state.picked = { scan: best.scan, index: best.index, place: own, common, spacings, in_free_space: m.in_free_space };
  text.replaceChildren(make("span", { class: "swatch", style: "background:" + scan.css }),
    " " + scan.name + ", " + place(own) + " in its file" +
    (report.poses.length ? ", " + place(common) + " in the common frame" : "") + ": " + distance +
    (m.in_free_space ? "; in free space" : "") + ".");
}

// What the lines are that are drawn of so many corresponding points.
function show_correspondence(count) {
  const text = by_id("correspondence_text");
  text.hidden = count === 0;
  text.textContent = count === 0 ? "" :
    (count === 2 ? "Thick lines: the pair of oriented points of the source, and the pair of the target that it was matched with" :
      "Thick lines: the trihedron of the source, three edges from one vertex, and the one of the target that it was matched with") +
    ". This match proposed the answer. Thin lines lead from each point to its match. The motion was then estimated again from all that agrees, so that it need not take them onto each other; the runners-up come from other matches.";
}

function show_legend() {
  const legend = by_id("legend");
  if (state.colour === "scan") {
    const some = shown_scans();
    legend.replaceChildren(...some.slice(0, 12).map((scan) =>
      make("span", {}, make("span", { class: "swatch", style: "background:" + scan.css }), " " + (scan.role ? scan.role + ": " : "") + scan.name + "  ")),
      some.length > 12 ? "and " + (some.length - 12) + " more" : "");
  } else if (state.colour === "distance") {
    const { behind, on, before, none } = colours_of_distance;
    legend.replaceChildren(
      make("div", { class: "ramp", style: "background:linear-gradient(to right," + [behind, on, before].map(css_of).join(",") + ")" }),
      make("div", { class: "ramp_ends" }, make("span", {}, report.reach_in_spacings + " sampling distances behind"), make("span", {}, "on the other surface"),
        make("span", {}, report.reach_in_spacings + " in front")),
      make("span", {}, make("span", { class: "swatch", style: "background:" + css_of(none) }), " no other surface near"));
  } else {
    const blind = is_pair ? scans.filter((scan) => !scan.has_free_space) : [];
    const unseen = scans.filter((scan) => !scan.has_free_space).length;
    let note = "";
    if (blind.length) note = " What the sensor of " + blind.map((scan) => "the " + scan.role).join(" and of ") + " saw to be empty is not known.";
    else if (unseen) note = " Of " + unseen + " scans it is not known what their sensors saw to be empty.";
    legend.replaceChildren(make("span", {}, make("span", { class: "swatch", style: "background:" + css_of(colour_of_violation) }),
      " where another scan's sensor saw that there is nothing, by more than " + report.free_space_depth_in_spacings + " sampling distances." + note));
  }
}
