// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// Scan and ScanFile: what is registered, and where it comes from.

#include "arrays.h"
#include "input.h"
#include "prepare.h"

#include <CGAL/Crude_registration/IO/save_scan.h>
#include <CGAL/Crude_registration/IO/write_file.h>
#include <CGAL/Crude_registration/IO/write_range_image.h>

#include <pybind11/stl.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <sstream>
#include <string>

namespace {

const char* const scan_doc =
    R"(A scan prepared for registration: what is computed once and used by every pair that the scan takes part in.

points: an array of float32 or float64, or anything that numpy.asarray() makes one of:
    (n, 3) the samples of a surface, or, with faces, the vertices of a mesh;
    (rows, columns, 3) the samples of a range image in the order of the scanner, NaN where there is none;
    or the path of a file (see read_scan()), a ScanFile, or a Mesh.
faces: (m, 3) integers, the triangles of a mesh as rows of points, counterclockwise seen from the sensor or from
    outside. Where they are no manifold with consistent faces, they are turned and vertices are split until they are.
normals: (n, 3) floats, of points of shape (n, 3) that have no faces: they tell from which side the surface was seen,
    unless the sensor is given. Of any length; 0 0 0 where there is none.
viewpoint: three numbers, where the sensor stood, in the frame and the unit of the points.
viewing_direction: three numbers, the direction of parallel lines of sight from the sensor into the scene, instead.
method: 'pairs', or 'trihedra' to register the scan by the method of the paper, too, for which it is simplified:
approximation_error: how far, as a squared length, see simplify(); by default as the paper says.
number_of_vertices: or to how many vertices.
cell_size: the edge length of cells in which vertices are grouped before, 0 for no grouping.
time_budget: seconds after which PreparationInterrupted is raised.
progress: a function that is called about every 50 milliseconds with 0.0, and ends the preparation by returning False.

All lengths are in the unit of the points. The arrays are copied. Scans are never changed: threads may share them.

Raises ValueError where there is no surface, a coordinate is infinite (or, but for a range image, NaN), an argument is
out of its range; TypeError where an array is of a wrong type; OSError where a file cannot be read.

>>> import crude_registration as cr
>>> statue = cr.make_statue(resolution=24)
>>> scan = cr.Scan(statue.points, statue.faces)
>>> scan.has_free_space
False
)";

const char* const scan_signature =
    R"(__init__(self, points, faces=None, *, normals=None, viewpoint=None, viewing_direction=None, method='pairs', approximation_error=None, number_of_vertices=None, cell_size=0.0, time_budget=None, progress=None)
--

Prepares a scan.)";

const char* const scan_file_doc =
    R"(What read_scan() and simulate() return: a range image, a mesh or points, in the unit and the frame of the file.

>>> import crude_registration as cr
>>> image = cr.simulate(cr.make_statue(resolution=24), (-1, 0, 0), samples=50)[0]
>>> image.kind
<ScanKind.RANGE_IMAGE: 'range image'>
>>> image.grid.shape
(50, 50)
)";

const char* const read_scan_doc = R"(read_scan(path, *, camera=None)
--

Reads a scan from a file, whatever it holds: PLY (with a range_grid, with faces, or points), PCD, PTX, OFF, OBJ, STL, glTF, LAS,
NPY, PNG (depth images), points as text, and what the C++ function read_scan() lists. Returns a ScanFile.

path: the name of the file; of several scans in a PTX file, 'FILE.ptx#2' is the second one's.
camera: a DepthCamera, or its five numbers fx, fy, cx, cy, scale: of a depth image, whose points are in the frame of the
    camera, which is their sensor.

Raises OSError, whose text names the file and the line.

>>> import crude_registration as cr
>>> camera = cr.DepthCamera(fx=525, fy=525, cx=319.5, cy=239.5, scale=1000)
>>> image = cr.read_scan("depth.png", camera=camera)  # doctest: +SKIP
)";

std::shared_ptr<Scan> make_scan(const py::object& points, const py::object& faces, const py::object& normals,
                                const py::object& viewpoint, const py::object& viewing_direction,
                                const std::string& method_name, const std::optional<double>& approximation_error,
                                const std::optional<long long>& number_of_vertices, double cell_size,
                                const std::optional<double>& time_budget, const py::object& progress)
{
  const Scan_input input = to_input(points, faces, normals, "Scan: points");
  if (input.scan) throw py::type_error("Scan: points: it is a Scan already");
  const Sensor_arguments sensor{to_point(viewpoint, "Scan: viewpoint"),
                                to_vector(viewing_direction, "Scan: viewing_direction")};
  Method_parameters parameters;
  parameters.method = method_name;
  parameters.simplification = {approximation_error, number_of_vertices, cell_size};
  const Method method(parameters, "Scan");
  const Time_budget budget(time_budget, "Scan");
  Interruption interruption(progress);
  py::gil_scoped_release unlocked;
  return std::const_pointer_cast<Scan>(prepared(input, sensor, method, budget, interruption));
}

std::string text_of(const Scan& scan)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << "<Scan of " << scan.number_of_samples() << " samples, spacing " << scan.spacing() << ", extent "
       << scan.extent() << (scan.has_free_space() ? ", free space known>" : ", free space not known>");
  return text.str();
}

CR::Depth_camera to_camera(const py::object& object)
{
  CR::Depth_camera camera;
  if (object.is_none()) return camera;
  const py::array array = to_array(object, "read_scan: camera", "fi");
  if (array.ndim() != 1 || array.shape(0) != 5)
    throw py::value_error(
        "read_scan: camera: five numbers are needed, fx, fy, cx, cy and scale, not an array of shape " +
        shape_of(array));
  const auto numbers = to_coordinates(array, "read_scan: camera");
  camera.fx = numbers.at(0);
  camera.fy = numbers.at(1);
  camera.cx = numbers.at(2);
  camera.cy = numbers.at(3);
  camera.scale = numbers.at(4);
  return camera;
}

// The path of a file that is written or read. \throws py::type_error
std::string needed_path(const py::object& object, const char* function)
{
  const std::optional<std::string> path = to_path(object);
  if (!path) throw py::type_error(std::string(function) + ": path: the name of a file is needed");
  return *path;
}

void save(const Scan& scan, const py::object& object)
{
  const std::string path = needed_path(object, "save");
  py::gil_scoped_release unlocked;
  CR::save_scan(path, scan);
}

std::shared_ptr<Scan> load(const py::object& object)
{
  const std::string path = needed_path(object, "load");
  py::gil_scoped_release unlocked;
  return std::make_shared<Scan>(CR::load_scan<Kernel>(path));
}

py::bytes bytes_of(const Scan& scan)
{
  std::string bytes;
  {
    py::gil_scoped_release unlocked;
    bytes = CR::scan_to_bytes(scan);
  }
  return py::bytes(bytes);
}

std::shared_ptr<Scan> scan_of(const py::bytes& object)
{
  const std::string bytes = object;
  try {
    return std::make_shared<Scan>(CR::scan_from_bytes<Kernel>(bytes, "Scan.from_bytes"));
  } catch (const CR::IO_error& e) {
    throw py::value_error(e.what()); // there is no file
  }
}

const char* kind_name(const Scan_file& file)
{
  return file.kind == Scan_file::RANGE_IMAGE ? "RANGE_IMAGE" : file.kind == Scan_file::MESH ? "MESH" : "POINTS";
}

py::array_t<double> points_of(const Scan_file& file)
{
  if (file.kind == Scan_file::RANGE_IMAGE) return to_array(file.image.points());
  if (file.kind == Scan_file::POINTS) return to_array(file.points);
  return py::array_t<double>(py::object(to_mesh(file.mesh).attr("points")));
}

py::object grid_of(const Scan_file& file)
{
  if (file.kind != Scan_file::RANGE_IMAGE) return py::none();
  return py::array_t<std::int32_t>({file.image.rows(), file.image.columns()}, file.image.grid().data());
}

const CR::Sensor<Kernel>& sensor_in(const Scan_file& file)
{
  return file.kind == Scan_file::RANGE_IMAGE ? file.image.sensor() : file.sensor;
}

template <class Three>
py::object three_numbers(const Three& three)
{
  py::array_t<double> array(3);
  for (int i = 0; i < 3; ++i) array.mutable_at(i) = three[i];
  return std::move(array);
}

void write_scan(const Scan_file& file, const py::object& object)
{
  const std::string path = needed_path(object, "write");
  py::gil_scoped_release unlocked;
  if (file.kind == Scan_file::RANGE_IMAGE) {
    CR::write_range_image(path, file.image);
    return;
  }
  Surface mesh = file.mesh;
  for (const Point& q : file.points) mesh.add_vertex(q);
  CR::write_file(path, [&](std::ostream& out) {
    CGAL::IO::set_binary_mode(out);
    CGAL::IO::write_PLY(out, mesh);
  });
}

std::string text_of(const Scan_file& file)
{
  const std::size_t points = file.kind == Scan_file::RANGE_IMAGE ? file.image.points().size()
                             : file.kind == Scan_file::MESH      ? file.mesh.number_of_vertices()
                                                                 : file.points.size();
  std::string text = "<ScanFile: " + std::to_string(points) + " points";
  if (file.kind == Scan_file::MESH) text += " and " + std::to_string(file.mesh.number_of_faces()) + " faces";
  if (file.kind == Scan_file::RANGE_IMAGE)
    text += " in a grid of " + std::to_string(file.image.rows()) + " rows and " + std::to_string(file.image.columns()) +
            " columns";
  return text + ">";
}

} // namespace

void bind_scans(py::module_& module)
{
  py::class_<Scan, std::shared_ptr<Scan>> scan(module, "Scan", scan_doc);
  scan.attr("__module__") = "crude_registration";
  scan.def(py::init(&make_scan), py::arg("points"), py::arg("faces") = py::none(), py::kw_only(),
           py::arg("normals") = py::none(), py::arg("viewpoint") = py::none(),
           py::arg("viewing_direction") = py::none(), py::arg("method") = "pairs",
           py::arg("approximation_error") = py::none(), py::arg("number_of_vertices") = py::none(),
           py::arg("cell_size") = 0., py::arg("time_budget") = py::none(), py::arg("progress") = py::none(),
           scan_signature);
  scan.def_property_readonly("number_of_samples", &Scan::number_of_samples, "The number of samples that take part.");
  scan.def_property_readonly("spacing", &Scan::spacing, "The root of the area per sample: a length.");
  scan.def_property_readonly("extent", &Scan::extent,
                             "M of the paper: the mean edge length of the scan's box in a frame of the scan's own.");
  scan.def_property_readonly(
      "points", [](const Scan& s) { return to_array(s.points()); },
      "(n, 3): some thousand points that stand for the surface, in the frame of the input.");
  scan.def_property_readonly(
      "normals", [](const Scan& s) { return to_array(s.normals()); },
      "(n, 3): the unit normals at points, outwards or towards the sensor.");
  scan.def_property_readonly("has_free_space", &Scan::has_free_space,
                             "Whether free space is known, as it is where the sensor is.");
  scan.def("__repr__", [](const Scan& s) { return text_of(s); });
  scan.def("to_bytes", &bytes_of,
           "to_bytes(self)\n--\n\nThe scan as some megabytes, from which from_bytes() makes the same scan, bit by bit, "
           "on any machine.\nThe same scan gives the same bytes. They hold a version and a checksum; a pickled Scan is "
           "these bytes.");
  scan.def_static("from_bytes", &scan_of, py::arg("bytes"),
                  "from_bytes(bytes)\n--\n\nThe scan that to_bytes() was called of. Raises ValueError where the bytes "
                  "are cut off or altered, or of\nanother version of the format.");
  scan.def("save", &save, py::arg("path"),
           "save(self, path)\n--\n\nWrites the bytes to a file, whole or not at all. Raises OSError.");
  scan.def_static("load", &load, py::arg("path"),
                  "load(path)\n--\n\nReads a scan from a file that save() wrote. Raises OSError where it cannot be "
                  "read, is cut off or altered,\nor is of another version of the format.");
  scan.def(py::pickle(&bytes_of, &scan_of));

  py::class_<Scan_file, std::shared_ptr<Scan_file>> file(module, "ScanFile", scan_file_doc);
  file.attr("__module__") = "crude_registration";
  file.def_property_readonly(
      "kind",
      [](const Scan_file& f) {
        return py::module_::import("crude_registration._types").attr("ScanKind").attr(kind_name(f));
      },
      "What the file holds: a ScanKind.");
  file.def_property_readonly("points", &points_of,
                             "(n, 3): the samples of a range image or the points, or the vertices of a mesh.");
  file.def_property_readonly(
      "faces",
      [](const Scan_file& f) -> py::object {
        if (f.kind != Scan_file::MESH) return py::none();
        return to_mesh(f.mesh).attr("faces");
      },
      "(m, 3): the triangles of a mesh as rows of points; None for other kinds.");
  file.def_property_readonly(
      "normals",
      [](const Scan_file& f) -> py::object {
        if (f.normals.empty()) return py::none();
        return to_array(f.normals);
      },
      "(n, 3): the normals that the file has for its points, of length 1, or 0 0 0 where there is none; None if it "
      "has\n"
      "none, and for meshes.");
  file.def_property_readonly(
      "colors",
      [](const Scan_file& f) -> py::object {
        if (f.colors.empty()) return py::none();
        py::array_t<std::uint8_t> colors({py::ssize_t(f.colors.size()), py::ssize_t(3)});
        auto to = colors.mutable_unchecked<2>();
        for (std::size_t i = 0; i < f.colors.size(); ++i)
          for (std::size_t k = 0; k < 3; ++k) to(py::ssize_t(i), py::ssize_t(k)) = f.colors[i][k];
        return std::move(colors);
      },
      "(n, 3): the colours that the file has for its points, red, green and blue from 0 to 255; None if it has none.");
  file.def_property_readonly("grid", &grid_of,
                             "(rows, columns): the row of points of each cell of a range image, -1 where there is no "
                             "sample; None for other kinds.");
  file.def_property_readonly(
      "viewpoint",
      [](const Scan_file& f) {
        const auto& sensor = sensor_in(f);
        return sensor.is_perspective() ? three_numbers(sensor.viewpoint()) : py::object(py::none());
      },
      "Where the sensor stood, if the file says or the grid tells it; None if its lines of sight are parallel.");
  file.def_property_readonly(
      "viewing_direction",
      [](const Scan_file& f) {
        const auto& sensor = sensor_in(f);
        return sensor.is_orthographic() ? three_numbers(sensor.viewing_direction()) : py::object(py::none());
      },
      "The direction of parallel lines of sight, into the scene, of length 1; None if they are not known to be.");
  file.def_property_readonly(
      "missing", [](const Scan_file& f) { return f.missing; },
      "How many points of the file are missing samples: NaN, or the zeros that a format has in their place.");
  file.def_property_readonly(
      "notes", [](const Scan_file& f) { return f.notes; },
      "A list of sentences on how the file was understood, where it could have been otherwise.");
  file.def(
      "surface", [](const py::object& f) { return to_mesh(to_surface(f, "surface")); },
      "surface(self)\n--\n\nThe surface as a Mesh: a range image and points are triangulated.");
  file.def("write", &write_scan, py::arg("path"),
           "write(self, path)\n--\n\nWrites a PLY file, whole or not at all, which read_scan() reads back the "
           "same. Raises OSError.");
  file.def("__repr__", [](const Scan_file& f) { return text_of(f); });

  module.def(
      "read_scan",
      [](const py::object& object, const py::object& camera_object) {
        const std::string path = needed_path(object, "read_scan");
        const CR::Depth_camera camera = to_camera(camera_object);
        py::gil_scoped_release unlocked;
        return std::make_shared<Scan_file>(CR::read_scan<Kernel>(path, camera));
      },
      py::arg("path"), py::kw_only(), py::arg("camera") = py::none(), read_scan_doc);
}
