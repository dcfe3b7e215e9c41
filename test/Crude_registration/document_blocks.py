# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks README.md, CONTRIBUTING.md, doc/design.md, the README.md of benchmark/ and calibration/, and the pages of the manual, as they stand there.

document_blocks.py SOURCE_DIR names                     links, files, programs, options and public names that they mention
document_blocks.py SOURCE_DIR project DIR               writes a project of all C++ blocks that are no program, into DIR
document_blocks.py SOURCE_DIR shell PROGRAM DIR         runs what shell blocks do with crude_register, PROGRAM, in DIR
document_blocks.py SOURCE_DIR python PROGRAM DIR        runs the Python blocks in DIR, on scans that PROGRAM simulates

C++ blocks may use the names that PREAMBLE declares. Shell blocks and Python blocks find source.ply, target.ply and
scan_0.ply to scan_3.ply.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys

PREAMBLE = r"""
#include <CGAL/Crude_registration.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Polygon_mesh_processing/compute_normal.h>
#include <CGAL/Surface_mesh.h>

#include <iostream>
#include <vector>

namespace CR = CGAL::Crude_registration;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

// Two scans of one body, as images and as meshes, and where their sensors stood; the first one as points, too.
CR::Range_image<Kernel> image, other_image;
std::vector<CR::Range_image<Kernel>> images;
Mesh source, target;
Mesh::Property_map<Mesh::Vertex_index, Kernel::Point_3> vpm;
const Kernel::Point_3 p(0, 0, 0), q(0, 0, 0);
std::vector<Kernel::Point_3> points;
std::vector<Kernel::Vector_3> normals;
CGAL::Aff_transformation_3<Kernel> motion; // the true one
"""

MAIN = r"""
int main()
{
  Mesh body;
  CR::make_statue(body, 64, CR::parameters::random_seed(1));
  const CR::Simulated_scene scene(body);
  const auto box = CGAL::Polygon_mesh_processing::bbox(body);
  const auto seen = [&](const Kernel::Vector_3& direction) {
    auto camera = CR::Range_camera<Kernel>::framing(box, direction, 120);
    return scene.range_image(camera);
  };
  const auto first = seen({-1, 0, -0.2}), second = seen({-1, -0.7, -0.2});
  image = first.image;
  other_image = second.image;
  images = {image, other_image};
  CR::triangulate_range_image(image, source);
  CR::triangulate_range_image(other_image, target);
  vpm = source.points();
  for (const auto v : source.vertices()) {
    points.push_back(source.point(v));
    normals.push_back(CGAL::Polygon_mesh_processing::compute_vertex_normal(v, source));
  }
  motion = second.scene_from_scan.inverse() * first.scene_from_scan;
CALLS}
"""


def documents(root):
    yield from (root / name for name in ("README.md", "CONTRIBUTING.md", "doc/design.md", "doc/cgal_reviewers.md",
                                          "benchmark/README.md", "calibration/README.md"))
    yield from sorted((root / "doc/Crude_registration").glob("*.txt"))


def blocks(root, language):
    """The blocks of a language with the place of each."""
    names = {"cpp": r"\.cpp", "cmake": r"\.cmake", "sh": r"\.sh", "python": r"\.py"}
    for path in documents(root):
        text = path.read_text(encoding="utf-8")
        pattern = rf"^```{language}\n(.*?)^```" if path.suffix == ".md" else rf"\\code\{{{names[language]}\}}\n(.*?)\\endcode"
        for match in re.finditer(pattern, text, re.MULTILINE | re.DOTALL):
            yield f"{path.relative_to(root)}:{text.count(chr(10), 0, match.start(1)) + 1}", match.group(1)


def write_project(root, folder):
    folder.mkdir(parents=True, exist_ok=True)
    text, calls = PREAMBLE, ""
    for place, block in blocks(root, "cpp"):
        if "int main(" in block:
            continue  # README's is a test of its own
        name = "block_" + re.sub(r"\W", "_", place)
        text += f"\nvoid {name}()\n{{\n{block}}}\n"
        calls += f'  std::cout << "{place}" << std::endl;\n  {name}();\n'
    if calls.count("\n") < 10:
        sys.exit("hardly a block of C++ was found")
    (folder / "program.cpp").write_text(text + MAIN.replace("CALLS", calls), encoding="utf-8")
    projects = [block for place, block in blocks(root, "cmake") if place.startswith("doc/")]
    (folder / "CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.22)\nproject(document_blocks LANGUAGES CXX)\nadd_executable(program program.cpp)\n"
        + "".join(projects), encoding="utf-8")


def simulate(program, folder):
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    subprocess.run([program, "simulate", "--output", ".", "--scans", "4", "--angle", "35", "--samples", "150"], cwd=folder,
                   check=True, stdout=subprocess.DEVNULL)
    (folder / "poses.txt").unlink()
    for number, name in enumerate(("source", "target")):
        shutil.copy(folder / f"scan_{number}.ply", folder / f"{name}.ply")


def run_shell(root, program, folder):
    simulate(program, folder)
    environment = {**os.environ, "PATH": f"{pathlib.Path(program).parent}{os.pathsep}{os.environ['PATH']}"}
    ran = 0
    for place, block in blocks(root, "sh"):
        for line in block.splitlines():
            if line.startswith("crude_register "):
                print(place, line, flush=True)
                subprocess.run(["sh", "-e", "-c", line], cwd=folder, check=True, env=environment)
                ran += 1
    if ran < 6:
        sys.exit("hardly a command was found")


def run_python(root, program, folder):
    simulate(program, folder)
    ran = 0
    for place, block in blocks(root, "python"):
        print(place, flush=True)
        arguments = ["source.ply", "target.ply"] if "sys.argv" in block else []
        subprocess.run([sys.executable, "-c", block, *arguments], cwd=folder, check=True)
        ran += 1
    if ran < 5:
        sys.exit("hardly a block of Python was found")


def check_names(root):
    wrong = []
    sources = [p for p in (root / "include").rglob("*.h") if "internal" not in p.parts]
    sources += [*(root / "python/crude_registration").glob("*.py*"), *(root / "doc/Crude_registration/Concepts").glob("*.h"),
                *(root / "include/CGAL/Crude_registration/internal/matching").glob("*.h")]
    words = set()
    for path in sources:
        words.update(re.findall(r"\w+", path.read_text(encoding="utf-8")))
    words.update(("edge_collapse", "help"))  # of CGAL, of Python
    places = [p.name for p in root.iterdir() if p.is_dir() and not p.name.startswith((".", "build"))]
    cmake = "".join(p.read_text(encoding="utf-8") for p in [root / "CMakeLists.txt", *root.glob("*/**/CMakeLists.txt"),
                                                             *root.glob("cmake/*.cmake")] if "build" not in p.parts)
    programs = {p.stem for p in root.glob("*/**/*.cpp")}
    programs.update(("crude_register",), (f"test_{p.stem}" for p in (root / "test/Crude_registration").glob("*.cpp")))
    for path in documents(root):
        text = path.read_text(encoding="utf-8")
        name = path.relative_to(root)
        for target in re.findall(r"\]\(([^)#:]+)\)", text) if path.suffix == ".md" else ():
            if not (path.parent / target).exists():
                wrong.append(f"{name} has a link to {target}, which is not there")
        for span in re.findall(r"`([^`\n]+)`", text):
            if re.fullmatch(r"(\w+::|\w+\.)*\w+\(\)", span):
                if re.split(r"::|\.", span[:-2])[-1] not in words:
                    wrong.append(f"{name} names {span}, which is no public name")
            elif re.fullmatch(r"\w+(/[\w.*-]*)+", span) and span.split("/")[0] in places and "*" not in span:
                if not (root / span).exists():
                    wrong.append(f"{name} names {span}, which is not there")
            elif re.fullmatch(r"CRUDE_REGISTRATION_\w+", span) and span not in cmake:
                wrong.append(f"{name} names {span}, of which CMake knows nothing")
        for place, block in blocks(root, "sh"):
            if not place.startswith(f"{name}:"):
                continue
            for script in re.findall(r"(?:^|[ &])(\./\w+\.sh|tools/\w+\.sh)", block, re.MULTILINE):
                if not os.access(root / script, os.X_OK):
                    wrong.append(f"{place} runs {script}, which cannot be run")
            for program in re.findall(r"build/(?:bin|test)/(\w+)", block):
                if program not in programs:
                    wrong.append(f"{place} runs {program}, which is no program")
            for target in re.findall(r"--target (\w+)", block):
                if target not in programs and not re.search(rf"add_custom_target\({target}\b", cmake):
                    wrong.append(f"{place} builds {target}, which is no target")
            for option in re.findall(r"-D (CRUDE_REGISTRATION_\w+)", block):
                if option not in cmake:
                    wrong.append(f"{place} sets {option}, of which CMake knows nothing")
    sys.exit("\n".join(wrong) or 0)


def main():
    root = pathlib.Path(sys.argv[1])
    task, rest = sys.argv[2], sys.argv[3:]
    if task == "names":
        check_names(root)
    elif task == "project":
        write_project(root, pathlib.Path(rest[0]))
    else:
        {"shell": run_shell, "python": run_python}[task](root, rest[0], pathlib.Path(rest[1]))


main()
