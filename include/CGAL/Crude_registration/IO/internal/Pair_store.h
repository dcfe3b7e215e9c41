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

#ifndef CGAL_CRUDE_REGISTRATION_IO_INTERNAL_PAIR_STORE_H
#define CGAL_CRUDE_REGISTRATION_IO_INTERNAL_PAIR_STORE_H

// Keeps what the registrations of pairs have said in a folder, so that a run that was ended does none of them again.

#include <CGAL/Crude_registration/IO/IO_error.h>
#include <CGAL/Crude_registration/IO/write_file.h>
#include <CGAL/Crude_registration/internal/assembly/Pair_answer.h>
#include <CGAL/Crude_registration/internal/base/Counter_random.h>
#include <CGAL/Crude_registration/internal/reduction/Reduced_scan.h>

#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <ios>
#include <istream>
#include <limits>
#include <locale>
#include <optional>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// 128 bits that tell contents apart.
class Content_hash
{
public:
  template <class Number>
  void add(Number number)
  {
    std::uint64_t bits = 0;
    static_assert(sizeof number <= sizeof bits, "a number of at most 64 bits");
    std::memcpy(&bits, &number, sizeof number);
    m_lanes[0] = Counter_random::mixed(m_lanes[0] ^ bits);
    m_lanes[1] = Counter_random::mixed(m_lanes[1] + 3 * bits);
  }

  void add(const Vector_f& v)
  {
    for (int i = 0; i < 3; ++i) add(v[i]);
  }

  void add(const Content_hash& other)
  {
    for (const std::uint64_t lane : other.m_lanes) add(lane);
  }

  // The hash whose text() this is; nothing where it is none.
  static std::optional<Content_hash> of_text(const std::string& hexadecimal)
  {
    Content_hash hash;
    if (hexadecimal.size() != 16 * hash.m_lanes.size()) return std::nullopt;
    const char* first = hexadecimal.data();
    for (std::uint64_t& lane : hash.m_lanes) {
      const auto r = std::from_chars(first, first + 16, lane, 16);
      if (r.ec != std::errc() || r.ptr != first + 16) return std::nullopt;
      first += 16;
    }
    return hash;
  }

  std::string text() const
  {
    std::string hexadecimal;
    for (const std::uint64_t lane : m_lanes)
      for (int shift = 60; shift >= 0; shift -= 4) hexadecimal += "0123456789abcdef"[(lane >> shift) & 15];
    return hexadecimal;
  }

private:
  std::array<std::uint64_t, 2> m_lanes{1, 2};
};

// Of all that the registration of a scan depends on: its surfels, and what of its free space they can tell.
inline Content_hash hash_of(const Reduced_scan& scan)
{
  Content_hash hash;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) hash.add(scan.own_from_input.rotation(i, j));
    hash.add(scan.own_from_input.translation[i]);
  }
  hash.add(scan.spacing);
  hash.add(scan.extent);
  hash.add(std::uint64_t(scan.is_body));
  for (const Surfel_level* level : {&scan.coarse, &scan.fine}) {
    hash.add(level->spacing);
    for (const Surfel& s : level->surfels) {
      hash.add(s.position);
      hash.add(s.normal);
      hash.add(scan.depths.in_front(s.position + 2 * level->spacing * s.normal));
    }
  }
  return hash;
}

class Pair_store
{
public:
  // Makes the folder. \throws IO_error
  explicit Pair_store(const std::string& folder) : m_folder(folder)
  {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) throw IO_error(folder, "the folder cannot be made: " + error.message());
  }

  // A file is found again by the contents of both scans, which way round they are, and the version.
  std::string file(const Content_hash& source, const Content_hash& target) const
  {
    Content_hash hash;
    hash.add(version);
    hash.add(source);
    hash.add(target);
    return (std::filesystem::path(m_folder) / (hash.text() + ".pair")).string();
  }

  // What was kept; nothing where the file is not there, or not whole.
  static std::optional<Pair_answer> read(const std::string& file)
  {
    std::ifstream in(file, std::ios::binary);
    return read(in);
  }

  static std::optional<Pair_answer> read(std::istream& in)
  {
    in.imbue(std::locale::classic());
    Pair_answer answer;
    std::string word;
    int status = 0;
    std::size_t motions = 0;
    if (!std::getline(in, word) || word != head || !std::getline(in, answer.reason)) return std::nullopt;
    if (!(in >> status >> answer.overlap >> answer.residual >> motions) || status < REGISTERED ||
        status > NOT_REGISTERED || motions > most_motions)
      return std::nullopt;
    answer.status = Registration_status(status);
    answer.motions.resize(motions);
    for (Ranked_motion& m : answer.motions) {
      in >> m.probability;
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) in >> m.motion.rotation(i, j);
        in >> m.motion.translation[i];
      }
    }
    if (!(in >> word) || word != "end") return std::nullopt;
    return answer;
  }

  // Whole or not at all. \throws IO_error
  static void write(const std::string& file, const Pair_answer& answer)
  {
    write_file(file, [&](std::ostream& out) { write(out, answer); });
  }

  static void write(std::ostream& out, const Pair_answer& answer)
  {
    out.imbue(std::locale::classic());
    out.precision(std::numeric_limits<double>::max_digits10);
    out << head << '\n' << answer.reason << '\n';
    out << int(answer.status) << ' ' << answer.overlap << ' ' << answer.residual << ' ' << answer.motions.size();
    for (const Ranked_motion& m : answer.motions) {
      out << '\n' << m.probability;
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) out << ' ' << m.motion.rotation(i, j);
        out << ' ' << m.motion.translation[i];
      }
    }
    out << "\nend\n";
  }

private:
  // To be raised with whatever changes the answer of a registration.
  static constexpr int version = 3;
  static constexpr const char* head = "crude_registration pair";
  static constexpr std::size_t most_motions = 1000;

  std::string m_folder;
};

// An answer as another process is told it, to the last bit.
inline std::string to_bytes(const Pair_answer& answer)
{
  std::ostringstream out;
  Pair_store::write(out, answer);
  return out.str();
}

// \throws std::runtime_error if it is not whole; where a run was stopped there is none, and an empty answer is one.
inline Pair_answer answer_of_bytes(const std::string& bytes)
{
  if (bytes.empty()) return {};
  std::istringstream in(bytes);
  const std::optional<Pair_answer> answer = Pair_store::read(in);
  if (!answer) throw std::runtime_error("the answer of a pair is not whole");
  return *answer;
}

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_IO_INTERNAL_PAIR_STORE_H
