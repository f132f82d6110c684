#include "swirl/io/journaled_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "swirl/io/atomic_file.hpp"
#include "swirl/io/checksum.hpp"
#include "swirl/io/file_error.hpp"

namespace swirl {
namespace {

// The journal: this head, then `pages` times a page number and a page.
struct JournalHead {
    char magic[8];
    std::uint64_t pages, file_size, checksum;
};
constexpr char journal_magic[8] = {'s', 'w', 'i', 'r', 'l', 'j', 'n', '1'};

void close_if_open(int& file) {
    if (file >= 0) ::close(file);
    file = -1;
}

}  // namespace

JournaledFile::JournaledFile(const std::filesystem::path& path, Mode mode)
    : path_(path), journal_path_(path.string() + ".journal") {
    try {
        open(mode);
    } catch (...) {
        close_if_open(journal_);
        close_if_open(file_);
        throw;
    }
}

void JournaledFile::open(Mode mode) {
    const int how = mode == Mode::read     ? O_RDONLY | O_NONBLOCK
                    : mode == Mode::change ? O_RDWR | O_NOFOLLOW | O_NONBLOCK
                                           : O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CREAT;
    file_ = ::open(path_.c_str(), how | O_CLOEXEC, 0666);
    if (file_ < 0) fail("could not be opened");
    struct stat about;
    if (::fstat(file_, &about) != 0) fail("could not be opened");
    if (!S_ISREG(about.st_mode)) reject_irregular(path_);
    if (mode != Mode::read && ::flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
        throw FileError(fmt::format(
            "'{}' is being written by another process; wait for it or choose another name.",
            path_.string()));
    // Between the two calls whoever had the lock may have given the file its final name.
    struct stat named;
    if (mode != Mode::read && (::stat(path_.c_str(), &named) != 0 || named.st_ino != about.st_ino))
        throw FileError(
            fmt::format("'{}' was completed or removed by another process just now; try again.",
                        path_.string()));
    if (mode == Mode::create) return begin_anew();
    committed_ = size_ = static_cast<std::uint64_t>(about.st_size);
    new_ = size_ == 0;
    if (mode == Mode::read) first_page_when_opened_ = first_page();
    if (load_journal() && mode == Mode::change) commit();
}

JournaledFile::Page JournaledFile::first_page() const {
    Page page(page_size);
    const ssize_t got = ::pread(file_, page.data(), page_size, 0);
    page.resize(got < 0 ? 0 : static_cast<std::size_t>(got));
    return page;
}

bool JournaledFile::is_overtaken() const {
    return !first_page_when_opened_.empty() && first_page() != first_page_when_opened_;
}

void JournaledFile::begin_anew() {
    new_ = true;
    // What an older journal says must not come over the new file, not after a power cut either.
    if (::access(journal_path_.c_str(), F_OK) == 0) {
        open_journal();
        empty_journal();
        if (::fdatasync(journal_) != 0) fail("could not be emptied");
    }
    if (::ftruncate(file_, 0) != 0) fail("could not be emptied");
}

JournaledFile::~JournaledFile() {
    // An empty journal says nothing; a full one is the rest of a commit that failed half-way.
    if (journal_ >= 0 && !journal_counts_) ::unlink(journal_path_.c_str());
    close_if_open(journal_);
    close_if_open(file_);
}

void JournaledFile::fail(std::string_view what) {
    failure_ = fmt::format("'{}' {}: {}.", path_.string(), what, system_reason());
    throw FileError(failure_);
}

void JournaledFile::reject_after_failure() const {
    if (!failure_.empty()) throw FileError(failure_);
}

bool JournaledFile::load_journal() {
    std::error_code absent;
    if (!std::filesystem::exists(journal_path_, absent)) return false;
    const std::string bytes = read_regular_file(journal_path_);
    JournalHead head;
    const std::size_t record = sizeof(std::uint64_t) + page_size;
    if (bytes.size() < sizeof head) return false;
    std::memcpy(&head, bytes.data(), sizeof head);
    const std::string_view rest = std::string_view(bytes).substr(sizeof head);
    if (std::memcmp(head.magic, journal_magic, 8) != 0 || head.pages > rest.size() / record ||
        checksum(rest.substr(0, head.pages * record)) != head.checksum)
        return false;  // the kill came while it was written: the file is whole without it
    for (std::size_t k = 0; k < head.pages; ++k) {
        std::uint64_t number;
        std::memcpy(&number, rest.data() + k * record, sizeof number);
        const auto* page =
            reinterpret_cast<const unsigned char*>(rest.data() + k * record + sizeof number);
        waiting_[number].assign(page, page + page_size);
    }
    size_ = head.file_size;
    committed_ = std::max(committed_, size_);
    return true;
}

void JournaledFile::read_from_disk(std::uint64_t offset, void* bytes, std::size_t size) {
    auto* p = static_cast<unsigned char*>(bytes);
    while (size > 0) {
        const ssize_t got = ::pread(file_, p, size, static_cast<off_t>(offset));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) fail("could not be read");
        if (got == 0) {
            std::memset(p, 0, size);
            return;
        }
        p += got;
        offset += static_cast<std::uint64_t>(got);
        size -= static_cast<std::size_t>(got);
    }
}

void JournaledFile::read(std::uint64_t offset, void* bytes, std::size_t size) {
    reject_after_failure();
    read_from_disk(offset, bytes, size);
    if (waiting_.empty() || size == 0) return;
    const std::uint64_t end = offset + size;
    auto* p = static_cast<unsigned char*>(bytes);
    for (auto it = waiting_.lower_bound(offset / page_size);
         it != waiting_.end() && it->first * page_size < end; ++it) {
        const std::uint64_t begin = it->first * page_size;
        const std::uint64_t from = std::max(begin, offset), to = std::min(begin + page_size, end);
        std::memcpy(p + (from - offset), it->second.data() + (from - begin), to - from);
    }
}

void JournaledFile::write_to_disk(std::uint64_t offset, const void* bytes, std::size_t size) {
    if (!write_at(file_, offset, {static_cast<const char*>(bytes), size}))
        fail("could not be written");
#ifdef __linux__
    // The disk may begin: a commit then finds little left to do.
    if ((not_yet_sent_ += size) < 8 * 1024 * 1024) return;
    ::sync_file_range(file_, 0, 0, SYNC_FILE_RANGE_WRITE);
    not_yet_sent_ = 0;
#endif
}

/// Whole pages wait, so the committed size counts as rounded up to a page.
bool JournaledFile::waits(std::uint64_t offset) const {
    return new_ || offset < (committed_ + page_size - 1) / page_size * page_size;
}

void JournaledFile::write(std::uint64_t offset, const void* bytes, std::size_t size) {
    if (abandoned_) return;
    reject_after_failure();
    size_ = std::max(size_, offset + size);
    const auto* p = static_cast<const unsigned char*>(bytes);
    while (size > 0 && waits(offset)) {
        const std::uint64_t number = offset / page_size, begin = number * page_size;
        auto page = waiting_.find(number);
        if (page == waiting_.end()) {
            Page there(page_size);
            read_from_disk(begin, there.data(), page_size);
            page = waiting_.emplace(number, std::move(there)).first;
        }
        const std::size_t part = std::min<std::uint64_t>(size, begin + page_size - offset);
        std::memcpy(page->second.data() + (offset - begin), p, part);
        p += part;
        offset += part;
        size -= part;
    }
    if (size > 0) write_to_disk(offset, p, size);
}

void JournaledFile::resize(std::uint64_t size) {
    if (!abandoned_) size_ = size;
}

void JournaledFile::sync() {
    if (::fdatasync(file_) != 0) fail("could not be brought onto the disk");
}

void JournaledFile::open_journal() {
    if (journal_ >= 0) return;
    journal_ =
        ::open(journal_path_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0666);
    if (journal_ < 0) fail("has a journal that could not be opened");
    // The names of both files have to survive a power cut as well.
    sync_folder_of(path_);
}

void JournaledFile::write_journal() {
    open_journal();
    std::vector<unsigned char> bytes(sizeof(JournalHead));
    for (const auto& [number, page] : waiting_) {
        const auto* n = reinterpret_cast<const unsigned char*>(&number);
        bytes.insert(bytes.end(), n, n + sizeof number);
        bytes.insert(bytes.end(), page.begin(), page.end());
    }
    Checksum sum;
    sum.add(bytes.data() + sizeof(JournalHead), bytes.size() - sizeof(JournalHead));
    JournalHead head{{}, waiting_.size(), size_, sum.value()};
    std::memcpy(head.magic, journal_magic, 8);
    std::memcpy(bytes.data(), &head, sizeof head);
    journal_counts_ = true;
    if (!write_at(journal_, 0, {reinterpret_cast<const char*>(bytes.data()), bytes.size()}))
        fail("could not be written");
    if (::fdatasync(journal_) != 0) fail("has a journal that could not be brought onto the disk");
}

void JournaledFile::empty_journal() {
    if (::ftruncate(journal_, 0) != 0) fail("has a journal that could not be emptied");
    journal_counts_ = false;
}

void JournaledFile::copy_pages() {
    for (const auto& [number, page] : waiting_)
        write_to_disk(number * page_size, page.data(), page_size);
    if (::ftruncate(file_, static_cast<off_t>(size_)) != 0) fail("could not be resized");
}

void JournaledFile::commit() {
    if (abandoned_) return;
    reject_after_failure();
    sync();
    write_journal();
    committed_ = size_;
    copy_pages();
    sync();
    empty_journal();
    waiting_.clear();
    new_ = false;
}

void JournaledFile::rename_to(const std::filesystem::path& path) {
    reject_after_failure();
    // A journal that came back after a power cut must not be that of the next file of this name.
    open_journal();
    if (::fdatasync(journal_) != 0) fail("has a journal that could not be brought onto the disk");
    ::unlink(journal_path_.c_str());
    close_if_open(journal_);
    give_final_name(path_, path);
    // Only now may others have it.
    if (::close(std::exchange(file_, -1)) != 0) fail("could not be closed");
}

void JournaledFile::abandon() {
    if (abandoned_) return;
    abandoned_ = true;
    waiting_.clear();
    // What lies beyond the last commit belongs to nobody, unless a journal says otherwise. A
    // failure here leaves only waste.
    if (journal_counts_ || ::ftruncate(file_, static_cast<off_t>(committed_)) != 0) return;
    size_ = committed_;
}

}  // namespace swirl
