#include "swirl/files/staged_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "swirl/files/checksum.hpp"
#include "swirl/files/file_error.hpp"
#include "swirl/files/whole_file.hpp"

namespace swirl {
namespace {

// The journal: this head, then `pages` times a page number and a page.
struct JournalHead {
    char magic[8];
    std::uint64_t pages, file_size, checksum;
};
constexpr char journal_magic[8] = {'s', 'w', 'i', 'r', 'l', 'j', 'n', '1'};

bool write_at(int file, std::uint64_t offset, const void* bytes, std::size_t size) {
    const char* p = static_cast<const char*>(bytes);
    while (size > 0) {
        const ssize_t done = ::pwrite(file, p, size, static_cast<off_t>(offset));
        if (done < 0 && errno == EINTR) continue;
        if (done < 0) return false;
        p += done;
        offset += static_cast<std::uint64_t>(done);
        size -= static_cast<std::size_t>(done);
    }
    return true;
}

}  // namespace

StagedFile::StagedFile(const std::filesystem::path& path, Mode mode)
    : path_(path), journal_path_(path.string() + ".journal") {
    const int how = mode == Mode::read ? O_RDONLY : O_RDWR | (mode == Mode::create ? O_CREAT : 0);
    file_ = ::open(path.c_str(), how | O_CLOEXEC, 0666);
    if (file_ < 0)
        throw FileError(
            fmt::format("'{}' could not be opened: {}.", path.string(), system_reason()));
    if (mode != Mode::read && ::flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
        ::close(file_);
        throw FileError(fmt::format(
            "'{}' is being written by another process; wait for it or choose another name.",
            path.string()));
    }
    if (mode == Mode::create) {
        ::unlink(journal_path_.c_str());
        if (::ftruncate(file_, 0) != 0) {
            const std::string reason = system_reason();
            ::close(file_);
            throw FileError(fmt::format("'{}' could not be emptied: {}.", path.string(), reason));
        }
        return;
    }
    struct stat about;
    if (::fstat(file_, &about) == 0) committed_ = static_cast<std::uint64_t>(about.st_size);
    size_ = committed_;
    if (load_journal() && mode == Mode::change) commit(true);
}

StagedFile::~StagedFile() {
    if (journal_ >= 0) {
        ::close(journal_);
        // An empty journal says nothing; a full one is the rest of a commit that failed half-way.
        std::error_code ignored;
        if (std::filesystem::file_size(journal_path_, ignored) == 0 && !ignored)
            ::unlink(journal_path_.c_str());
    }
    ::close(file_);
}

bool StagedFile::load_journal() {
    std::error_code absent;
    if (!std::filesystem::exists(journal_path_, absent)) return false;
    const std::string bytes = read_whole_file(journal_path_);
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

void StagedFile::read_from_disk(std::uint64_t offset, void* bytes, std::size_t size) const {
    auto* p = static_cast<unsigned char*>(bytes);
    while (size > 0) {
        const ssize_t got = ::pread(file_, p, size, static_cast<off_t>(offset));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0)
            throw FileError(
                fmt::format("'{}' could not be read: {}.", path_.string(), system_reason()));
        if (got == 0) {
            std::memset(p, 0, size);
            return;
        }
        p += got;
        offset += static_cast<std::uint64_t>(got);
        size -= static_cast<std::size_t>(got);
    }
}

void StagedFile::read(std::uint64_t offset, void* bytes, std::size_t size) const {
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

void StagedFile::write_to_disk(std::uint64_t offset, const void* bytes, std::size_t size) {
    if (!write_at(file_, offset, bytes, size))
        throw FileError(
            fmt::format("'{}' could not be written: {}.", path_.string(), system_reason()));
#ifdef __linux__
    // The disk may begin: a flush at the end then finds little left to do.
    if ((not_yet_sent_ += size) < 8 * 1024 * 1024) return;
    ::sync_file_range(file_, 0, 0, SYNC_FILE_RANGE_WRITE);
    not_yet_sent_ = 0;
#endif
}

void StagedFile::write(std::uint64_t offset, const void* bytes, std::size_t size) {
    if (abandoned_) return;
    size_ = std::max(size_, offset + size);
    // Whole pages wait, so the committed size counts as rounded up to a page.
    const std::uint64_t fence = (committed_ + page_size - 1) / page_size * page_size;
    const auto* p = static_cast<const unsigned char*>(bytes);
    while (size > 0 && offset < fence) {
        const std::uint64_t number = offset / page_size, begin = number * page_size;
        auto [it, fresh] = waiting_.try_emplace(number);
        if (fresh) {
            it->second.resize(page_size);
            read_from_disk(begin, it->second.data(), page_size);
        }
        const std::size_t part = std::min<std::uint64_t>(size, begin + page_size - offset);
        std::memcpy(it->second.data() + (offset - begin), p, part);
        p += part;
        offset += part;
        size -= part;
    }
    if (size > 0) write_to_disk(offset, p, size);
}

void StagedFile::resize(std::uint64_t size) {
    if (!abandoned_) size_ = size;
}

void StagedFile::write_journal(bool durable) {
    if (journal_ < 0) journal_ = ::open(journal_path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    std::vector<unsigned char> bytes(sizeof(JournalHead));
    Checksum sum;
    for (const auto& [number, page] : waiting_) {
        const auto* n = reinterpret_cast<const unsigned char*>(&number);
        bytes.insert(bytes.end(), n, n + sizeof number);
        bytes.insert(bytes.end(), page.begin(), page.end());
    }
    sum.add(bytes.data() + sizeof(JournalHead), bytes.size() - sizeof(JournalHead));
    JournalHead head{{}, waiting_.size(), size_, sum.value()};
    std::memcpy(head.magic, journal_magic, 8);
    std::memcpy(bytes.data(), &head, sizeof head);
    const bool written = journal_ >= 0 && write_at(journal_, 0, bytes.data(), bytes.size()) &&
                         (!durable || ::fdatasync(journal_) == 0);
    if (written) return;
    const std::string reason = system_reason();
    if (journal_ >= 0 && ::ftruncate(journal_, 0) != 0) ::unlink(journal_path_.c_str());
    throw FileError(fmt::format("'{}' could not be written: {}.", path_.string(), reason));
}

void StagedFile::copy_pages() {
    for (const auto& [number, page] : waiting_)
        write_to_disk(number * page_size, page.data(), page_size);
    if (::ftruncate(file_, static_cast<off_t>(size_)) != 0)
        throw FileError(
            fmt::format("'{}' could not be resized: {}.", path_.string(), system_reason()));
}

void StagedFile::commit(bool durable) {
    if (abandoned_) return;
    // What the journal's pages will refer to must be there before them.
    if (durable && ::fdatasync(file_) != 0)
        throw FileError(
            fmt::format("'{}' could not be written: {}.", path_.string(), system_reason()));
    write_journal(durable);
    committed_ = size_;  // from here on the commit has happened, if need be when the file is opened
    copy_pages();
    if (durable) ::fdatasync(file_);
    if (::ftruncate(journal_, 0) != 0) ::unlink(journal_path_.c_str());
    waiting_.clear();
}

void StagedFile::abandon() {
    if (abandoned_) return;
    abandoned_ = true;
    waiting_.clear();
    // What lies beyond the last commit belongs to nobody. A failure here leaves only waste.
    if (::ftruncate(file_, static_cast<off_t>(committed_)) != 0) return;
    size_ = committed_;
}

}  // namespace swirl
