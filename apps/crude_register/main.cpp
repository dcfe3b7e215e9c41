// Copyright (c) 2026 The Crude_registration authors.
// All rights reserved.
//
// This file is part of the CGAL package Crude_registration.
//
// SPDX-License-Identifier: GPL-3.0-or-later

// The command line: registers scans, puts many together, says what is in one, converts and simulates some.

#include "commands.h"
#include "options.h"
#include "progress.h"

#include <exception>
#include <iostream>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

struct Named_command
{
  const char* name;
  const char* what;
  int (*run)(const std::vector<std::string>&);
};
constexpr Named_command commands[] = {
    {"register", "find the motion that maps one scan onto another", &run_register},
    {"judge", "say of a motion that somebody found whether it is right", &run_judge},
    {"assemble", "put many scans together: a pose for each", &run_assemble},
    {"info", "say what is in a scan, and what the method makes of it", &run_info},
    {"convert", "write a scan in another format", &run_convert},
    {"simulate", "write range scans of a generated body, with their poses", &run_simulate}};

constexpr const char* formats =
    "SOURCE, TARGET and SCAN are range images (PLY with a range_grid, PTX, organised PCD, depth images in PNG), meshes "
    "(PLY, OFF,\nOBJ, STL, glTF) or points (text, PLY, PCD, NPY, LAS, glTF). FILE.ptx#2 is the second scan of a PTX "
    "file. For "
    "SCAN... a folder stands for\nall scans in it, and a pattern as 'scan_*.ply' for all files that it fits.\n";

constexpr const char* exit_codes =
    "0 registered, right, or some scans are connected; 2 ambiguous or refinable; 3 not registered, wrong, or no scans "
    "are\nconnected; 1 an error; 130 ended by Ctrl-C.\n";

void write_usage()
{
  std::cout << "  crude_register register source.ply target.ply --apply source_in_target.ply\n"
               "  crude_register assemble scans/ --poses poses.txt --picture model.png\n"
               "  crude_register simulate --output scans\n\n"
               "usage: crude_register COMMAND ARGUMENT... [OPTION...]\n\n";
  for (const Named_command& c : commands)
    std::cout << "  " << c.name << std::string(10 - std::string(c.name).size(), ' ') << c.what << '\n';
  std::cout << "\ncrude_register COMMAND --help tells the options of a command.\n\n"
            << formats << "\nExit code: " << exit_codes;
}

// The texts that are made of what the commands say of themselves: the man page and the completions.
void write_man_page()
{
  std::cout << ".TH CRUDE_REGISTER 1 \"\" \"Crude_registration " CRUDE_REGISTRATION_VERSION
               "\" \"User Commands\"\n.SH NAME\ncrude_register \\- register range scans whose relative position is "
               "unknown\n.SH SYNOPSIS\n.B crude_register\n\\fICOMMAND\\fR \\fIARGUMENT\\fR... "
               "[\\fIOPTION\\fR...]\n.SH DESCRIPTION\n"
            << troff(formats) << ".SH COMMANDS\n";
  for (const Named_command& c : commands) c.run({"--man"});
  std::cout << ".SH EXIT STATUS\n" << troff(exit_codes);
}

void write_bash_completion()
{
  std::cout << R"(# Completion of crude_register for bash.
_crude_register_words()
{
  local command=$1 previous=$2
  case $command in
)";
  for (const Named_command& c : commands) c.run({"--bash-completion"});
  std::cout << R"(  esac
}
_crude_register()
{
  local current=${COMP_WORDS[COMP_CWORD]} words= options=
  COMPREPLY=()
  if ((COMP_CWORD == 1)); then
    COMPREPLY=($(compgen -W "--help)";
  for (const Named_command& c : commands) std::cout << ' ' << c.name;
  std::cout << R"(" -- "$current"))
    return
  fi
  _crude_register_words "${COMP_WORDS[1]}" "${COMP_WORDS[COMP_CWORD - 1]}"
  if [[ -n $words ]]; then COMPREPLY=($(compgen -W "$words" -- "$current"))
  elif [[ $current == -* ]]; then COMPREPLY=($(compgen -W "$options" -- "$current"))
  fi
}
complete -o default -F _crude_register crude_register
)";
}

void write_zsh_completion()
{
  std::cout
      << "#compdef crude_register\n# Completion of crude_register for zsh.\n_crude_register()\n{\n  if ((CURRENT == "
         "2)); then\n    local -a commands=(";
  for (const Named_command& c : commands) std::cout << "\n      " << quoted(std::string(c.name) + ':' + c.what);
  std::cout << ")\n    _describe command commands\n    return\n  fi\n  local command=$words[2]\n  shift words\n  "
               "((CURRENT--))\n"
               "  case $command in\n";
  for (const Named_command& c : commands) c.run({"--zsh-completion"});
  std::cout << "  esac\n}\n_crude_register \"$@\"\n";
}

int run(const std::vector<std::string>& arguments)
{
  if (arguments.empty()) throw Usage_error("no command is given");
  const std::string& command = arguments.front();
  const std::vector<std::string> rest(arguments.begin() + 1, arguments.end());
  for (const Named_command& c : commands)
    if (command == c.name) return c.run(rest);
  if (command == "--help" || command == "-h" || command == "help") write_usage();
  else if (command == "--version") std::cout << "crude_register " CRUDE_REGISTRATION_VERSION "\n";
  else if (command == "--man") write_man_page();
  else if (command == "--bash-completion") write_bash_completion();
  else if (command == "--zsh-completion") write_zsh_completion();
  else throw Usage_error("there is no command '" + command + "'");
  return 0;
}

} // namespace

int main(int argc, char** argv)
{
  try {
    const int code = run(std::vector<std::string>(argv + 1, argv + argc));
    std::cout.flush();
    if (!std::cout) throw std::runtime_error("the output cannot be written");
    return is_interrupted() ? int(EXIT_INTERRUPTED) : code;
  } catch (const Usage_error& e) {
    std::cerr << "crude_register: " << e.what() << "; see crude_register --help\n";
  } catch (const std::bad_alloc&) {
    std::cerr << "crude_register: out of memory\n";
  } catch (const std::exception& e) {
    std::cerr << "crude_register: " << e.what() << '\n';
  }
  return is_interrupted() ? EXIT_INTERRUPTED : EXIT_ERROR;
}
