/* A shim (LD_PRELOAD) between the program and the system: it counts the calls that open, read,
   change, sync, rename and close files, and makes the k-th of a kind fail, or kills the process
   before it, or keeps a record of everything that changes files.

     FAULT_CALL   open read stat pwrite write fsync rename close unlink truncate, or change: any that
                  changes files (all but open for reading, read, stat, close and write), or new:
                  operator new. write is that of a C++ stream
     FAULT_AT     which call of that kind, from 1; 0: none, only count
     FAULT_ERRNO  the number of the error it gives; 0: the process is killed instead
     FAULT_SIGNAL before that call, this signal is sent to the process; the call does not fail
     FAULT_EVER   1: all calls from there on fail, not only this one
     FAULT_UNDER  only files in this folder count
     FAULT_COUNT  the number of calls of each kind is written here in the end
     FAULT_RECORD every change and every sync is recorded here, for replaying a power cut

   A failed fsync also loses what it was to bring onto the disk, as Linux does: with FAULT_LOSE=1
   the pages written to that file since its last sync are zeroed. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#define MOST_FILES 4096
#define MOST_PENDING 65536

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static char names[MOST_FILES][512];        /* of the open files that count; "" for others */
static struct { int file; off_t at; size_t size; } pending[MOST_PENDING];
static int pending_count;
/* The first counts every call that changes files. operator new is counted only if it is FAULT_CALL. */
static const char* const kinds[] = {"change", "open",   "read",  "pwrite", "fsync", "truncate",
                                    "rename", "unlink", "close", "stat",   "write", "new"};
#define KINDS (int)(sizeof kinds / sizeof *kinds)
static long counted[KINDS];
static int record = -1;

static const char* setting(const char* name) {
    const char* text = getenv(name);
    return text ? text : "";
}
static int under(const char* path) {
    const char* folder = setting("FAULT_UNDER");
    return path && *folder && strncmp(path, folder, strlen(folder)) == 0;
}
static const char* name_of(int file) {
    return file >= 0 && file < MOST_FILES ? names[file] : "";
}
static void note(int file, const char* path) {
    if (file >= 0 && file < MOST_FILES)
        snprintf(names[file], sizeof names[file], "%s", under(path) ? path : "");
}

static void raw_write(int file, const void* bytes, size_t size) {
    const char* p = bytes;
    while (size > 0) {
        const long done = syscall(SYS_write, file, p, size);
        if (done <= 0) _exit(99);
        p += done;
        size -= (size_t)done;
    }
}

/* Entries: a letter, two numbers, two texts with their lengths, the bytes. */
static void keep(char what, long a, long size, const char* from, const char* to, const void* bytes) {
    if (!*setting("FAULT_RECORD")) return;
    if (record < 0)
        record = (int)syscall(SYS_openat, AT_FDCWD, setting("FAULT_RECORD"),
                              O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
    char head[1400];
    const int length = snprintf(head, sizeof head, "%c\t%ld\t%ld\t%s\t%s\n", what, a, size, from, to);
    raw_write(record, head, (size_t)length);
    if (bytes) raw_write(record, bytes, (size_t)size);
}

static void tell_count(void) {
    const char* path = setting("FAULT_COUNT");
    if (!*path) return;
    char text[32 * KINDS];
    int length = 0;
    for (int k = 0; k < KINDS; ++k) length += snprintf(text + length, 32, "%s %ld\n", kinds[k], counted[k]);
    const int file = (int)syscall(SYS_openat, AT_FDCWD, path, O_WRONLY | O_CREAT | O_TRUNC, 0644);
    if (file < 0) return;
    raw_write(file, text, (size_t)length);
    syscall(SYS_close, file);
}
__attribute__((constructor)) static void begin(void) { atexit(tell_count); }

/* Does this call fail? Called with the lock held. */
static int fails(const char* call, int changes) {
    const char* wanted = setting("FAULT_CALL");
    long count = 0; /* of the wanted kind, with this call; 0: this call is of another */
    for (int k = 0; k < KINDS; ++k) {
        if (strcmp(kinds[k], call) != 0 && !(k == 0 && changes)) continue;
        ++counted[k];
        if (strcmp(kinds[k], wanted) == 0) count = counted[k];
    }
    const long at = atol(setting("FAULT_AT"));
    if (count == 0 || at == 0 || (count != at && !(count > at && *setting("FAULT_EVER") == '1'))) return 0;
    const int sent = atoi(setting("FAULT_SIGNAL"));
    if (sent != 0) {
        kill(getpid(), sent);
        return 0;
    }
    const int error = atoi(setting("FAULT_ERRNO"));
    if (error == 0) kill(getpid(), SIGKILL);
    errno = error;
    return 1;
}

#define REAL(result, name, parameters) \
    static result(*real) parameters;   \
    if (!real) real = (result(*) parameters)dlsym(RTLD_NEXT, name)

static int opened(int folder, const char* path, int flags, mode_t mode) {
    pthread_mutex_lock(&lock);
    const int counts = under(path);
    if (counts && fails("open", (flags & (O_CREAT | O_TRUNC)) != 0)) {
        pthread_mutex_unlock(&lock);
        return -1;
    }
    const int file = (int)syscall(SYS_openat, folder, path, flags, mode);
    note(file, path);
    if (counts && file >= 0 && (flags & O_CREAT)) keep('c', 0, 0, path, "", NULL);
    pthread_mutex_unlock(&lock);
    return file;
}
static mode_t mode_in(int flags, va_list list) {
    return flags & (O_CREAT | O_TMPFILE) ? va_arg(list, mode_t) : 0;
}
#define OPEN(name)                                    \
    int name(const char* path, int flags, ...) {      \
        va_list list;                                 \
        va_start(list, flags);                        \
        const mode_t mode = mode_in(flags, list);     \
        va_end(list);                                 \
        return opened(AT_FDCWD, path, flags, mode);   \
    }
OPEN(open)
OPEN(open64)
int openat(int folder, const char* path, int flags, ...) {
    va_list list;
    va_start(list, flags);
    const mode_t mode = mode_in(flags, list);
    va_end(list);
    return opened(folder, path, flags, mode);
}

ssize_t read(int file, void* bytes, size_t size) {
    REAL(ssize_t, "read", (int, void*, size_t));
    if (*name_of(file)) {
        pthread_mutex_lock(&lock);
        const int failed = fails("read", 0);
        pthread_mutex_unlock(&lock);
        if (failed) return -1;
    }
    return real(file, bytes, size);
}
static ssize_t read_at(int file, void* bytes, size_t size, off_t at) {
    if (*name_of(file)) {
        pthread_mutex_lock(&lock);
        const int failed = fails("read", 0);
        pthread_mutex_unlock(&lock);
        if (failed) return -1;
    }
    return syscall(SYS_pread64, file, bytes, size, at);
}
ssize_t pread(int file, void* bytes, size_t size, off_t at) { return read_at(file, bytes, size, at); }
ssize_t pread64(int file, void* bytes, size_t size, off_t at) {
    return read_at(file, bytes, size, at);
}

/* Whether a file exists. */
#define STAT(name)                                          \
    int name(const char* path, struct name* about) {        \
        REAL(int, #name, (const char*, struct name*));      \
        pthread_mutex_lock(&lock);                          \
        const int failed = under(path) && fails("stat", 0); \
        pthread_mutex_unlock(&lock);                        \
        return failed ? -1 : real(path, about);             \
    }
STAT(stat)
STAT(stat64)

static ssize_t write_at(int file, const void* bytes, size_t size, off_t at) {
    if (!*name_of(file)) return syscall(SYS_pwrite64, file, bytes, size, at);
    pthread_mutex_lock(&lock);
    ssize_t done = -1;
    if (!fails("pwrite", 1)) {
        done = syscall(SYS_pwrite64, file, bytes, size, at);
        if (done > 0) keep('w', at, done, name_of(file), "", bytes);
        if (pending_count < MOST_PENDING) {
            pending[pending_count].file = file;
            pending[pending_count].at = at;
            pending[pending_count++].size = size;
        }
    }
    pthread_mutex_unlock(&lock);
    return done;
}
ssize_t pwrite(int file, const void* bytes, size_t size, off_t at) {
    return write_at(file, bytes, size, at);
}
ssize_t pwrite64(int file, const void* bytes, size_t size, off_t at) {
    return write_at(file, bytes, size, at);
}

/* A stream opens its file within the C library, so its name is that of the descriptor. */
static int is_stream_under(int file) {
    char link[64], name[512];
    if (strcmp(setting("FAULT_CALL"), "write") != 0) return 0;
    snprintf(link, sizeof link, "/proc/self/fd/%d", file);
    const ssize_t length = readlink(link, name, sizeof name - 1);
    if (length < 0) return 0;
    name[length] = '\0';
    return under(name);
}
ssize_t write(int file, const void* bytes, size_t size) {
    if (is_stream_under(file)) {
        pthread_mutex_lock(&lock);
        const int failed = fails("write", 0);
        pthread_mutex_unlock(&lock);
        if (failed) return -1;
    }
    return syscall(SYS_write, file, bytes, size);
}

/* Forgets what waits for a sync; when that failed, it is lost. */
static void forget_pending(int file, int lost) {
    int left = 0;
    for (int k = 0; k < pending_count; ++k) {
        if (file >= 0 && pending[k].file != file) {
            pending[left++] = pending[k];
        } else if (lost && *setting("FAULT_LOSE") == '1') {
            char* zeros = calloc(1, pending[k].size);
            syscall(SYS_pwrite64, pending[k].file, zeros, pending[k].size, pending[k].at);
            free(zeros);
        }
    }
    pending_count = left;
}
static int synced(int file, long call, int everything) {
    if (!*name_of(file)) return (int)syscall(call, file);
    pthread_mutex_lock(&lock);
    const int failed = fails("fsync", 1), error = errno;
    if (!failed) keep(everything ? 'S' : 's', 0, 0, name_of(file), "", NULL);
    forget_pending(everything ? -1 : file, failed);
    pthread_mutex_unlock(&lock);
    errno = error;
    return failed ? -1 : 0;
}
int fsync(int file) { return synced(file, SYS_fsync, 0); }
int fdatasync(int file) { return synced(file, SYS_fdatasync, 0); }
int syncfs(int file) { return synced(file, SYS_syncfs, 1); }

static int truncated(int file, off_t size) {
    if (!*name_of(file)) return (int)syscall(SYS_ftruncate, file, size);
    pthread_mutex_lock(&lock);
    int result = -1;
    if (!fails("truncate", 1)) {
        result = (int)syscall(SYS_ftruncate, file, size);
        keep('t', size, 0, name_of(file), "", NULL);
    }
    pthread_mutex_unlock(&lock);
    return result;
}
int ftruncate(int file, off_t size) { return truncated(file, size); }
int ftruncate64(int file, off_t size) { return truncated(file, size); }

int rename(const char* from, const char* to) {
    if (!under(from)) return (int)syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0);
    pthread_mutex_lock(&lock);
    int result = -1;
    if (!fails("rename", 1)) {
        result = (int)syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0);
        if (result == 0) keep('r', 0, 0, from, to, NULL);
        for (int file = 0; file < MOST_FILES; ++file)
            if (strcmp(names[file], from) == 0) note(file, to);
    }
    pthread_mutex_unlock(&lock);
    return result;
}
static int removed(const char* path) {
    if (!under(path)) return (int)syscall(SYS_unlinkat, AT_FDCWD, path, 0);
    pthread_mutex_lock(&lock);
    int result = -1;
    if (!fails("unlink", 1)) {
        result = (int)syscall(SYS_unlinkat, AT_FDCWD, path, 0);
        if (result == 0) keep('u', 0, 0, path, "", NULL);
    }
    pthread_mutex_unlock(&lock);
    return result;
}
int unlink(const char* path) { return removed(path); }
int remove(const char* path) { return removed(path); }

/* operator new, and what throws std::bad_alloc. */
static void ask_for_memory(void) {
    static int wanted = -1;
    if (wanted < 0) wanted = strcmp(setting("FAULT_CALL"), "new") == 0;
    if (!wanted) return;
    pthread_mutex_lock(&lock);
    const int failed = fails("new", 0);
    pthread_mutex_unlock(&lock);
    if (failed) {
        void (*refuse)(void) = (void (*)(void))dlsym(RTLD_DEFAULT, "_ZSt17__throw_bad_allocv");
        refuse();
    }
}
void* _Znwm(size_t size) {
    ask_for_memory();
    return malloc(size ? size : 1);
}
/* What asks for aligned memory: the columns of a simulation. */
void* _ZnwmSt11align_val_t(size_t size, size_t alignment) {
    ask_for_memory();
    return aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
}

int close(int file) {
    if (!*name_of(file)) return (int)syscall(SYS_close, file);
    pthread_mutex_lock(&lock);
    const int failed = fails("close", 0), error = errno;
    for (int k = 0; k < pending_count; ++k)
        if (pending[k].file == file) pending[k] = pending[--pending_count], --k;
    note(file, "");
    syscall(SYS_close, file); /* a close that fails closes all the same */
    pthread_mutex_unlock(&lock);
    errno = error;
    return failed ? -1 : 0;
}
