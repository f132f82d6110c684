// Writes many small files atomically without one disk sync for each. Files that arrive within a
// fraction of a second are written to temporary files, synced together and then renamed. This
// happens on a separate thread, so the computing threads do not wait.
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
    /// All files are written to this folder.
    explicit ResultWriter(const std::filesystem::path& folder);
    ~ResultWriter();  // writes the queued files but does not report errors; see finish()
    ResultWriter(const ResultWriter&) = delete;
    ResultWriter& operator=(const ResultWriter&) = delete;

    /// Queues a file. Calls `written` on the writer's thread after the file was published. Throws
    /// FileError if an earlier file could not be written.
    void write(std::string name, std::string bytes, std::function<void()> written);
    /// Waits until all files are written. Throws FileError.
    void finish();

  private:
    struct Item {
        std::string name, bytes;
        std::function<void()> written;
    };
    void work();
    void write_batch(std::span<Item> items);

    std::filesystem::path folder_;
    std::vector<Item> queue_;
    std::exception_ptr failure_;
    bool closing_ = false;
    std::mutex mutex_;
    std::condition_variable wake_;
    std::thread thread_;
};

}  // namespace swirl
