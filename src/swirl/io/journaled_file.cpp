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
#include "swirl/io/optional_file.hpp"
#include "swirl/io/system_calls.hpp"

namespace swirl {
namespace {

// The journal consists of this head and then, `pages` times, a page number and a page.
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
    const int flags = mode == Mode::read     ? O_RDONLY | O_NONBLOCK
                      : mode == Mode::change ? O_RDWR | O_NOFOLLOW | O_NONBLOCK
                                             : O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CREAT;
    file_ = ::open(path_.c_str(), flags | O_CLOEXEC, 0666);
    if (file_ < 0) fail("could not be opened");
    struct stat about;
    if (::fstat(file_, &about) != 0) fail("could not be opened");
    if (!S_ISREG(about.st_mode)) throw_not_regular(path_);
    if (mode != Mode::read && ::flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
        throw FileError(fmt::format(
            "'{}' is being written by another process.\nhint: wait for it or choose another name.",
            path_.string()));
    // Between open() and flock(), the process that had the lock may have published the file.
    struct stat named;
    if (mode != Mode::read && (::stat(path_.c_str(), &named) != 0 || named.st_ino != about.st_ino))
        throw FileError(
            fmt::format("'{}' was just completed or removed by another process.\nhint: try again.",
                        path_.string()));
    if (mode == Mode::create) return start_empty();
    committed_ = size_ = static_cast<std::uint64_t>(about.st_size);
    is_new_ = size_ == 0;
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

void JournaledFile::start_empty() {
    is_new_ = true;
    // An older journal must not be applied to the new file, also not after a power cut.
    if (file_exists(journal_path_)) {
        open_journal();
        empty_journal();
        if (!system::sync_file_data(journal_)) fail("could not be emptied");
    }
    if (::ftruncate(file_, 0) != 0) fail("could not be emptied");
}

JournaledFile::~JournaledFile() {
    // A journal that is still needed belongs to a commit that failed in step 3.
    if (journal_ >= 0 && !journal_is_needed_) ::unlink(journal_path_.c_str());
    close_if_open(journal_);
    close_if_open(file_);
}

void JournaledFile::fail(std::string_view problem) {
    failure_ = fmt::format("'{}' {}: {}.", path_.string(), problem, system_reason());
    throw FileError(failure_);
}

void JournaledFile::reject_after_failure() const {
    if (!failure_.empty()) throw FileError(failure_);
}

bool JournaledFile::load_journal() {
    const std::optional<std::string> journal = read_optional_file(journal_path_);
    if (!journal) return false;
    const std::string_view bytes = *journal;
    JournalHead head;
    const std::size_t record = sizeof(std::uint64_t) + page_size;
    if (bytes.size() < sizeof head) return false;
    std::memcpy(&head, bytes.data(), sizeof head);
    const std::string_view records = bytes.substr(sizeof head);
    if (std::memcmp(head.magic, journal_magic, 8) != 0 || head.pages > records.size() / record ||
        checksum(records.substr(0, head.pages * record)) != head.checksum)
        return false;  // stopped in step 2: the file is in the state of the last commit
    for (std::size_t k = 0; k < head.pages; ++k) {
        std::uint64_t number;
        std::memcpy(&number, records.data() + k * record, sizeof number);
        const auto* page =
            reinterpret_cast<const unsigned char*>(records.data() + k * record + sizeof number);
        pending_[number].assign(page, page + page_size);
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
    if (pending_.empty() || size == 0) return;
    const std::uint64_t end = offset + size;
    auto* p = static_cast<unsigned char*>(bytes);
    for (auto it = pending_.lower_bound(offset / page_size);
         it != pending_.end() && it->first * page_size < end; ++it) {
        const std::uint64_t begin = it->first * page_size;
        const std::uint64_t from = std::max(begin, offset), to = std::min(begin + page_size, end);
        std::memcpy(p + (from - offset), it->second.data() + (from - begin), to - from);
    }
}

void JournaledFile::write_to_disk(std::uint64_t offset, const void* bytes, std::size_t size) {
    if (!write_at(file_, offset, {static_cast<const char*>(bytes), size}))
        fail("could not be written");
    // Starts writing to the disk early, so that a commit has little left to write.
    constexpr std::uint64_t writeback_size = 8 * 1024 * 1024;
    if ((bytes_since_writeback_ += size) < writeback_size) return;
    system::start_writeback(file_);
    bytes_since_writeback_ = 0;
}

/// Pending pages are whole pages, so the committed size is rounded up to a page.
bool JournaledFile::must_be_journaled(std::uint64_t offset) const {
    return is_new_ || offset < (committed_ + page_size - 1) / page_size * page_size;
}

void JournaledFile::write(std::uint64_t offset, const void* bytes, std::size_t size) {
    if (is_abandoned_) return;
    reject_after_failure();
    size_ = std::max(size_, offset + size);
    const auto* p = static_cast<const unsigned char*>(bytes);
    while (size > 0 && must_be_journaled(offset)) {
        const std::uint64_t number = offset / page_size, begin = number * page_size;
        auto page = pending_.find(number);
        if (page == pending_.end()) {
            Page on_disk(page_size);
            read_from_disk(begin, on_disk.data(), page_size);
            page = pending_.emplace(number, std::move(on_disk)).first;
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
    if (!is_abandoned_) size_ = size;
}

void JournaledFile::sync() {
    if (!system::sync_file_data(file_)) fail("could not be synced to the disk");
}

void JournaledFile::open_journal() {
    if (journal_ >= 0) return;
    journal_ =
        ::open(journal_path_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0666);
    if (journal_ < 0) fail("has a journal that could not be opened");
    // The names of both files must survive a power cut, too.
    sync_folder_of(path_);
}

void JournaledFile::write_journal() {
    open_journal();
    std::vector<unsigned char> bytes(sizeof(JournalHead));
    for (const auto& [number, page] : pending_) {
        const auto* n = reinterpret_cast<const unsigned char*>(&number);
        bytes.insert(bytes.end(), n, n + sizeof number);
        bytes.insert(bytes.end(), page.begin(), page.end());
    }
    Checksum sum;
    sum.add(bytes.data() + sizeof(JournalHead), bytes.size() - sizeof(JournalHead));
    JournalHead head{{}, pending_.size(), size_, sum.value()};
    std::memcpy(head.magic, journal_magic, 8);
    std::memcpy(bytes.data(), &head, sizeof head);
    journal_is_needed_ = true;
    if (!write_at(journal_, 0, {reinterpret_cast<const char*>(bytes.data()), bytes.size()}))
        fail("could not be written");
    if (!system::sync_file_data(journal_))
        fail("has a journal that could not be synced to the disk");
}

void JournaledFile::empty_journal() {
    if (::ftruncate(journal_, 0) != 0) fail("has a journal that could not be emptied");
    journal_is_needed_ = false;
}

void JournaledFile::copy_pages() {
    for (const auto& [number, page] : pending_)
        write_to_disk(number * page_size, page.data(), page_size);
    if (::ftruncate(file_, static_cast<off_t>(size_)) != 0) fail("could not be resized");
}

void JournaledFile::commit() {
    if (is_abandoned_) return;
    reject_after_failure();
    sync();
    write_journal();
    committed_ = size_;
    copy_pages();
    sync();
    empty_journal();
    pending_.clear();
    is_new_ = false;
}

void JournaledFile::publish(const std::filesystem::path& path) {
    reject_after_failure();
    // A journal that reappears after a power cut must not be applied to the next file of this name,
    // so its emptying is synced before it is removed.
    open_journal();
    if (!system::sync_file_data(journal_))
        fail("has a journal that could not be synced to the disk");
    ::unlink(journal_path_.c_str());
    close_if_open(journal_);
    rename_durably(path_, path);
    // Closing releases the lock.
    if (::close(std::exchange(file_, -1)) != 0) fail("could not be closed");
}

void JournaledFile::abandon() {
    if (is_abandoned_) return;
    is_abandoned_ = true;
    pending_.clear();
    // Nothing refers to bytes beyond the last commit, unless the journal is needed. An error here
    // leaves only unused bytes.
    if (journal_is_needed_ || ::ftruncate(file_, static_cast<off_t>(committed_)) != 0) return;
    size_ = committed_;
}

}  // namespace swirl
