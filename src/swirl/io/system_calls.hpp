// Calls to the operating system that differ between Linux, macOS and other POSIX systems. All of
// them are here, so that a port changes one file. Functions that return a bool, a size or a file
// descriptor set errno if they fail.
//
// The Linux branches run on every build. The POSIX branches run in a test on Linux. The macOS
// branches are compiled against declarations of the functions that they use; they never ran on a
// Mac (docs/how-to/install.md).
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <filesystem>

namespace swirl::system {

/// Fills up to 256 bytes with random bits from the system.
bool random_bytes(void* bytes, std::size_t size);

/// Renames only if no file has the new name; fails with EEXIST otherwise. Not every file system
/// supports this, or hard links. With neither, a concurrent writer can slip in between the test and
/// the rename.
bool rename_to_new_name(const std::filesystem::path& from, const std::filesystem::path& to);

/// Brings a file onto the disk, past the cache of the drive.
bool sync_file(int file);
/// Like sync_file(), without the times of the file.
bool sync_file_data(int file);
/// Brings all files of the file system of `folder` onto the disk.
bool sync_filesystem(int folder);
/// Starts to write the pages of a file to the disk, where the system can; does not wait.
void start_writeback(int file);

/// The number of cores that this process may use, 0 if the system does not report it.
unsigned granted_cores();

/// The file of the running program, empty if the system does not report it.
std::filesystem::path program_file();
/// The environment that a child process inherits.
char** environment();
/// Asks the system to kill this process when its parent ends. Without such a call the process lives
/// on until it ends by itself.
void end_with_parent();

/// A file without a name, open for reading and writing. A program that is started does not inherit
/// it, nor the descriptors of the next two functions.
int open_unnamed_file();
bool open_pipe(int (&ends)[2]);
bool open_socket_pair(int (&ends)[2]);
/// Sends to a socket of open_socket_pair(). A closed reader gives EPIPE instead of a signal.
ssize_t send(int socket, const void* bytes, std::size_t size);

}  // namespace swirl::system
