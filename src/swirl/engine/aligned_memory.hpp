// Memory for the arrays of a simulation.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <new>
#include <vector>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace swirl {

/// Zeroed arrays, aligned to cache lines; large ones are aligned to huge pages. Zeroing gigabytes
/// takes seconds, so `is_stopped` is polled between two pieces. If it returns true the rest of the
/// array is left uninitialised and must not be used.
class AlignedMemory {
  public:
    explicit AlignedMemory(const std::function<bool()>& is_stopped) : is_stopped_(is_stopped) {}
    template <class T>
    T* add(std::size_t count) {
        const std::size_t bytes = (count * sizeof(T) + 63) / 64 * 64;
        const std::align_val_t alignment{bytes < huge_page ? 64 : huge_page};
        auto* block = static_cast<unsigned char*>(::operator new(bytes, alignment));
        blocks_.emplace_back(block, Free{alignment});
#if defined(__linux__)
        // With 10⁶ discs, neighbours lie on more pages than the processor's address cache holds,
        // unless pages are large. This is a hint; it is harmless if the system ignores it.
        if (bytes >= huge_page) madvise(block, bytes / huge_page * huge_page, MADV_HUGEPAGE);
#endif
        clear(block, bytes);
        bytes_ += bytes;
        return reinterpret_cast<T*>(block);
    }
    std::uint64_t bytes() const { return bytes_; }

  private:
    static constexpr std::size_t huge_page = std::size_t{1} << 21;
    void clear(unsigned char* block, std::size_t bytes) const {
        constexpr std::size_t piece = 32 * huge_page;
        for (std::size_t at = 0; at < bytes; at += piece) {
            if (bytes > piece && is_stopped_ && is_stopped_()) return;
            std::memset(block + at, 0, std::min(piece, bytes - at));
        }
    }
    struct Free {
        std::align_val_t alignment;
        void operator()(unsigned char* p) const { ::operator delete(p, alignment); }
    };
    const std::function<bool()>& is_stopped_;
    std::vector<std::unique_ptr<unsigned char, Free>> blocks_;
    std::uint64_t bytes_ = 0;
};

}  // namespace swirl
