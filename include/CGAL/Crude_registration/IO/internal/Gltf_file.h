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

#ifndef CGAL_CRUDE_REGISTRATION_IO_INTERNAL_GLTF_FILE_H
#define CGAL_CRUDE_REGISTRATION_IO_INTERNAL_GLTF_FILE_H

// A glTF file taken apart: its text, its buffers, and the numbers that its accessors stand for.

#include <CGAL/Crude_registration/IO/IO_error.h>
#include <CGAL/Crude_registration/IO/internal/binary_numbers.h>
#include <CGAL/Crude_registration/IO/internal/read_file.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace CGAL {
namespace Crude_registration {
namespace internal {

// What the letters of base64 stand for (RFC 4648); nothing where the text is none.
inline std::optional<std::string> decode_base64(std::string_view text)
{
  static constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3 + 2);
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const std::size_t value = letters.find(c);
    if (value == std::string_view::npos) return std::nullopt;
    bits = bits << 6 | static_cast<std::uint32_t>(value);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 255);
  }
  return bytes;
}

// What a relative reference stands for: %20 is a space (RFC 3986).
inline std::string decode_percent(std::string_view text)
{
  const auto digit = [](char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
  };
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '%' && i + 2 < text.size() && digit(text[i + 1]) >= 0 && digit(text[i + 2]) >= 0) {
      result += static_cast<char>(16 * digit(text[i + 1]) + digit(text[i + 2]));
      i += 2;
    } else {
      result += text[i];
    }
  }
  return result;
}

// Numbers of equal width, as an accessor has them.
struct Gltf_numbers
{
  std::string_view data; // from the first number on
  std::size_t count = 0, width = 0, stride = 0;
  int type = 0; // of a number, as glTF counts them
  bool normalized = false;

  std::size_t size_of_number() const { return type == 5120 || type == 5121 ? 1 : type == 5122 || type == 5123 ? 2 : 4; }
  bool is_float() const { return type == 5126; }
  bool is_unsigned() const { return type == 5121 || type == 5123 || type == 5125; }

  // Whole numbers that are normalized stand for what is between -1 and 1 (section 3.6.2.2 of the specification).
  double at(std::size_t i, std::size_t k) const
  {
    const std::size_t byte = i * stride + k * size_of_number();
    switch (type) {
    case 5120:
      return fraction(double(number_at<std::int8_t>(data, byte)), 127);
    case 5121:
      return fraction(double(number_at<std::uint8_t>(data, byte)), 255);
    case 5122:
      return fraction(double(number_at<std::int16_t>(data, byte)), 32767);
    case 5123:
      return fraction(double(number_at<std::uint16_t>(data, byte)), 65535);
    case 5125:
      return double(number_at<std::uint32_t>(data, byte));
    default:
      return double(number_at<float>(data, byte));
    }
  }

private:
  double fraction(double number, double largest) const
  {
    return normalized ? (std::max)(number / largest, -1.) : number;
  }
};

// A file of glTF 2.0, as text or binary. Errors name the element of the file that they are in. (Khronos, glTF 2.0
// Specification, sections 3.6 and 4.4.)
class Gltf_file
{
public:
  using Json = nlohmann::json;

  Gltf_file(std::string_view data, const std::string& file) : m_data(data), m_file(file)
  {
    std::string_view text = data;
    if (data.substr(0, 4) == "glTF") text = take_chunks();
    try {
      m_root = Json::parse(text.begin(), text.end());
    } catch (const Json::parse_error& e) {
      const std::size_t at = (std::min)(e.byte, text.size());
      const std::string what = "from here on the text is not JSON";
      if (text.size() == data.size())
        throw IO_error(file,
                       1 + static_cast<std::size_t>(std::count(text.begin(), text.begin() + std::ptrdiff_t(at), '\n')),
                       what);
      throw IO_error(file, "byte " + std::to_string(std::size_t(text.data() - data.data()) + at) + ": " + what);
    } catch (const Json::exception&) { // a number that no double holds
      throw IO_error(file, "a number of the text is out of range");
    }
    const Json& version = member(member(m_root, "asset"), "version");
    if (!version.is_string()) fail("the file", "it does not say the version of glTF that it is");
    const std::string number = version.get<std::string>();
    if (number.substr(0, 2) != "2.") fail("the file", "glTF " + number.substr(0, 10) + " is not read, 2.0 is");
  }

  const Json& root() const { return m_root; }

  [[noreturn]] void fail(const std::string& where, const std::string& what) const
  {
    throw IO_error(m_file, where + ": " + what);
  }

  // null where there is none
  static const Json& member(const Json& object, const char* key)
  {
    static const Json none;
    const auto found = object.find(key);
    return object.is_object() && found != object.end() ? *found : none;
  }

  // An element of one of the lists at the top. `where` names what wants it.
  const Json& element(const char* list, std::size_t i, const std::string& where) const
  {
    const Json& all = member(m_root, list);
    if (!all.is_array() || i >= all.size())
      fail(where, "'" + std::string(list) + "' has no number " + std::to_string(i));
    return all[i];
  }

  // A whole number, if it is there.
  std::optional<std::size_t> whole(const Json& object, const char* key, const std::string& where) const
  {
    const Json& value = member(object, key);
    if (value.is_null()) return std::nullopt;
    return to_whole(value, key, where);
  }
  std::size_t to_whole(const Json& value, const char* key, const std::string& where) const
  {
    constexpr double largest = 9007199254740992.; // 2^53
    if (value.is_number_unsigned()) return value.get<std::size_t>();
    const double number = value.is_number() ? value.get<double>() : -1;
    if (!(number >= 0) || number != std::floor(number) || number > largest)
      fail(where, "'" + std::string(key) + "' is not a whole number");
    return static_cast<std::size_t>(number);
  }

  // The numbers of an accessor, which has one of the types that are given, separated by spaces.
  Gltf_numbers numbers(std::size_t i, std::string_view types, const std::string& user) const
  {
    const Json& accessor = element("accessors", i, user);
    const std::string where = "accessor " + std::to_string(i);
    Gltf_numbers numbers;
    const Json& type = member(accessor, "type");
    const std::string name = type.is_string() ? type.get<std::string>() : "";
    numbers.width = name == "SCALAR" ? 1 : name == "VEC2" ? 2 : name == "VEC3" ? 3 : name == "VEC4" ? 4 : 0;
    if (numbers.width == 0 || types.find(name) == std::string_view::npos)
      fail(where, "its type is not " + std::string(types) + ", as " + user + " needs it");
    const std::size_t component = whole(accessor, "componentType", where).value_or(0);
    if (component < 5120 || component > 5126 || component == 5124) fail(where, "its componentType is not known");
    numbers.type = static_cast<int>(component);
    const Json& normalized = member(accessor, "normalized");
    numbers.normalized = normalized.is_boolean() && normalized.get<bool>();
    numbers.count = whole(accessor, "count", where).value_or(0);
    if (!member(accessor, "sparse").is_null()) fail(where, "sparse accessors are not read");
    const auto view = whole(accessor, "bufferView", where);
    if (!view) fail(where, "it has no bufferView");
    const std::string_view bytes = bytes_of_view(*view, where);
    const std::size_t size = numbers.width * numbers.size_of_number(),
                      offset = whole(accessor, "byteOffset", where).value_or(0);
    numbers.stride = whole(element("bufferViews", *view, where), "byteStride", where).value_or(size);
    if (numbers.stride < size) fail(where, "the byteStride of its bufferView is shorter than what it holds");
    if (numbers.count > 0 && (offset > bytes.size() || bytes.size() - offset < size ||
                              (bytes.size() - offset - size) / numbers.stride < numbers.count - 1))
      fail(where, "its bufferView of " + std::to_string(bytes.size()) + " bytes is too short for its " +
                      std::to_string(numbers.count) + " elements");
    numbers.data = bytes.substr((std::min)(offset, bytes.size()));
    return numbers;
  }

  // Of the file, and of the buffers that were read.
  std::size_t bytes_read() const
  {
    std::size_t bytes = m_data.size();
    for (const auto& buffer : m_buffers) bytes += buffer.second.size();
    return bytes;
  }

private:
  [[noreturn]] void fail_at(std::size_t byte, const std::string& what) const
  {
    throw IO_error(m_file, "byte " + std::to_string(byte) + ": " + what);
  }

  // The chunks of a binary file: the text, which is returned, and the first buffer.
  std::string_view take_chunks()
  {
    constexpr std::size_t head = 12, chunk_head = 8, json = 0x4e4f534a, binary = 0x004e4942;
    if (m_data.size() < head) fail_at(m_data.size(), "the file ends within the header");
    const std::uint32_t version = number_at<std::uint32_t>(m_data, 4);
    if (version != 2) fail_at(4, "glTF " + std::to_string(version) + " is not read, 2.0 is");
    const std::size_t length = number_at<std::uint32_t>(m_data, 8);
    if (length > m_data.size())
      fail_at(m_data.size(),
              "the file ends after " + std::to_string(m_data.size()) + " of " + std::to_string(length) + " bytes");
    std::string_view text;
    for (std::size_t at = head, i = 0; at + chunk_head <= length; ++i) {
      const std::size_t size = number_at<std::uint32_t>(m_data, at), type = number_at<std::uint32_t>(m_data, at + 4);
      at += chunk_head;
      if (size > length - at) fail_at(at, "the chunk of " + std::to_string(size) + " bytes goes beyond the end");
      if ((i == 0) != (type == json)) fail_at(at - 4, "the first chunk, and no other, is JSON");
      if (i == 0) text = m_data.substr(at, size);
      if (i == 1 && type == binary) m_chunk = m_data.substr(at, size);
      at += size;
    }
    if (text.data() == nullptr) fail_at(length, "the file has no chunk of JSON");
    return text;
  }

  std::string_view bytes_of_view(std::size_t i, const std::string& user) const
  {
    const Json& view = element("bufferViews", i, user);
    const std::string where = "bufferView " + std::to_string(i);
    for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"})
      if (!member(member(view, "extensions"), name).is_null())
        fail(where, "what is compressed by meshopt is not read: save the file without compression");
    const auto buffer = whole(view, "buffer", where);
    if (!buffer) fail(where, "it has no buffer");
    const std::string_view bytes = bytes_of_buffer(*buffer, where);
    const std::size_t offset = whole(view, "byteOffset", where).value_or(0),
                      length = whole(view, "byteLength", where).value_or(0);
    if (offset > bytes.size() || length > bytes.size() - offset)
      fail(where, "it goes beyond its buffer of " + std::to_string(bytes.size()) + " bytes");
    return bytes.substr(offset, length);
  }

  std::string_view bytes_of_buffer(std::size_t i, const std::string& user) const
  {
    const Json& buffer = element("buffers", i, user);
    const std::string where = "buffer " + std::to_string(i);
    const auto length = whole(buffer, "byteLength", where);
    if (!length) fail(where, "it has no byteLength");
    const Json& uri = member(buffer, "uri");
    std::string_view bytes = m_chunk;
    if (uri.is_null()) {
      if (i != 0 || m_chunk.data() == nullptr) fail(where, "it is not in the file, and has no uri");
    } else {
      auto found = m_buffers.find(i);
      if (found == m_buffers.end()) {
        if (!uri.is_string()) fail(where, "its uri is no text");
        found = m_buffers.emplace(i, read_uri(uri.get_ref<const std::string&>(), *length, where)).first;
      }
      bytes = found->second;
    }
    if (bytes.size() < *length)
      fail(where, "it has " + std::to_string(bytes.size()) + " of its " + std::to_string(*length) + " bytes");
    return bytes.substr(0, *length);
  }

  // Bytes in the text, or a file beside the file.
  std::string read_uri(const std::string& uri, std::size_t length, const std::string& where) const
  {
    namespace fs = std::filesystem;
    if (uri.compare(0, 5, "data:") == 0) {
      const std::size_t comma = uri.find(',');
      const bool is_base64 = comma != std::string::npos && comma >= 7 && uri.compare(comma - 7, 7, ";base64") == 0;
      std::optional<std::string> bytes;
      if (is_base64) bytes = decode_base64(std::string_view(uri).substr(comma + 1));
      if (!bytes) fail(where, "its uri is not of data in base64");
      return std::move(*bytes);
    }
    const fs::path name = decode_percent(uri);
    const std::string shown = name.string().substr(0, 100);
    if (name.is_absolute() || uri.find("://") != std::string::npos)
      fail(where, "its uri does not name a file beside this one: '" + shown + "'");
    const fs::path path = fs::path(m_file).parent_path() / name;
    std::error_code error;
    if (!fs::is_regular_file(path, error)) fail(where, "there is no file '" + shown + "' beside this one");
    const auto size = fs::file_size(path, error);
    if (error || size < length)
      fail(where,
           "the file '" + shown + "' has " + std::to_string(size) + " of its " + std::to_string(length) + " bytes");
    return read_file(path.string());
  }

  std::string_view m_data, m_chunk; // all, and the buffer that is a part of it
  const std::string& m_file;
  Json m_root;
  mutable std::map<std::size_t, std::string> m_buffers; // as they are used
};

} // namespace internal
} // namespace Crude_registration
} // namespace CGAL

#endif // CGAL_CRUDE_REGISTRATION_IO_INTERNAL_GLTF_FILE_H
