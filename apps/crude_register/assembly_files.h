// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CRUDE_REGISTER_ASSEMBLY_FILES_H
#define CRUDE_REGISTER_ASSEMBLY_FILES_H

// The files that tell of an assembly: poses, graph, tables and points.

#include "files.h"
#include "json.h"
#include "options.h"

#include <CGAL/Crude_registration/Assembly_result.h>
#include <CGAL/Crude_registration/Scan.h>

#include <ostream>
#include <string>
#include <vector>

using Assembly = CR::Assembly_result<Kernel>;

// What scans are called in the output: their files without folders where that tells them apart.
std::vector<std::string> names_of(const std::vector<std::string>& files);

// The pairs that were registered, and what became of each: the member "edges" of an answer and of a report.
Json rows_of_edges(const Assembly& result);

// How the scans lie on each other: the member "overlaps" of both.
Json rows_of_overlaps(const Assembly& result);

void write_poses(const std::string& file, const Assembly& result, const std::vector<std::string>& names);

// The pairs that were tried, as GraphViz draws them: what is used by lines, what was dropped or not believed by dashes.
void write_graph(std::ostream& out, const Assembly& result, const std::vector<std::string>& names);

// Two matrices, of the shares of each scan that lie on the other ones, and of the residuals there; and how many pairs
// have residuals in which band.
void write_tables(std::ostream& out, const Assembly& result, const std::vector<std::string>& names);

// The points of the largest component, read again, in its frame, with their colours if a scan has any: points that have
// none are white.
void write_points(const std::string& name, const po::variables_map& map, const Assembly& result,
                  const std::vector<CR::Scan<Kernel>>& scans, const std::vector<std::string>& files);

#endif // CRUDE_REGISTER_ASSEMBLY_FILES_H
