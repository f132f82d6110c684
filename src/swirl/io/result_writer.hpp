// Many small files, each there whole or not at all, without waiting for the disk each time: what
// came in within a fraction of a second is written aside, brought onto the disk in one go, and then
// renamed. A thread of its own does that, so those who compute do not wait.
#pragma once

#include <condition_variable>
#include <exception>
#include <filesystem>
#include <functional>
#include <mutex>
#include <span>
#include <string>
#include <thread>
#include <vector>

namespace swirl {

class ResultWriter {
  public:
    /// All files go into this folder.
    explicit ResultWriter(const std::filesystem::path& folder);
    ~ResultWriter();  // writes what is left; see finish()
    ResultWriter(const ResultWriter&) = delete;
    ResultWriter& operator=(const ResultWriter&) = delete;

    /// `written` is called, on the writer's thread, when the file stands under its name. Throws
    /// FileError if an earlier file could not be written.
    void write(std::string name, std::string bytes, std::function<void()> written);
    /// Waits until all is written. Throws FileError.
    void finish();

  private:
    struct Item {
        std::string name, bytes;
        std::function<void()> written;
    };
    void work();
    void write_together(std::span<Item> items);

    std::filesystem::path folder_;
    std::vector<Item> waiting_;
    std::exception_ptr failure_;
    bool closing_ = false;
    std::mutex mutex_;
    std::condition_variable wake_;
    std::thread thread_;
};

}  // namespace swirl
