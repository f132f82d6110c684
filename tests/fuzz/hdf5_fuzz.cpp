// Recordings with damaged bytes: bytes of good ones are replaced, and files are truncated. The
// first byte of the input selects the file. Every further four bytes are an offset and a new value.
//
// Most inputs end in the HDF5 library, which does not defend against malicious files. A crash
// inside the library is not a finding: it is reported and ends the process with code 0. So run this
// with -fork=1, which starts the next process. Crashes of this program end the process like any
// finding. (recording_fuzz.cpp reaches the readers of this program more often.)
#include <dlfcn.h>
#include <execinfo.h>
#include <ucontext.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <vector>

#include "read_recording.hpp"

namespace {

bool is_of_library(const void* code) {
    Dl_info about;
    return dladdr(code, &about) != 0 && about.dli_fname != nullptr &&
           std::strstr(about.dli_fname, "libhdf5") != nullptr;
}
/// The C library, and the sanitizer's replacements of memcpy and the like in this program.
bool is_of_system(const void* code) {
    Dl_info about;
    return dladdr(code, &about) == 0 || about.dli_fname == nullptr ||
           std::strstr(about.dli_fname, "/libc.so") != nullptr ||
           (about.dli_sname != nullptr &&
            (std::strncmp(about.dli_sname, "mem", 3) == 0 ||
             std::strncmp(about.dli_sname, "str", 3) == 0 ||
             std::strstr(about.dli_sname, "interceptor_") != nullptr));
}

/// True if the innermost function outside the C library belongs to the HDF5 library.
bool library_is_to_blame(const void* crashed) {
    if (is_of_library(crashed)) return true;
    if (!is_of_system(crashed)) return false;
    void* frames[64];
    const int count = backtrace(frames, 64);
    for (int k = 0; k < count; ++k) {
        if (frames[k] != crashed) continue;
        while (++k < count && is_of_system(frames[k])) continue;
        return k < count && is_of_library(frames[k]);
    }
    return false;
}

struct sigaction of_sanitizer;

void on_crash(int signal, siginfo_t* about, void* context) {
    const auto* registers = static_cast<const ucontext_t*>(context);
    const auto* crashed = reinterpret_cast<const void*>(registers->uc_mcontext.gregs[REG_RIP]);
    if (library_is_to_blame(crashed)) {
        constexpr char sentence[] = "The crash is inside the HDF5 library.\n";
        (void)!write(STDERR_FILENO, sentence, sizeof sentence - 1);
        _exit(0);
    }
    of_sanitizer.sa_sigaction(signal, about, context);
}

bool watch_library() {
    struct sigaction action {};
    action.sa_sigaction = on_crash;
    action.sa_flags = SA_SIGINFO | SA_ONSTACK;
    for (const int signal : {SIGBUS, SIGFPE, SIGSEGV}) sigaction(signal, &action, &of_sanitizer);
    return true;
}

}  // namespace

/// The library allocates as much as a file declares, up to gigabytes, and leaks memory if it cannot
/// open a file. So malloc is limited to what good files need. If `new` fails, the process still
/// ends.
extern "C" const char* __asan_default_options() {
    return "allocator_may_return_null=1:max_allocation_size_mb=256:"
           "detect_leaks=0:" SWIRL_CHEAPER_ALLOCATIONS;
}

/// Invalid reads inside the library, as seen once for an attribute, are not findings.
extern "C" const char* __asan_default_suppressions() { return "interceptor_via_lib:libhdf5"; }

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace swirl;
    static const bool watched = watch_library() && keep_tables_of_library();
    static const auto good = good_recordings();
    if (!watched || size == 0) return 0;
    const std::size_t which = data[0] % good.size();
    std::vector<unsigned char> bytes = good[which];
    for (std::size_t k = 1; k + 3 < size; k += 4)
        bytes[(65'536u * data[k] + 256u * data[k + 1] + data[k + 2]) % bytes.size()] = data[k + 3];
    if (size % 4 == 2) bytes.resize(bytes.size() * data[size - 1] / 256);
    const FuzzedFile file(bytes.data(), bytes.size());
    read_recording(file.path(), kinds_of_good_recordings[which]);
    return 0;
}
