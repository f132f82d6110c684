// The fuzzer's input as a file in memory, with a path that a reader can open.
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

namespace swirl {

class FuzzedFile {
  public:
    FuzzedFile(const std::uint8_t* data, std::size_t size)
        : descriptor_(memfd_create("fuzzed", 0)) {
        for (std::size_t done = 0; done < size;) {
            const ssize_t written = write(descriptor_, data + done, size - done);
            if (written <= 0) __builtin_trap();  // out of memory
            done += static_cast<std::size_t>(written);
        }
    }
    ~FuzzedFile() { close(descriptor_); }
    FuzzedFile(const FuzzedFile&) = delete;
    FuzzedFile& operator=(const FuzzedFile&) = delete;

    std::filesystem::path path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

  private:
    int descriptor_;
};

/// Runs the reader, which may throw only the given error types.
template <class Refusal, class... Others, class Read>
void read_or_reject(const Read& read) {
    if constexpr (sizeof...(Others) > 0) {
        read_or_reject<Others...>([&] {
            try {
                read();
            } catch (const Refusal&) {
            }
        });
    } else {
        try {
            read();
        } catch (const Refusal&) {
        }
    }
}

}  // namespace swirl
