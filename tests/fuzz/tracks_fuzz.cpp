// A camera's tracks: trackpy's CSV.
#include "fuzzed_file.hpp"
#include "swirl/io/file_error.hpp"
#include "swirl/io/tracks.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace swirl;
    const FuzzedFile file(data, size);
    read_or_reject<FileError>([&] { read_track_table(file.path()); });
    return 0;
}
