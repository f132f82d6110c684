// Arrays aligned to cache lines; large ones request huge pages from the system.
#pragma once

#if defined(__linux__)
#include <sys/mman.h>
#endif

#include <cstddef>
#include <new>
#include <vector>

namespace swirl {

template <class T>
struct HugePages {
    using value_type = T;
    static constexpr std::size_t huge_page = std::size_t{1} << 21;

    HugePages() = default;
    template <class U>
    explicit HugePages(const HugePages<U>&) {}

    static std::align_val_t alignment(std::size_t count) {
        return std::align_val_t{count * sizeof(T) < huge_page ? 64 : huge_page};
    }
    T* allocate(std::size_t count) {
        const std::size_t bytes = count * sizeof(T);
        void* const block = ::operator new(bytes, alignment(count));
#if defined(__linux__)
        if (bytes >= huge_page) madvise(block, bytes / huge_page * huge_page, MADV_HUGEPAGE);
#endif
        return static_cast<T*>(block);
    }
    void deallocate(T* block, std::size_t count) { ::operator delete(block, alignment(count)); }
    bool operator==(const HugePages&) const = default;
};

template <class T>
using OnHugePages = std::vector<T, HugePages<T>>;

}  // namespace swirl
