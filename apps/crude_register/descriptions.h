// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CRUDE_REGISTER_DESCRIPTIONS_H
#define CRUDE_REGISTER_DESCRIPTIONS_H

// What a command says of itself: as help, as a section of the man page, and for the completion of shells.

#include <boost/program_options.hpp>

#include <cstddef>
#include <map>
#include <ostream>
#include <string>
#include <vector>

namespace po = boost::program_options;

struct Example
{
  std::string arguments, what; // behind the name of the program; what it does
};

struct Command
{
  std::string name, arguments; // as "SOURCE TARGET"
  std::string about;           // sentences
  std::vector<Example> examples;
  std::map<std::string, std::string> choices; // of options: the words they take, and a space between
};

inline void write_help(std::ostream& out, const Command& command, const po::options_description& options)
{
  for (const Example& e : command.examples)
    out << "  crude_register " << command.name << ' ' << e.arguments << "\n      " << e.what << '\n';
  out << "\nusage: crude_register " << command.name << ' ' << command.arguments << " [OPTION...]\n\n"
      << command.about << '\n'
      << options;
}

// An option as the other texts need it.
struct Option_text
{
  std::string name, about;
  bool takes_value;
};

inline std::vector<Option_text> texts_of(const po::options_description& options)
{
  std::vector<Option_text> texts;
  for (const auto& option : options.options())
    texts.push_back({option->long_name(), option->description(), option->semantic()->max_tokens() > 0});
  return texts;
}

// Text for troff: a hyphen that can be copied, and no line that is taken for a request.
inline std::string troff(const std::string& text)
{
  std::string result;
  bool at_start = true;
  for (const char c : text) {
    if (at_start && (c == '.' || c == '\'')) result += "\\&";
    if (c == '-') result += "\\-";
    else if (c == '\\') result += "\\e";
    else result += c;
    at_start = c == '\n';
  }
  return result;
}

inline void write_man_section(std::ostream& out, const Command& command, const po::options_description& options)
{
  out << ".SS \"crude_register " << command.name << ' ' << command.arguments << " [OPTION...]\"\n"
      << troff(command.about);
  for (const Option_text& option : texts_of(options)) {
    out << ".TP\n\\fB\\-\\-" << troff(option.name) << "\\fR" << (option.takes_value ? " \\fIARG\\fR\n" : "\n")
        << troff(option.about) << '\n';
  }
  for (const Example& e : command.examples)
    out << ".PP\n"
        << troff(e.what) << ":\n.PP\n.EX\n    crude_register " << troff(command.name + ' ' + e.arguments) << "\n.EE\n";
}

// What stands in quotation marks of the shell.
inline std::string quoted(const std::string& text)
{
  std::string result;
  for (const char c : text)
    if (c == '\'') result += "'\\''";
    else result += c;
  return '\'' + result + '\'';
}

// A case of the command: its options, and the words that some of them take.
inline void write_bash_case(std::ostream& out, const Command& command, const po::options_description& options)
{
  out << "    " << command.name << ")\n";
  for (const auto& [option, words] : command.choices)
    out << "      if [[ $previous == --" << option << " ]]; then words=" << quoted(words) << "; return; fi\n";
  out << "      options='--help";
  for (const Option_text& option : texts_of(options)) out << " --" << option.name;
  out << "'\n      ;;\n";
}

inline void write_zsh_case(std::ostream& out, const Command& command, const po::options_description& options)
{
  // what zsh takes for the end of a description
  const auto described = [](const std::string& text) {
    std::string result;
    for (const char c : text) {
      if (c == ':' || c == '[' || c == ']' || c == '\\') result += '\\';
      result += c;
    }
    return result;
  };
  out << "    " << command.name << ")\n      _arguments '--help[the options of the command]'";
  for (const Option_text& option : texts_of(options)) {
    const auto choice = command.choices.find(option.name);
    std::string spec = "--" + option.name + "[" + described(option.about) + "]";
    if (option.takes_value)
      spec += choice == command.choices.end() ? ":value:_files" : ":value:(" + choice->second + ")";
    out << " \\\n        " << quoted(spec);
  }
  out << " \\\n        '*:file:_files'\n      ;;\n";
}

// The text that an argument of the program itself asks of each of its commands; false if it asks for none.
inline bool write_description(std::ostream& out, const std::string& kind, const Command& command,
                              const po::options_description& options)
{
  if (kind == "--man") write_man_section(out, command, options);
  else if (kind == "--bash-completion") write_bash_case(out, command, options);
  else if (kind == "--zsh-completion") write_zsh_case(out, command, options);
  else return false;
  return true;
}

#endif // CRUDE_REGISTER_DESCRIPTIONS_H
