#!/usr/bin/env python3
# Copyright (c) 2026 The Crude_registration authors.
# All rights reserved.
#
# This file is part of the CGAL package Crude_registration.
#
# SPDX-License-Identifier: GPL-3.0-or-later

"""Makes the manual's figures anew, of scans that the programs of this project generate.

make_figures.py PROGRAMS FOLDER, where PROGRAMS is the folder of the built programs (bin) and FOLDER that of the
figures. It needs python3-matplotlib, and chromium for the picture of the report page. The target `figures` calls it.
"""

import json
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile

import matplotlib
matplotlib.use("Agg")
matplotlib.rcParams["svg.hashsalt"] = "table 3"  # the same file every time
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection

LIGHT = np.array([0.4, 0.5, 0.77])
SURFACE_TYPES = [("planar", "#9aa5b1"), ("parabolic", "#e0c341"), ("elliptic", "#e08b3e"), ("hyperbolic", "#3e7fc1")]
OUTCOMES = [("agrees", "#2b9348"), ("disagrees", "#e08b3e"), ("in free space", "#d00000"), ("missing", "#8e44ad"),
            ("unknown", "#b8bec6")]
SOURCE, TARGET = "#e08b3e", "#3e7fc1"


def run(program, *arguments, may_fail=False, is_quiet=False):
    """Runs a program. Where it may say that scans are not registered, its exit code is no error."""
    result = subprocess.run([program, *map(str, arguments)], stdout=subprocess.PIPE, text=True, check=False,
                            stderr=subprocess.DEVNULL if is_quiet else None)
    if result.returncode != 0 and not (may_fail and result.returncode in (2, 3)):
        sys.exit(f"{program} {' '.join(map(str, arguments))}: exit code {result.returncode}")
    return result.stdout


def frame(axes, points, title):
    low, high = points[:, :2].min(0), points[:, :2].max(0)
    middle, half = (low + high) / 2, 0.53 * (high - low).max()
    axes.set_xlim(middle[0] - half, middle[0] + half)
    axes.set_ylim(middle[1] - half, middle[1] + half)
    axes.set_aspect("equal")
    axes.axis("off")
    axes.set_title(title, fontsize=9)


def draw_faces(axes, mesh, colours, edges="none", width=0.1):
    """The faces as the sensor sees them, the far ones first; it looks along -z."""
    points, faces = np.array(mesh["points"]), np.array(mesh["faces"])
    corners = points[faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1), 1e-30)[:, None]
    shade = (0.45 + 0.55 * np.clip(np.abs(normals @ LIGHT), 0, 1))[:, None]
    rgb = np.array([matplotlib.colors.to_rgb(c) for c in colours]) if not isinstance(colours, str) else \
        np.tile(matplotlib.colors.to_rgb(colours), (len(faces), 1))
    order = np.argsort(corners[:, :, 2].mean(1))
    axes.add_collection(PolyCollection(corners[order][:, :, :2], facecolors=(rgb * shade)[order], edgecolors=edges,
                                       linewidths=width))
    return points


def draw_trihedron(axes, corners):
    corners = np.array(corners)
    for end, colour in zip(corners[1:], ("#d00000", "#2b9348", "#1d3fbb")):
        axes.plot(*zip(corners[0, :2], end[:2]), color=colour, linewidth=2.2, zorder=5)
        axes.plot(*end[:2], "o", color=colour, markersize=4, zorder=6)
    axes.plot(*corners[0, :2], "o", color="black", markersize=5, zorder=7)


def draw_judged(axes, target, judged, title):
    points = np.array(target["dense"]["points"])
    axes.scatter(points[:, 0], points[:, 1], s=0.4, color="#dfe3e8", linewidths=0)
    moved, outcomes = np.array(judged["points"]), np.array(judged["outcomes"])
    order = np.argsort(moved[:, 2])
    colours = np.array([colour for _, colour in OUTCOMES])[outcomes]  # -1, unknown, is the last one
    axes.scatter(moved[order, 0], moved[order, 1], s=2.2, c=colours[order], linewidths=0)
    frame(axes, np.concatenate([points, moved]), title)


def legend(axes, entries, below):
    handles = [plt.Line2D([], [], marker="o", linestyle="none", color=colour, markersize=5) for _, colour in entries]
    axes.legend(handles, [name for name, _ in entries], fontsize=6.5, loc="lower center", ncol=2, frameon=False,
                bbox_to_anchor=(0.5, -below), handletextpad=0.1, columnspacing=0.8)


def statue(programs, folder, work):
    """A body from three sides, by finer scans."""
    meshes = []
    for degrees in (45, 90):
        file = os.path.join(work, f"statue_{degrees}.json")
        run(os.path.join(programs, "method_stages"), "--output", file, "--degrees", degrees, "--samples", 400,
            "--scans-only")
        with open(file, encoding="utf-8") as stream:
            data = json.load(stream)
        meshes += [data["source"]["dense"]] if not meshes else []
        meshes.append(data["target"]["dense"])
    figure, axes = plt.subplots(1, 3, figsize=(9, 3.2))
    for k, mesh in enumerate(meshes):
        frame(axes[k], draw_faces(axes[k], mesh, "#e3e6ea", "face"), "")
    figure.tight_layout()
    picture = os.path.join(work, "statue.png")
    figure.savefig(picture, dpi=100)
    shrink(picture, os.path.join(folder, "statue.png"), 900, 64)
    plt.close(figure)


def stages(programs, folder, work):
    file = os.path.join(work, "stages.json")
    run(os.path.join(programs, "method_stages"), "--output", file)
    with open(file, encoding="utf-8") as stream:
        data = json.load(stream)
    source, target, match = data["source"], data["target"], data["match"]
    candidates = data["candidates"]
    figure, grid = plt.subplots(2, 4, figsize=(10.4, 5.9))
    axes = grid.ravel()

    points = np.array(source["samples"])
    axes[0].scatter(points[:, 0], points[:, 1], s=0.9, c=points[:, 2], cmap="viridis", linewidths=0)
    frame(axes[0], points, f"1 samples, by depth: {len(points)}")
    frame(axes[1], draw_faces(axes[1], source["dense"], "#d7dde4", "#5c6773", 0.1),
          f"2 the mesh: {len(source['dense']['faces'])} triangles")
    types, faces = np.array(source["types"]), np.array(source["dense"]["faces"])
    of_faces = [SURFACE_TYPES[types[f[0]]][1] for f in faces]
    frame(axes[2], draw_faces(axes[2], source["dense"], of_faces), "3 surface types")
    legend(axes[2], [entry for k, entry in enumerate(SURFACE_TYPES) if k in types], 0.09)
    for k, (scan, name, side) in enumerate(((source, "S", "source"), (target, "D", "target"))):
        frame(axes[3 + k], draw_faces(axes[3 + k], scan["simple"], "#e3e8ee", "#5c6773", 0.4),
              f"{4 + k} {name}-mesh: {len(scan['simple']['points'])} vertices; " +
              ("a trihedron" if k == 0 else "its match"))
        draw_trihedron(axes[3 + k], match[side])
    draw_judged(axes[5], target, candidates["rival"], f"6 a rival: P = {candidates['rival']['probability']:.3f}")
    draw_judged(axes[6], target, candidates["proposed"], f"7 the best of {candidates['distinct']}, as proposed")
    draw_judged(axes[7], target, candidates["refined"], f"8 refined and judged: P = {candidates['refined']['probability']:.3f}")
    legend(axes[6], OUTCOMES, 0.17)
    figure.tight_layout()
    picture = os.path.join(work, "stages.png")
    figure.savefig(picture, dpi=100)
    shrink(picture, os.path.join(folder, "stages.png"), 1040)  # with its few violet points, which a palette leaves out
    plt.close(figure)


def status_of(output):
    return re.search(r"^status: *(\w+)", output, re.M).group(1).replace("_", " ")


def outcomes(programs, folder, work):
    """Two views of a body; of a ball; of a body and of another one."""
    crude_register = os.path.join(programs, "crude_register")
    for name, seed, angle in (("a", 5, 45), ("b", 9, 45)):
        run(crude_register, "simulate", "--output", os.path.join(work, name), "--seed", seed, "--angle", angle,
            "--samples", 200)
    for k in range(2):
        with open(os.path.join(work, f"ball_{k}.off"), "w", encoding="ascii") as out:
            write_cap(out, 0.3 * k)
    a, b = os.path.join(work, "a"), os.path.join(work, "b")
    pairs = [("registered", f"{a}/scan_0.ply", f"{a}/scan_1.ply"),
             ("ambiguous", f"{work}/ball_0.off", f"{work}/ball_1.off"),
             ("not registered", f"{a}/scan_0.ply", f"{b}/scan_1.ply")]
    figure, axes = plt.subplots(1, 3, figsize=(9.6, 3.3))
    for k, (expected, source, target) in enumerate(pairs):
        picture = os.path.join(work, f"outcome_{k}.png")
        output = run(crude_register, "register", source, target, "--picture", picture, may_fail=True)
        if status_of(output) != expected:
            sys.exit(f"{source} and {target} are {status_of(output)}, not {expected}")
        axes[k].imshow(plt.imread(picture))
        axes[k].axis("off")
        axes[k].set_title(expected, fontsize=10)
    figure.tight_layout()
    picture = os.path.join(work, "outcomes.png")
    figure.savefig(picture, dpi=85)
    shrink(picture, os.path.join(folder, "outcomes.png"), 820)
    plt.close(figure)


def write_cap(out, turn):
    """A part of a sphere, whose triangulation is turned: nothing tells how it lies."""
    rings, sectors = 24, 72
    out.write(f"OFF\n{1 + rings * sectors} {sectors * (2 * rings - 1)} 0\n0 0 1\n")
    for i in range(1, rings + 1):
        for j in range(sectors):
            polar, azimuth = 1.1 * i / rings, 2 * math.pi * (j + 0.5 * i) / sectors + turn
            out.write(f"{math.sin(polar) * math.cos(azimuth):.6f} {math.sin(polar) * math.sin(azimuth):.6f} "
                      f"{math.cos(polar):.6f}\n")
    for j in range(sectors):
        out.write(f"3 0 {1 + j} {1 + (j + 1) % sectors}\n")
    for i in range(rings - 1):
        for j in range(sectors):
            p, q = 1 + i * sectors + j, 1 + i * sectors + (j + 1) % sectors
            out.write(f"3 {p} {p + sectors} {q}\n3 {q} {p + sectors} {q + sectors}\n")


def table_3(folder):
    """Table 3 of the paper beside that of benchmark/README.md, whose numbers it reads."""
    page = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "benchmark", "README.md")
    with open(page, encoding="utf-8") as stream:
        text = stream.read()
    section = text[text.index("### Table 3"):]
    rows = re.findall(r"^\| (\d) \| (\d+), (\d+) \| [\d.]+ \| (\d+) \| [\d.]+ \| [\d.]+ \| ([\d.]+) \|", section, re.M)
    vertices = [int(row[1]) + int(row[2]) for row in rows]
    figure, axes = plt.subplots(figsize=(6.4, 3.8))
    axes.loglog(vertices, [float(row[3]) for row in rows], "o-", color="#8e44ad", label="the paper, on its machine")
    axes.loglog(vertices, [float(row[4]) for row in rows], "s-", color=TARGET, label="this package")
    axes.set_xlabel("vertices of the S- and the D-mesh together")
    axes.set_ylabel("search for motions, s")
    axes.set_xticks(vertices, [str(v) for v in vertices])
    axes.minorticks_off()
    axes.grid(alpha=0.3)
    axes.legend(fontsize=9)
    figure.tight_layout()
    figure.savefig(os.path.join(folder, "table_3.svg"), metadata={"Date": None})
    plt.close(figure)


def model(programs, folder, work):
    crude_register = os.path.join(programs, "crude_register")
    scans, picture = os.path.join(work, "model"), os.path.join(work, "model.png")
    run(crude_register, "simulate", "--output", scans, "--scans", 8, "--seed", 5, "--samples", 200, "--pedestal", 1.3)
    os.remove(os.path.join(scans, "poses.txt"))
    run(crude_register, "assemble", scans, "--poses", os.path.join(work, "poses.txt"), "--picture", picture)
    shrink(picture, os.path.join(folder, "model.png"), 700, 128)


def shrink(source, target, width, colours=None):
    """`colours`: so many are enough, where they are given."""
    from PIL import Image  # matplotlib needs it, too
    image = Image.open(source).convert("RGB")
    if image.width > width:
        image = image.resize((width, round(image.height * width / image.width)), Image.LANCZOS)
    if colours is not None:
        image = image.quantize(colours)
    image.save(target, optimize=True)


def report(programs, folder, work):
    chromium = shutil.which("chromium")
    if chromium is None:
        print("Without chromium: report.png stays as it is")
        return
    page, picture = os.path.join(work, "report.html"), os.path.join(work, "report.png")
    run(os.path.join(programs, "crude_register"), "register", os.path.join(work, "a", "scan_0.ply"),
        os.path.join(work, "a", "scan_1.ply"), "--report", page)
    run(chromium, "--headless", "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--hide-scrollbars",
        "--enable-unsafe-swiftshader", "--timeout=12000", "--window-size=1280,1000",
        f"--user-data-dir={work}/chromium", f"--screenshot={picture}", "file://" + page, is_quiet=True)
    shrink(picture, os.path.join(folder, "report.png"), 1000)


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    programs, folder = sys.argv[1:]
    with tempfile.TemporaryDirectory() as work:
        statue(programs, folder, work)
        stages(programs, folder, work)
        outcomes(programs, folder, work)
        table_3(folder)
        model(programs, folder, work)
        report(programs, folder, work)


if __name__ == "__main__":
    main()
