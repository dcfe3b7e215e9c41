// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#include "report_page.h"

#include "report_texts.h"

#include <CGAL/Crude_registration/IO/write_file.h>

#include <cstddef>
#include <iomanip>
#include <locale>
#include <ostream>
#include <sstream>

namespace {

std::string escaped_html(const std::string& text)
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

// JSON as the contents of an element of HTML, which no value can end.
std::string json_in_html(const Json& json)
{
  std::string text;
  for (const char c : json.dump(-1, ' ', false, Json::error_handler_t::replace)) {
    if (c == '<') text += "\\u003c";
    else text += c;
  }
  return text;
}

} // namespace

std::string number_text(double x, int digits)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::setprecision(digits) << x;
  return text.str();
}

std::string per_cent(double share)
{
  constexpr double nearly = 0.9999;
  if (share > nearly && share < 1) return "more than 99.99 %";
  if (share < 1 - nearly && share > 0) return "less than 0.01 %";
  return number_text(100 * share, share > 0.99 ? 4 : 3) + " %";
}

Json to_json(const Report_verdict& verdict)
{
  return {{"level", verdict.level}, {"headline", verdict.headline}, {"text", verdict.text}};
}

Json to_json(const std::vector<Report_number>& numbers)
{
  Json json = Json::array();
  for (const Report_number& n : numbers) json.push_back({{"name", n.name}, {"value", n.value}, {"meaning", n.meaning}});
  return json;
}

std::string static_pictures(const std::function<Report_picture(bool is_after)>& surfaces)
{
  std::string html;
  if (has_three_js() || !can_write_png()) return html;
  for (const bool is_after : {true, false}) {
    const auto [shown, have_common_frame] = surfaces(is_after);
    if (is_after && !have_common_frame) continue;
    const std::string caption = is_after ? "The scans as they lie" : "The scans side by side";
    html += "<figure><img alt=\"" + caption + "\" src=\"data:image/png;base64," +
            to_base64(picture_of(shown, have_common_frame)) + "\"><figcaption>" + caption + "</figcaption></figure>\n";
  }
  return html;
}

void write_report(const std::string& file, const std::string& title, const Report_verdict& verdict, const Json& data,
                  const Report_bytes& bytes, const std::string& pictures)
{
  const std::string name = escaped_html(Json::parse(to_text(Json(title)))); // bytes that are not UTF-8 replaced
  const std::string page = page_html_text();
  CR::write_file(file, [&](std::ostream& out) {
    std::size_t begin = 0;
    const auto pass = [&](const std::string& mark) { // in the order of the page
      const std::size_t end = page.find(mark, begin);
      out.write(page.data() + begin, std::streamsize(end - begin));
      begin = end + mark.size();
    };
    const auto put = [&](const std::string& mark, const std::string& text) {
      pass(mark);
      out << text;
    };
    put("@TITLE@", name);
    put("@STYLE@", page_css_text());
    put("@TITLE@", name);
    put("@LEVEL@", verdict.level);
    put("@HEADLINE@", escaped_html(verdict.headline));
    put("@VERDICT@", escaped_html(verdict.text));
    put("@PICTURES@", pictures);
    put("@LICENCE@", escaped_html(three_licence_text()));
    put("@DATA@", json_in_html(data));
    pass("@BYTES@");
    bytes.write(out);
    put("@THREE@", three_js_text());
    put("@SCRIPT@", page_js_text());
    out << page.substr(begin);
  });
}
