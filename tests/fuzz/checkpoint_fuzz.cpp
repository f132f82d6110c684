// A checkpoint from outside: first line, lengths, checksum.
#include "fuzzed_file.hpp"
#include "swirl/files/checkpoint.hpp"
#include "swirl/files/file_error.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace swirl;
    const FuzzedFile file(data, size);
    read_or_refuse<FileError>([&] { read_checkpoint(file.path()); });
    return 0;
}
