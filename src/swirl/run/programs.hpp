// Where the programs of swirl are. `swirl NAME` runs the program of the command NAME:
//
//     build tree   DIR/swirl        DIR/swirl-NAME
//     installed    PREFIX/bin/swirl PREFIX/libexec/swirl/swirl-commands, which has all commands
#pragma once

#include <filesystem>
#include <string>

namespace swirl {

/// True if the owner of the file is root or that of `program`. Files that another user has put next
/// to a copied program are not run.
bool is_trusted(const std::filesystem::path& file, const std::filesystem::path& program);

/// The program that has the command, for the program `swirl`. Empty if there is none.
std::filesystem::path program_of_command(const std::string& command);

/// `swirl` itself, for a program of a command. If there is none, this program.
std::filesystem::path main_program();

}  // namespace swirl
