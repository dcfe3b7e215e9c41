// What a report does in a browser: report_page.mjs CHROMIUM CRUDE_REGISTER FOLDER, the folder being one to work in. Ends
// with 1 where something is not as it should be.

import { spawnSync } from "node:child_process";
import { mkdirSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { Browser, Page } from "./browser.mjs";

const [browser_program, program, folder] = process.argv.slice(2);
let failures = 0;

function check(is_so, text) {
  if (is_so) return;
  ++failures;
  console.log("FAILED: " + text);
}

// The program in the folder: what it prints. It is to end with the exit code.
function run(code, ...words) {
  const answer = spawnSync(program, words, { cwd: folder, encoding: "utf8" });
  check(answer.status === code, `exit code ${answer.status} instead of ${code}: crude_register ${words.join(" ")}: ${answer.stderr}`);
  return answer.stdout;
}

// Reports of two scans of a body, by pairs and by trihedra, of a motion that is some sampling distances off, of two planes, of two bodies, of a run
// that had no time, and of an assembly that leaves out a scan of another body.
function make_reports() {
  rmSync(folder, { recursive: true, force: true });
  mkdirSync(folder, { recursive: true });
  run(0, "simulate", "--output", "body", "--scans", "4", "--samples", "130");
  run(0, "simulate", "--output", "other", "--scans", "2", "--samples", "110", "--seed", "5");
  const [source, target] = [0, 1].map((i) => join("body", `scan_${i}.ply`)), other = join("other", "scan_1.ply");
  const answer = JSON.parse(run(0, "register", source, target, "--report", "pair.html", "--json"));
  run(0, "simulate", "--output", "fine", "--scans", "4", "--samples", "260"); // fine enough for trihedra that fit
  run(0, "register", ...[0, 1].map((i) => join("fine", `scan_${i}.ply`)), "--method", "trihedra", "--report", "trihedra.html");
  const spacing = 2.5 / 130; // about: the body is as large, and the grid has so many columns
  writeFileSync(join(folder, "motion.txt"), answer.target_from_source.map((row) => [...row.slice(0, 3), row[3] + 2 * spacing].join(" ")).join("\n"));
  run(2, "judge", source, target, "--motion", "motion.txt", "--report", "judged.html");
  for (const [name, width, height] of [["plane_0.xyz", 40, 30], ["plane_1.xyz", 30, 40]]) {
    let text = "";
    for (let i = 0; i < width; ++i) for (let j = 0; j < height; ++j) text += `${i} ${j} 0\n`;
    writeFileSync(join(folder, name), text);
  }
  run(2, "register", "plane_0.xyz", "plane_1.xyz", "--report", "plane.html");
  run(3, "register", source, other, "--report", "apart.html");
  run(3, "register", source, target, "--time-budget", "1e-9", "--report", "early.html");
  run(0, "assemble", ...[0, 1, 2, 3].map((i) => join("body", `scan_${i}.ply`)), other, "--report", "assembly.html");
  run(0, "simulate", "--output", "many", "--scans", "30", "--samples", "520");
  run(0, "assemble", "many", "--report", "many.html");
}

const state = (page, path = "") => page.value("JSON.parse(JSON.stringify(report_state))" + path);

// Chosen or clicked as a user does it, wherever it is on the page.
async function press(page, selector) {
  await page.value(`document.querySelector(${JSON.stringify(selector)}).click()`);
  await page.drawn();
}

async function set(page, selector, value) {
  await page.value(`{
    const input = document.querySelector(${JSON.stringify(selector)});
    input.value = ${JSON.stringify(value)};
    input.dispatchEvent(new Event("input", { bubbles: true }));
    input.dispatchEvent(new Event("change", { bubbles: true }));
  }`);
  await page.drawn();
}

// Of a canvas: a number that tells its pictures apart, and the share of pixels that are not as those in its corners.
function picture(page, id) {
  return page.value(`(() => {
    const canvas = document.getElementById("${id}"), copy = document.createElement("canvas");
    copy.width = canvas.width;
    copy.height = canvas.height;
    const context = copy.getContext("2d");
    context.drawImage(canvas, 0, 0);
    const p = context.getImageData(0, 0, copy.width, copy.height).data;
    let hash = 0, drawn = 0;
    for (let i = 0; i < p.length; i += 4) {
      hash = (Math.imul(hash, 31) + p[i] + 256 * p[i + 1] + 65536 * p[i + 2]) | 0;
      drawn += p[i] !== p[0] || p[i + 1] !== p[1] || p[i + 2] !== p[2];
    }
    return { hash, drawn: (4 * drawn) / p.length };
  })()`);
}

// The middle of an element, in the window; scrolled to.
async function middle(page, id) {
  return page.value(`(() => {
    const element = document.getElementById("${id}");
    element.scrollIntoView({ block: "center", behavior: "instant" });
    const box = element.getBoundingClientRect();
    return { x: box.left + box.width / 2, y: box.top + box.height / 2, width: box.width, height: box.height };
  })()`);
}

// Whether a control changes the picture, and changes it back.
async function changes(page, text, id, act, undo = null) {
  const before = await picture(page, id);
  await act();
  const after = await picture(page, id);
  check(before.hash !== after.hash, text + " does not change the picture");
  if (!undo) return;
  await undo();
  check((await picture(page, id)).hash === before.hash, text + " is not undone");
}

// What holds of all pages.
async function opened(browser, name, size) {
  const page = await Page.open(browser, join(folder, name), size);
  page.name = name + " at " + size.width + (size.dark ? ", dark" : "");
  await page.until("window.report_state && report_state.ready && report_state.frames > 0");
  await page.drawn();
  const { width, inner } = await page.value("({ width: document.documentElement.scrollWidth, inner: innerWidth })");
  check(width <= inner, page.name + ": wider than the window, " + width);
  const drawn = (await picture(page, "view")).drawn;
  check(drawn >= 0.05, page.name + ": only " + drawn + " of the view is drawn on");
  check((await picture(page, "section")).drawn > 0.001, page.name + ": the section is empty");
  return page;
}

async function closed(page) {
  check(!(await state(page, ".context_lost")), page.name + ": the graphics context is lost");
  check(page.complaints.length === 0, page.name + ": " + page.complaints.join("; "));
  check(page.requests.length === 1 && page.requests[0] === page.url, page.name + ": asks for " + page.requests.join(", "));
  writeFileSync(join(folder, page.name.replaceAll(/[^a-z0-9]+/g, "_") + ".png"), await page.screenshot());
  await page.close();
}

async function check_view(page) {
  const view = await middle(page, "view");
  const camera = () => state(page, ".camera");
  const same = (a, b) => JSON.stringify(a) === JSON.stringify(b);
  const start = await camera();
  await changes(page, page.name + ": to turn", "view", () => page.drag(view.x, view.y, 60, 25));
  const turned = await camera();
  check(!same(start.turn, turned.turn) && same(start.target, turned.target), page.name + ": a drag turns, and no more");
  await changes(page, page.name + ": to shift", "view", () => page.drag(view.x, view.y, 30, 30, { modifiers: 8 }));
  const shifted = await camera();
  check(same(turned.turn, shifted.turn) && !same(turned.target, shifted.target), page.name + ": a drag with Shift shifts, and no more");
  await changes(page, page.name + ": the right button", "view", () => page.drag(view.x, view.y, 20, 0, { button: "right", buttons: 2 }));
  await changes(page, page.name + ": the wheel", "view", async () => {
    await page.mouse("mouseWheel", view.x, view.y, { deltaX: 0, deltaY: -200, button: "none", buttons: 0 });
    await page.drawn();
  });
  check((await camera()).distance < shifted.distance, page.name + ": the wheel does not zoom in");
  const near = (await camera()).distance;
  await press(page, "#zoom_out");
  check((await camera()).distance > near, page.name + ": the button does not zoom out");
  await press(page, "#zoom_in");
  check(Math.abs((await camera()).distance / near - 1) < 1e-9, page.name + ": the button does not zoom in");
  await page.value("document.getElementById('view').focus()");
  for (const key of ["ArrowLeft", "-", "Home"]) {
    const before = await camera();
    await page.send("Input.dispatchKeyEvent", { type: "keyDown", key, text: key === "-" ? "-" : undefined });
    await page.send("Input.dispatchKeyEvent", { type: "keyUp", key });
    await page.drawn();
    check(!same(before, await camera()), page.name + ": the key " + key + " does nothing");
  }
  check(same(start, await camera()), page.name + ": the key Home does not reset the view");
  for (const [axis, towards] of [["x", [1, 0, 0]], ["y", [0, -1, 0]], ["z", [0, 0, 1]]]) {
    await press(page, "#look_" + axis);
    const [a, b, c, w] = (await camera()).turn; // the third column of its matrix
    const looks = [2 * (a * c + w * b), 2 * (b * c - w * a), 1 - 2 * (a * a + b * b)];
    check(looks.every((x, k) => Math.abs(x - towards[k]) < 1e-9), page.name + ": the view is not along " + axis);
  }
  await press(page, "#reset_view");
  check(same(start, await camera()), page.name + ": Reset does not reset the view");
  await changes(page, page.name + ": the size of points", "view", () => set(page, "#point_size", "2.5"), () => set(page, "#point_size", "1"));
  for (const colour of ["distance", "free_space"]) {
    const before = await picture(page, "view");
    await press(page, `input[name=colour][value=${colour}]`);
    check((await state(page, ".colour")) === colour, page.name + ": the colour is not " + colour);
    check((await picture(page, "view")).hash !== before.hash, page.name + ": the colour " + colour + " is not seen");
    check((await page.value("document.getElementById('legend').textContent")).length > 20, page.name + ": no legend of " + colour);
  }
  await press(page, "input[name=colour][value=scan]");
  for (const layout of ["files", "apart"]) {
    await changes(page, page.name + ": the position " + layout, "view", () => press(page, `input[name=layout][value=${layout}]`));
    check((await state(page, ".layout")) === layout, page.name + ": the position is not " + layout);
  }
  await press(page, "input[name=layout][value=together]");
  check(same(start, await camera()), page.name + ": the positions do not lead back");
  await changes(page, page.name + ": the plane", "view", () => press(page, "#show_plane"), () => press(page, "#show_plane"));
  await changes(page, page.name + ": to cut", "view", () => press(page, "#cut"), () => press(page, "#cut"));
}

// A click tells of the point that is drawn there: found again from all points by the matrices of the page.
async function check_picking(page) {
  const view = await middle(page, "view");
  let picked = null;
  for (let k = 0; k < 40 && !picked; ++k) { // from the middle outwards, until there is a point
    const angle = 2.4 * k, radius = 0.02 * k * view.height;
    await page.click(view.x + radius * Math.cos(angle), view.y + radius * Math.sin(angle));
    picked = await state(page, ".picked");
  }
  check(picked !== null, page.name + ": no point can be picked");
  if (!picked) return;
  const text = await page.value("document.getElementById('picked').textContent");
  const name = await page.value(`scans[${picked.scan}].name`);
  check(text.includes(name), page.name + ": the text of a picked point does not name its scan: " + text);
  check(text.includes("sampling distances") || text.includes("no surface"), page.name + ": the text of a picked point has no distance: " + text);
  const moved = await page.value(`(() => {
    const scan = report.scans[${picked.scan}], m = report.poses[report_state.pose].motions[${picked.scan}] || [[1,0,0,0],[0,1,0,0],[0,0,1,0]];
    return m.map((r) => r[0] * ${picked.place[0]} + r[1] * ${picked.place[1]} + r[2] * ${picked.place[2]} + r[3]);
  })()`);
  check(moved.every((x, k) => Math.abs(x - picked.common[k]) < 1e-9 * (1 + Math.abs(x))), page.name + ": the picked point is not where the motion takes it");
  check(!(await page.value("document.getElementById('pick_mark').hidden")), page.name + ": the picked point is not marked");
  await page.click(view.x - view.width / 2 + 5, view.y - view.height / 2 + 5);
  check((await state(page, ".picked")) === null, page.name + ": a click beside the scans picks a point");
}

async function check_section(page) {
  const start = await state(page, ".section");
  check(start.points > 0, page.name + ": no points are near the plane of the section");
  await changes(page, page.name + ": the position of the section", "section", () => set(page, "#section_position", "300"));
  const moved = await state(page, ".section");
  check(moved.position === 0.3 && moved.value < start.value, page.name + ": the section is not moved");
  await set(page, "#section_thickness", "8");
  const thick = await state(page, ".section");
  check(thick.thickness === 8 && thick.points > moved.points, page.name + ": a thick section has no more points");
  // Counted again, from the bytes of the page.
  const counted = await page.value(`(() => {
    const s = report_state.section, half = s.thickness * report.spacing / 2;
    let n = 0;
    scans.forEach((scan, j) => {
      if (!report_state.visible[j] || (scan.component !== undefined && scan.component !== report_state.component)) return;
      const m = report.poses[report_state.pose].motions[j] || [[1,0,0,0]];
      for (let i = 0; i < scan.count; ++i) {
        const p = point_of(scan, i);
        n += Math.abs(m[0][0] * p[0] + m[0][1] * p[1] + m[0][2] * p[2] + m[0][3] - s.value) <= half;
      }
    });
    return n;
  })()`);
  check(Math.abs(counted - thick.points) <= 2, page.name + ": " + thick.points + " points in the section instead of " + counted);
  for (const axis of ["y", "z", "view"]) {
    await changes(page, page.name + ": a section across " + axis, "section", () => set(page, "#section_axis", axis));
    check((await state(page, ".section.axis")) === axis, page.name + ": the section is not across " + axis);
  }
  await press(page, "#section_zoom_in");
  check((await state(page, ".section.zoom")) > 1, page.name + ": the section does not zoom");
  const section = await middle(page, "section");
  await changes(page, page.name + ": to shift the section", "section", () => page.drag(section.x, section.y, 25, 10));
  await press(page, "#section_zoom_out");
  await press(page, "#section_reset");
  check((await state(page, ".section.zoom")) === 1, page.name + ": the section is not reset");
  for (const [selector, value] of [["#section_axis", "x"], ["#section_position", "500"], ["#section_thickness", "2"]]) await set(page, selector, value);
  check((await state(page, ".section.points")) === start.points, page.name + ": the section does not come back");
}

async function check_switches(page) {
  const all = await state(page, ".drawn_points");
  await changes(page, page.name + ": a switch of a scan", "view", () => press(page, "input[data-scan='1']"));
  check(!(await state(page, ".visible[1]")), page.name + ": a scan is not switched off");
  const shown = await page.value("scans[1].count");
  check((await state(page, ".drawn_points")) === all - shown, page.name + ": a scan that is switched off is drawn");
  await press(page, "input[data-scan='1']");
  check((await state(page, ".drawn_points")) === all, page.name + ": a scan is not switched on");
}

async function check_theme(page) {
  const back = () => page.value("getComputedStyle(document.body).backgroundColor");
  for (const [theme, colour] of [["dark", "rgb(22, 24, 28)"], ["light", "rgb(255, 255, 255)"]]) {
    await set(page, "#theme", theme);
    check((await state(page, ".theme")) === theme && (await back()) === colour, page.name + ": the page is not " + theme);
  }
  await set(page, "#theme", "auto");
}

async function check_motions(page) {
  const poses = await page.value("report.poses");
  check(poses.length >= 2, page.name + ": there is one motion only");
  const start = await state(page);
  const seen = new Set([(await picture(page, "view")).hash]);
  for (let k = 1; k < poses.length; ++k) {
    await press(page, "#next_pose");
    check((await state(page, ".pose")) === k, page.name + ": the next motion is not shown");
    const matrix = await page.value("document.getElementById('pose_matrix').textContent");
    check(matrix.startsWith(poses[k].motions[0].map((row) => row.join(" ")).join("\n")), page.name + ": the matrix is not that of the motion");
    seen.add((await picture(page, "view")).hash);
  }
  check(seen.size > 1, page.name + ": all motions look the same");
  check(await page.value("document.getElementById('next_pose').disabled"), page.name + ": there is a motion after the last");
  await press(page, "#poses input[value='0']");
  check((await state(page, ".pose")) === 0, page.name + ": the first motion is not shown");
  check(JSON.stringify((await state(page)).histogram) === JSON.stringify(start.histogram), page.name + ": the histogram does not come back");
}

async function check_pair(page) {
  // Two thirds of the points lie on the other scan, of which the simulated noise is a tenth of a sampling distance.
  const histogram = await state(page, ".histogram");
  for (const side of histogram) {
    check(side.near > 0.5 * side.points && side.rms < 0.5, page.name + ": the points are not on the other scan: " + JSON.stringify(side));
    check(side.violating < 0.01 * side.points, page.name + ": points in free space: " + JSON.stringify(side));
  }
  check((await page.value("document.querySelectorAll('#numbers tr').length")) === (await page.value("report.numbers.length")), page.name + ": numbers are missing");
  check(await page.value("report.numbers.every((n) => n.name && n.value && n.meaning.length > 15)"), page.name + ": a number is not explained");
  check(await page.value("[...document.querySelectorAll('#verdict p')].every((p) => p.textContent.length > 20)"), page.name + ": there is no verdict in words");
}

// The points of a pair or a trihedron: on the scans, near each other as the motion takes them, and seen wherever the scans
// lie.
async function check_correspondence(page, number) {
  const off = await page.value(`(() => {
    const distance = (p, q) => Math.hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
    const to_scan = (scan, p) => {
      let least = Infinity;
      for (let i = 0; i < scan.count; ++i) least = Math.min(least, distance(p, point_of(scan, i)));
      return least;
    };
    const largest = (of) => Math.max(...report.correspondence.map(of)) / report.spacing;
    return {
      number: report.correspondence.length,
      scans: [0, 1].map((side) => largest((pair) => to_scan(scans[side], pair[side]))),
      matches: largest(([s, t]) => distance(apply(report.poses[0].motions[0], s), t)),
      size: Math.max(...scans[1].size) / report.spacing,
    };
  })()`);
  check(off.number === number, page.name + ": " + off.number + " corresponding points");
  check(off.scans.every((d) => d < 0.02 * off.size), page.name + ": corresponding points are not on the scans: " + JSON.stringify(off));
  check(off.matches < 0.1 * off.size, page.name + ": corresponding points are not near each other: " + JSON.stringify(off));
  for (const layout of ["files", "apart", "together"]) {
    await press(page, `input[name=layout][value=${layout}]`);
    await changes(page, page.name + ": what the motion was found by, " + layout, "view", () => press(page, "#correspondence"), async () => {
      check((await state(page, ".correspondence")) === number, page.name + ": corresponding points are missing");
      const text = await page.value("document.getElementById('correspondence_text').textContent");
      check(text.includes(number === 2 ? "pair of oriented points" : "trihedron"), page.name + ": it is not said what is drawn: " + text);
      if (layout === "apart") writeFileSync(join(folder, page.name.replaceAll(/[^a-z0-9]+/g, "_") + "_found_by.png"), await page.screenshot());
      await press(page, "#correspondence");
    });
    check((await state(page, ".correspondence")) === 0, page.name + ": corresponding points stay");
    check(await page.value("document.getElementById('correspondence_text').hidden"), page.name + ": the text of what is not drawn stays");
  }
}

async function check_assembly(page) {
  const report = await page.value("({ scans: report.scans, edges: report.edges, overlaps: report.overlaps, components: report.components })");
  const count = (selector) => page.value(`document.querySelectorAll(${JSON.stringify(selector)}).length`);
  check((await count("#graph circle")) === report.scans.length, page.name + ": scans are missing in the graph");
  check((await count("#graph line")) === report.edges.filter((e) => e.status !== "without_overlap").length, page.name + ": pairs are missing in the graph");
  check((await count("#matrix tbody tr")) === report.scans.length && (await count("#matrix tbody td")) === report.scans.length ** 2, page.name + ": the matrix is not square");
  check((await count("#residuals tbody tr")) === report.overlaps.length, page.name + ": residuals are missing");
  check((await count("#pairs tbody tr")) === report.edges.length, page.name + ": pairs are missing");
  await set(page, "#pair_filter", "used");
  check((await count("#pairs tbody tr")) === report.edges.filter((e) => e.status === "used").length, page.name + ": used pairs are missing");
  await set(page, "#pair_filter", "all");
  const left_out = await page.value("document.getElementById('left_out').textContent");
  for (const scan of report.scans) if (scan.reason) check(left_out.includes(scan.name) && left_out.includes(scan.reason), page.name + ": it is not told why " + scan.name + " is left out");
  check(report.scans.some((scan) => scan.reason), page.name + ": no scan is left out");
  await changes(page, page.name + ": none", "view", () => press(page, "#show_none"), () => press(page, "#show_all"));
  await press(page, "#residuals tbody button");
  const first = await page.value("[...report.overlaps].sort((a, b) => b.residual - a.residual)[0]");
  const visible = await state(page, ".visible");
  check(visible.every((is, i) => is === (i === first.source || i === first.target)), page.name + ": not the two scans of a residual are shown");
  await press(page, "#show_all");
  await set(page, "#component", "1");
  check((await state(page, ".component")) === 1, page.name + ": the other component is not shown");
  check((await state(page, ".drawn_points")) === (await page.value("scans.filter((s) => s.component === 1).reduce((n, s) => n + s.count, 0)")), page.name + ": not the scans of the component are drawn");
  await set(page, "#component", "0");
}

// Without three.js, as where there is none: the rest of the page does its work.
function without_three(name) {
  const text = readFileSync(join(folder, name), "utf8"), begin = text.indexOf('<script id="three">'), end = text.indexOf("</script>", begin);
  const file = "no_three_" + name;
  writeFileSync(join(folder, file), text.slice(0, begin) + text.slice(end + 9));
  return file;
}

make_reports();
const browser = new Browser(browser_program);
try {
  const wide = { width: 1280, height: 900 }, narrow = { width: 600, height: 900 };
  let page = await opened(browser, "pair.html", wide);
  await check_view(page);
  await check_picking(page);
  await check_section(page);
  await check_switches(page);
  await check_theme(page);
  await check_motions(page);
  await check_pair(page);
  await check_correspondence(page, 2);
  await closed(page);

  page = await opened(browser, "trihedra.html", wide);
  await check_correspondence(page, 4);
  await closed(page);

  page = await opened(browser, "pair.html", { ...narrow, dark: true });
  await check_picking(page);
  await check_section(page);
  await closed(page);

  page = await opened(browser, "judged.html", wide);
  check((await page.value("report.poses[0].name")) === "Given", page.name + ": the motion that was given is not the first");
  check(await page.value("document.getElementById('correspondence_choice').hidden"), page.name + ": nobody knows what it was found by");
  await check_motions(page);
  await closed(page);

  // Flat, and so many motions that none is better: still drawn.
  page = await opened(browser, "plane.html", wide);
  check((await page.value("document.querySelector('.verdict').classList.contains('doubtful')")), page.name + ": planes are not doubtful");
  await check_motions(page);
  await closed(page);

  page = await opened(browser, "apart.html", narrow);
  check((await state(page, ".layout")) === "apart", page.name + ": scans that are not registered are not side by side");
  check((await page.value("document.querySelector('.verdict').classList.contains('bad')")), page.name + ": the verdict is not bad");
  await closed(page);

  // Ended before there was anything to tell of them: the scans alone.
  page = await opened(browser, "early.html", narrow);
  check(await page.value("document.getElementById('pose_part').hidden"), page.name + ": there are motions of scans that were not prepared");
  await closed(page);

  for (const size of [wide, { ...narrow, dark: true }]) {
    page = await opened(browser, "assembly.html", size);
    await check_assembly(page);
    if (size === wide) {
      await check_view(page);
      await check_picking(page);
      await check_section(page);
      await check_switches(page);
    }
    await closed(page);
  }

  // Of thirty scans of some 40,000 samples. The time is told, not checked: it depends on the machine.
  page = await opened(browser, "many.html", wide);
  const { size } = statSync(join(folder, "many.html"));
  check(size <= 12e6, page.name + ": a file of " + size + " bytes");
  const { points, first_frame } = await page.value("({ points: scans.reduce((sum, scan) => sum + scan.count, 0), first_frame: report_state.first_frame_ms })");
  console.log(`${page.name}: ${points} points in ${size} bytes, the first frame after ${Math.round(first_frame)} ms`);
  await closed(page);

  page = await Page.open(browser, join(folder, without_three("pair.html")), wide);
  page.name = "pair.html without three.js";
  await page.until("window.report_state && report_state.ready");
  await page.drawn();
  check(!(await state(page, ".has_view")) && (await page.value("document.getElementById('view_frame').hidden")), page.name + ": has a view");
  await check_section(page);
  await closed(page);
} catch (error) {
  ++failures;
  console.log("FAILED: " + (error.stack ?? error));
} finally {
  await browser.close();
}
console.log(failures === 0 ? "the reports do what they should" : failures + " failures");
process.exit(failures === 0 ? 0 : 1);
