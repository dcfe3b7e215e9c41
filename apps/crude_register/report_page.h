// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CRUDE_REGISTER_REPORT_PAGE_H
#define CRUDE_REGISTER_REPORT_PAGE_H

// A report: one page of HTML that needs nothing but itself.

#include "files.h"
#include "json.h"
#include "picture.h"
#include "report_scans.h"
#include "report_texts.h"
#include "surfaces.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <iomanip>
#include <locale>
#include <optional>
#include <ostream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

// What a page says on top. `level`: good, doubtful or bad.
struct Report_verdict
{
  std::string level, headline, text;
};

// A number with what it means.
struct Report_number
{
  std::string name, value, meaning;
};

// A motion that can be looked at: of the source of a pair.
struct Report_pose
{
  std::string name, meaning;
  std::optional<double> probability;
  Transformation motion;
};

inline std::string number_text(double x, int digits = 3)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::setprecision(digits) << x;
  return text.str();
}

// Never rounded to certainty.
inline std::string per_cent(double share)
{
  constexpr double nearly = 0.9999;
  if (share > nearly && share < 1) return "more than 99.99 %";
  if (share < 1 - nearly && share > 0) return "less than 0.01 %";
  return number_text(100 * share, share > 0.99 ? 4 : 3) + " %";
}

inline std::string escaped_html(const std::string& text)
{
  std::string html;
  for (const char c : text) {
    if (c == '&') html += "&amp;";
    else if (c == '<') html += "&lt;";
    else if (c == '>') html += "&gt;";
    else if (c == '"') html += "&quot;";
    else html += c;
  }
  return html;
}

inline Json to_json(const Report_verdict& verdict)
{
  return {{"level", verdict.level}, {"headline", verdict.headline}, {"text", verdict.text}};
}

inline Json to_json(const std::vector<Report_number>& numbers)
{
  Json json = Json::array();
  for (const Report_number& n : numbers) json.push_back({{"name", n.name}, {"value", n.value}, {"meaning", n.meaning}});
  return json;
}

// JSON as the contents of an element of HTML, which no value can end.
inline std::string json_in_html(const Json& json)
{
  std::string text;
  for (const char c : json.dump(-1, ' ', false, Json::error_handler_t::replace)) {
    if (c == '<') text += "\\u003c";
    else text += c;
  }
  return text;
}

// Where no view can be turned: pictures, after and before, of what `surfaces(is_after)` gives, with whether that lies
// in a common frame.
template <class Function>
std::string static_pictures(const Function& surfaces)
{
  std::string html;
  if (has_three_js() || !can_write_pictures()) return html;
  for (const bool is_after : {true, false}) {
    auto [shown, have_common_frame] = surfaces(is_after);
    if (is_after && !have_common_frame) continue;
    const std::string caption = is_after ? "The scans as they lie" : "The scans side by side";
    html += "<figure><img alt=\"" + caption + "\" src=\"data:image/png;base64," +
            to_base64(picture_of(std::move(shown), have_common_frame)) + "\"><figcaption>" + caption +
            "</figcaption></figure>\n";
  }
  return html;
}

inline void write_report(const std::string& file, const std::string& title, const Report_verdict& verdict,
                         const Json& data, const std::string& blocks, const std::string& pictures)
{
  const std::string name = escaped_html(Json::parse(to_text(Json(title)))); // bytes that are not UTF-8 replaced
  const std::vector<std::pair<std::string, std::string>> parts = {{"@TITLE@", name},
                                                                  {"@STYLE@", page_css_text()},
                                                                  {"@TITLE@", name},
                                                                  {"@LEVEL@", verdict.level},
                                                                  {"@HEADLINE@", escaped_html(verdict.headline)},
                                                                  {"@VERDICT@", escaped_html(verdict.text)},
                                                                  {"@PICTURES@", pictures},
                                                                  {"@LICENCE@", escaped_html(three_licence_text())},
                                                                  {"@DATA@", json_in_html(data)},
                                                                  {"@BYTES@", blocks},
                                                                  {"@THREE@", three_js_text()},
                                                                  {"@SCRIPT@", page_js_text()}};
  const std::string page = page_html_text();
  CR::write_file(file, [&](std::ostream& out) {
    std::size_t begin = 0;
    for (const auto& [mark, text] : parts) { // in the order of the page
      const std::size_t end = page.find(mark, begin);
      out << page.substr(begin, end - begin) << text;
      begin = end + mark.size();
    }
    out << page.substr(begin);
  });
}

#endif // CRUDE_REGISTER_REPORT_PAGE_H
