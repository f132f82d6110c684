/* Functions of macOS, implemented with those of Linux, so that the branches for macOS can be compiled
   and run without a Mac. The declarations in this folder state how they are called. */
#define _GNU_SOURCE
#include <crt_externs.h>
#include <errno.h>
#include <fcntl.h>
#include <mach-o/dyld.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

char*** _NSGetEnviron(void) { return &environ; }

int _NSGetExecutablePath(char* buffer, uint32_t* size) {
    char path[4096];
    const ssize_t length = readlink("/proc/self/exe", path, sizeof path - 1);
    if (length < 0 || *size < (uint32_t)length + 1) {
        *size = (uint32_t)length + 1;
        return -1;
    }
    path[length] = 0;
    strcpy(buffer, path);
    return 0;
}

int renamex_np(const char* from, const char* to, unsigned int flags) {
    if (flags == RENAME_EXCL) return renameat2(AT_FDCWD, from, AT_FDCWD, to, RENAME_NOREPLACE);
    errno = EINVAL;
    return -1;
}

int fsync_volume_np(int file, int flags) {
    if (flags == (SYNC_VOLUME_FULLSYNC | SYNC_VOLUME_WAIT)) return syncfs(file);
    errno = EINVAL;
    return -1;
}

/* Linux has no such property of a socket, so no signal of the process arrives. */
int macos_setsockopt(int socket, int level, int name, const void* value, socklen_t size) {
    (void)socket;
    if (level == SOL_SOCKET && name == SO_NOSIGPIPE && size == sizeof(int) && *(const int*)value == 1)
        return signal(SIGPIPE, SIG_IGN) == SIG_ERR;
    errno = EINVAL;
    return -1;
}
