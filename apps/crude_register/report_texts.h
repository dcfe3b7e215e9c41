// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CRUDE_REGISTER_REPORT_TEXTS_H
#define CRUDE_REGISTER_REPORT_TEXTS_H

// The parts of a report that are files of the project, report/, or three.js: the build makes them a source.

#include <string>

std::string page_html_text();
std::string page_css_text();
std::string page_js_text();
// Empty where the program was built without three.js.
std::string three_js_text();
std::string three_licence_text();
bool has_three_js();

#endif // CRUDE_REGISTER_REPORT_TEXTS_H
