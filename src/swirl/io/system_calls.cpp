#include "swirl/io/system_calls.hpp"

#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <system_error>

#if defined(__linux__)
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#elif defined(__APPLE__)
#include <crt_externs.h>
#include <mach-o/dyld.h>
#include <sys/random.h>
#elif defined(__FreeBSD__)
#include <sys/procctl.h>
#include <sys/sysctl.h>
#endif

#if !defined(__APPLE__)
extern char** environ;
#endif

namespace swirl::system {
namespace {

#if !defined(__linux__)
/// Systems without MSG_NOSIGNAL have a property of the socket instead.
#if defined(SO_NOSIGPIPE)
bool without_signal(int socket) {
    const int yes = 1;
    return ::setsockopt(socket, SOL_SOCKET, SO_NOSIGPIPE, &yes, sizeof yes) == 0;
}
#else
bool without_signal(int) { return true; }
#endif

/// A child that another thread starts between open and fcntl() inherits the descriptor. Linux
/// closes this gap.
bool close_on_exec(int file) { return ::fcntl(file, F_SETFD, FD_CLOEXEC) == 0; }

void close_both(const int (&ends)[2]) {
    const int reason = errno;
    ::close(ends[0]);
    ::close(ends[1]);
    errno = reason;
}
#endif

/// Renames without replacing, in one step. Fails with EINVAL, ENOSYS or ENOTSUP if the system or
/// the file system does not support this.
bool rename_exclusively(const char* from, const char* to) {
#if defined(__linux__)
    return ::renameat2(AT_FDCWD, from, AT_FDCWD, to, RENAME_NOREPLACE) == 0;
#elif defined(__APPLE__)
    return ::renamex_np(from, to, RENAME_EXCL) == 0;
#else
    static_cast<void>(from);
    static_cast<void>(to);
    errno = ENOSYS;
    return false;
#endif
}

}  // namespace

bool random_bytes(void* bytes, std::size_t size) { return ::getentropy(bytes, size) == 0; }

bool rename_to_new_name(const std::filesystem::path& from, const std::filesystem::path& to) {
    if (rename_exclusively(from.c_str(), to.c_str())) return true;
    if (errno != EINVAL && errno != ENOSYS && errno != ENOTSUP) return false;
    if (::link(from.c_str(), to.c_str()) == 0) return ::unlink(from.c_str()) == 0;
    if (errno == EEXIST) return false;
    if (::access(to.c_str(), F_OK) == 0) {
        errno = EEXIST;
        return false;
    }
    return ::rename(from.c_str(), to.c_str()) == 0;
}

bool sync_file(int file) {
#if defined(__APPLE__)
    // fsync() of macOS leaves the bytes in the cache of the drive. Network volumes do not support
    // F_FULLFSYNC.
    return ::fcntl(file, F_FULLFSYNC) == 0 || ::fsync(file) == 0;
#else
    return ::fsync(file) == 0;
#endif
}

bool sync_file_data(int file) {
#if defined(__APPLE__)
    return sync_file(file);
#else
    return ::fdatasync(file) == 0;
#endif
}

bool sync_filesystem(int folder) {
#if defined(__linux__)
    return ::syncfs(folder) == 0;
#elif defined(__APPLE__)
    return ::fsync_volume_np(folder, SYNC_VOLUME_FULLSYNC | SYNC_VOLUME_WAIT) == 0;
#else
    // sync() reports no errors, and POSIX allows it to return early.
    ::sync();
    return ::fsync(folder) == 0 || errno == EINVAL;
#endif
}

void start_writeback(int file) {
#if defined(__linux__)
    ::sync_file_range(file, 0, 0, SYNC_FILE_RANGE_WRITE);
#else
    static_cast<void>(file);
#endif
}

unsigned granted_cores() {
#if defined(__linux__)
    cpu_set_t allowed;
    CPU_ZERO(&allowed);
    if (::sched_getaffinity(0, sizeof allowed, &allowed) == 0)
        return static_cast<unsigned>(CPU_COUNT(&allowed));
#endif
    return 0;
}

std::filesystem::path program_file() {
    std::error_code unknown;
#if defined(__linux__)
    return std::filesystem::read_symlink("/proc/self/exe", unknown);
#elif defined(__APPLE__)
    std::uint32_t size = 0;
    ::_NSGetExecutablePath(nullptr, &size);
    std::string name(size, '\0');
    if (::_NSGetExecutablePath(name.data(), &size) != 0) return {};
    return std::filesystem::canonical(name.c_str(), unknown);
#elif defined(__FreeBSD__)
    const int query[] = {CTL_KERN, KERN_PROC, KERN_PROC_PATHNAME, -1};
    std::size_t size = 0;
    if (::sysctl(query, 4, nullptr, &size, nullptr, 0) != 0) return {};
    std::string name(size, '\0');
    if (::sysctl(query, 4, name.data(), &size, nullptr, 0) != 0) return {};
    return name.c_str();
#else
    return std::filesystem::read_symlink("/proc/curproc/exe", unknown);  // NetBSD, DragonFly BSD
#endif
}

char** environment() {
#if defined(__APPLE__)
    return *::_NSGetEnviron();  // shared libraries cannot use `environ`
#else
    return ::environ;
#endif
}

void end_with_parent() {
#if defined(__linux__)
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
#elif defined(__FreeBSD__)
    int signal = SIGKILL;
    ::procctl(P_PID, 0, PROC_PDEATHSIG_CTL, &signal);
#endif
}

int open_unnamed_file() {
#if defined(__linux__)
    return ::memfd_create("swirl", MFD_CLOEXEC);
#else
    const char* const folder = std::getenv("TMPDIR");
    std::string name =
        std::string(folder != nullptr && *folder != '\0' ? folder : "/tmp") + "/swirl-XXXXXX";
    const int file = ::mkstemp(name.data());
    if (file < 0) return -1;
    ::unlink(name.c_str());
    if (close_on_exec(file)) return file;
    ::close(file);
    return -1;
#endif
}

bool open_pipe(int (&ends)[2]) {
#if defined(__linux__)
    return ::pipe2(ends, O_CLOEXEC) == 0;
#else
    if (::pipe(ends) != 0) return false;
    if (close_on_exec(ends[0]) && close_on_exec(ends[1])) return true;
    close_both(ends);
    return false;
#endif
}

bool open_socket_pair(int (&ends)[2]) {
#if defined(__linux__)
    return ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) == 0;
#else
    if (::socketpair(AF_UNIX, SOCK_STREAM, 0, ends) != 0) return false;
    if (close_on_exec(ends[0]) && close_on_exec(ends[1]) && without_signal(ends[0]) &&
        without_signal(ends[1]))
        return true;
    close_both(ends);
    return false;
#endif
}

ssize_t send(int socket, const void* bytes, std::size_t size) {
#if defined(MSG_NOSIGNAL)
    return ::send(socket, bytes, size, MSG_NOSIGNAL);
#else
    return ::send(socket, bytes, size, 0);
#endif
}

}  // namespace swirl::system
