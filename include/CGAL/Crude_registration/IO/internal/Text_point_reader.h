// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Author(s)     : The Crude_registration authors

#ifndef CGAL_CRUDE_REGISTRATION_IO_INTERNAL_TEXT_POINT_READER_H
#define CGAL_CRUDE_REGISTRATION_IO_INTERNAL_TEXT_POINT_READER_H

// Reads points as text, as programs of all kinds write them.

#include <CGAL/Crude_registration/IO/IO_error.h>
#include <CGAL/Crude_registration/IO/internal/Flat_scan_file.h>
#include <CGAL/Crude_registration/IO/internal/Text_cursor.h>
#include <CGAL/Crude_registration/IO/internal/column_roles.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// Points, one a line. Before them there may be lines that do not start with a number, the last of which may name the
// columns, and the number of points alone in a line.
class Text_point_reader
{
public:
  Text_point_reader(std::string_view text, const std::string& file) : m_cursor(text, file)
  {
    m_cursor.set_quotes(true);
  }

  // NaN and infinite points included.
  Flat_scan_file read()
  {
    Flat_scan_file scan;
    if (!to_first_point()) throw IO_error(m_cursor.file(), what_is_missing());
    m_first_point.emplace(m_cursor);
    if (m_has_names) read_named(scan);
    else read_unnamed(scan);
    if (m_declared >= 0 && static_cast<std::size_t>(m_declared) != scan.points.size())
      throw IO_error(m_cursor.file(), "the file has " + std::to_string(scan.points.size()) +
                                          " points, but its first line says " + std::to_string(m_declared));
    return scan;
  }

  // After read(), for what writes the file anew: once more through the numbers of the points and their normals.
  // number(column, word, value): the column counts x, y, z, and those of the normal; end() follows each point.
  template <class Number, class End>
  void for_each_number(const Number& number, const End& end) const
  {
    const auto past = m_places.begin() + RED;
    std::size_t last = 0;
    for (auto it = m_places.begin(); it != past; ++it)
      if (*it != none) last = (std::max)(last, *it);
    Text_cursor cursor = *m_first_point;
    do {
      for (std::size_t place = 0; place <= last; ++place) {
        const auto it = std::find(m_places.begin(), past, place);
        double value = 0;
        if (it != past) Text_cursor(cursor).try_number(value);
        const std::string_view word = cursor.word();
        if (it != past) number(static_cast<std::size_t>(it - m_places.begin()), word, value);
      }
      end();
    } while (next_point(cursor));
  }

  // Whether a comma may be that of a number.
  bool may_have_decimal_commas() const { return m_first_point->has_decimal_comma(); }

private:
  enum Column // what a column may hold
  {
    X,
    Y,
    Z,
    NX,
    NY,
    NZ,
    RED,
    GREEN,
    BLUE,
    COLUMNS
  };
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  using Places = std::array<std::size_t, COLUMNS>; // where each column stands

  // --- before the points --------------------------------------------------------------------------------------------

  bool to_first_point()
  {
    std::size_t names = 0, line_of_names = 0; // of the last line of words
    Places commented = no_places();
    std::size_t names_in_comment = 0;
    while (m_cursor.next_line()) {
      const std::string_view line = m_cursor.rest();
      const std::size_t mark = comment_mark(line);
      if (mark > 0) {
        Text_cursor comment(line.substr(mark), m_cursor.file());
        if (!comment.next_line()) continue;
        set_separator(comment);
        std::size_t words = 0;
        const Places places = places_of(comment, words);
        if (!has_coordinates(places)) continue;
        commented = places;
        names_in_comment = words;
        continue;
      }
      set_separator(m_cursor);
      if (starts_points()) {
        if (m_declared >= 0 || !is_count()) {
          decide_on_names(number_of_words(m_cursor), names, line_of_names, commented, names_in_comment);
          return true;
        }
        m_declared = m_cursor.integer("the number of points");
        continue;
      }
      if (m_first_words.empty()) m_first_words = std::string(line.substr(0, 40));
      const Places places = places_of(m_cursor, names);
      line_of_names = m_cursor.line();
      if (!has_coordinates(places)) continue;
      m_places = places;
      m_has_names = true;
    }
    return false;
  }

  // Is there a number where the first coordinate has to be? A name of the point may stand before it, if columns are
  // named.
  bool starts_points() const
  {
    Text_cursor words = m_cursor;
    for (std::size_t i = 0; m_has_names && i < m_places[X]; ++i) words.word();
    double number = 0;
    return words.try_number(number) || (m_has_names && Text_cursor(m_cursor).try_number(number));
  }

  // A line above the points with as many words as they have numbers names the columns: other names than those of
  // coordinates are not guessed at.
  void decide_on_names(std::size_t words, std::size_t names, std::size_t line_of_names, const Places& commented,
                       std::size_t names_in_comment)
  {
    if (m_has_names) return;
    if (names == words)
      throw IO_error(m_cursor.file(), line_of_names,
                     "the line has neither numbers nor the names x, y and z of columns");
    if (!has_coordinates(commented) || names_in_comment != words) return;
    m_places = commented;
    m_has_names = true;
  }

  std::string what_is_missing() const
  {
    if (m_first_words.empty()) return "the file has no points";
    return "the file has no points: no line starts with a number, and the first is '" + m_first_words + "'";
  }

  // the length of what starts a comment, 0 where the line is none
  static std::size_t comment_mark(std::string_view line)
  {
    if (line[0] == '#' || line[0] == '%') return 1;
    return line.substr(0, 2) == "//" ? 2 : 0;
  }

  static bool next_point(Text_cursor& cursor)
  {
    while (cursor.next_line())
      if (comment_mark(cursor.rest()) == 0) return true;
    return false;
  }

  // Semicolons, commas or white space, for the whole file. With semicolons a comma is that of a number, and with white
  // space where there is one within each word, as in "1,5 2,5 3,5".
  static void set_separator(Text_cursor& cursor)
  {
    const std::string_view line = cursor.rest();
    const bool semicolons = line.find(';') != std::string_view::npos;
    const bool commas = line.find(',') != std::string_view::npos;
    const bool decimal_commas = !semicolons && commas && has_decimal_commas(line, cursor.file());
    cursor.set_separator(semicolons ? ';' : commas && !decimal_commas ? ',' : '\0');
    cursor.set_decimal_comma(semicolons || decimal_commas);
  }

  static bool has_decimal_commas(std::string_view line, const std::string& file)
  {
    Text_cursor words(line, file);
    words.next_line();
    std::size_t count = 0;
    for (; words.has_word(); ++count) {
      const std::string_view word = words.word();
      const std::size_t comma = word.find(',');
      if (comma == std::string_view::npos) continue;
      const auto is_digit = [&](std::size_t i) { return i < word.size() && word[i] >= '0' && word[i] <= '9'; };
      if (comma == 0 || !is_digit(comma - 1) || !is_digit(comma + 1) ||
          word.find(',', comma + 1) != std::string_view::npos)
        return false;
    }
    return count >= 3;
  }

  static std::size_t number_of_words(Text_cursor words)
  {
    std::size_t count = 0;
    for (; words.has_word(); ++count) words.word();
    return count;
  }

  // a line of one integer
  bool is_count() const
  {
    Text_cursor words = m_cursor;
    const std::string_view word = words.word();
    return !words.has_word() && word.find_first_not_of("0123456789") == std::string_view::npos;
  }

  static Places no_places()
  {
    Places places;
    places.fill(none);
    return places;
  }

  static bool has_coordinates(const Places& p) { return p[X] != none && p[Y] != none && p[Z] != none; }
  static bool has_normals(const Places& p) { return p[NX] != none && p[NY] != none && p[NZ] != none; }
  static bool has_colors(const Places& p) { return p[RED] != none && p[GREEN] != none && p[BLUE] != none; }

  // where the columns stand whose names are the words of a line, and how many words there are
  static Places places_of(Text_cursor words, std::size_t& count)
  {
    static const std::array<std::vector<std::string_view>, COLUMNS> names = {
        {{"x", "points:0", "points_0"},
         {"y", "points:1", "points_1"},
         {"z", "points:2", "points_2"},
         {"nx", "normal_x", "normals:0", "normals_0"},
         {"ny", "normal_y", "normals:1", "normals_1"},
         {"nz", "normal_z", "normals:2", "normals_2"},
         {"r", "red"},
         {"g", "green"},
         {"b", "blue"}}};
    Places places = no_places();
    for (count = 0; words.has_word(); ++count) {
      std::string name(words.word());
      name.erase(std::remove(name.begin(), name.end(), '"'), name.end());
      name = name.substr(0, name.find_first_of("[(")); // a unit
      while (!name.empty() && name.back() == ' ') name.pop_back();
      for (char& c : name)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
      for (std::size_t column = 0; column < COLUMNS; ++column)
        if (std::find(names[column].begin(), names[column].end(), name) != names[column].end()) places[column] = count;
    }
    return places;
  }

  // --- the points ---------------------------------------------------------------------------------------------------

  void read_named(Flat_scan_file& scan)
  {
    std::size_t last = (std::max)({m_places[X], m_places[Y], m_places[Z]});
    const bool normals = has_normals(m_places);
    if (!normals) m_places[NX] = m_places[NY] = m_places[NZ] = none;
    if (normals) last = (std::max)({last, m_places[NX], m_places[NY], m_places[NZ]});
    const bool colors = has_colors(m_places);
    if (!colors) m_places[RED] = m_places[GREEN] = m_places[BLUE] = none;
    if (colors) last = (std::max)({last, m_places[RED], m_places[GREEN], m_places[BLUE]});
    std::vector<Vector> parts;
    do {
      std::array<double, COLUMNS> values{};
      for (std::size_t place = 0; place <= last; ++place) {
        const auto it = std::find(m_places.begin(), m_places.end(), place);
        const std::size_t column = static_cast<std::size_t>(it - m_places.begin());
        if (column < NX) values[column] = m_cursor.number("a coordinate");
        else if (column < RED) values[column] = m_cursor.number("a coordinate of the normal");
        else if (column < COLUMNS) values[column] = m_cursor.number("a part of the colour");
        else m_cursor.word();
      }
      scan.points.emplace_back(values[X], values[Y], values[Z]);
      if (normals) scan.normals.push_back(unit_normal(Vector(values[NX], values[NY], values[NZ])));
      if (colors) parts.emplace_back(values[RED], values[GREEN], values[BLUE]);
    } while (next_point(m_cursor));
    take_named_colors(parts, scan);
  }

  // Ten columns are looked at: a number of the point, the point, its normal and its colour in either order. PTS has an
  // intensity before the colour, others have it behind.
  void read_unnamed(Flat_scan_file& scan)
  {
    const std::size_t width = std::clamp(number_of_words(m_cursor), std::size_t(3), std::size_t(COLUMNS) + 1);
    std::vector<double> table; // width columns
    std::size_t rows = 0, fewest = width, most = 0;
    bool first_is_increasing = true, first_counts = true;
    do {
      const double previous = rows > 0 ? table[(rows - 1) * width] : 0;
      const std::string_view line = m_cursor.rest();
      static constexpr const char* names[3] = {"x", "y", "z"};
      std::size_t columns = 0;
      table.resize((rows + 1) * width, std::numeric_limits<double>::quiet_NaN());
      double* const row = &table[rows * width];
      for (; columns < 3; ++columns) row[columns] = m_cursor.number(names[columns]);
      while (columns < width && m_cursor.try_number(row[columns])) ++columns;
      first_is_increasing = first_is_increasing && is_integer(line, row[0]) && (rows == 0 || row[0] > previous);
      first_counts =
          first_is_increasing && (rows == 0 ? row[0] == 0 || row[0] == 1 : row[0] == previous + 1) && first_counts;
      fewest = (std::min)(fewest, columns);
      most = (std::max)(most, columns + (m_cursor.has_word() ? 1 : 0));
      ++rows;
    } while (next_point(m_cursor));

    // Three points in a row may well have growing whole coordinates: more columns, or a count, are needed to tell.
    const bool is_numbered = rows >= 3 && first_is_increasing && fewest > 3;
    if (rows >= 3 && first_counts && !is_numbered)
      throw IO_error(m_cursor.file(),
                     "the first column counts the points, and only two columns are left: a line of the "
                     "names x y z before the points says if they are coordinates nevertheless");
    if (is_numbered) scan.notes.push_back("The first column numbers the points and is passed over.");
    const std::size_t first = is_numbered ? 1 : 0;
    scan.points.reserve(rows);
    for (std::size_t i = 0; i < rows; ++i) {
      const double* p = &table[i * width + first];
      scan.points.emplace_back(p[0], p[1], p[2]);
    }
    for (std::size_t column = 0; column < 3; ++column) m_places[column] = first + column;
    if (fewest != most) return;
    const auto columns_from = [&](std::size_t column) {
      std::vector<Vector> columns;
      columns.reserve(rows);
      for (std::size_t i = 0; i < rows; ++i) {
        const double* v = &table[i * width + column];
        columns.emplace_back(v[0], v[1], v[2]);
      }
      return columns;
    };
    const auto take = [&](std::size_t column) {
      if (take_columns(columns_from(column), scan) != NORMAL_COLUMNS) return;
      for (std::size_t k = 0; k < 3; ++k) m_places[NX + k] = column + k;
    };
    switch (most - first) {
    case 7: {
      const bool are_last = role_of_columns(columns_from(first + 4)) == COLOR_COLUMNS,
                 are_first = role_of_columns(columns_from(first + 3)) == COLOR_COLUMNS;
      if (are_last && (is_pts() || !are_first)) take(first + 4);
      else if (are_first && !are_last) take(first + 3);
      break;
    }
    case 9:
      take(first + 6);
      [[fallthrough]];
    case 6:
      take(first + 3);
    }
  }

  bool is_pts() const
  {
    const std::string& file = m_cursor.file();
    std::string end = file.size() < 4 ? std::string() : file.substr(file.size() - 4);
    for (char& c : end)
      if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return end == ".pts";
  }

  static bool is_integer(std::string_view line, double value)
  {
    if (!line.empty() && line[0] == '"') line.remove_prefix(1);
    const std::size_t end = line.find_first_not_of("0123456789");
    if (end == 0) return false;
    return end == std::string_view::npos ||
           (line[end] != '.' && line[end] != 'e' && line[end] != 'E' && value == std::floor(value));
  }

  Text_cursor m_cursor;
  std::optional<Text_cursor> m_first_point; // at its line
  Places m_places = no_places();
  bool m_has_names = false;
  long long m_declared = -1;
  std::string m_first_words; // of a file that may have no points
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_IO_INTERNAL_TEXT_POINT_READER_H
