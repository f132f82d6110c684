// A configuration file, and the parameters in it.
#include "fuzzed_file.hpp"
#include "swirl/io/file_error.hpp"
#include "swirl/io/toml_file.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/parameters.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace swirl;
    read_or_reject<FileError, UsageError>([&] {
        const Config config =
            parse_config(std::string(reinterpret_cast<const char*>(data), size), "fuzzed.toml");
        ParameterTexts texts;
        for (const auto& [name, entry] : config.entries)
            if (!entry.values.empty()) texts[name] = entry.values.front();
        resolve(texts);
    });
    return 0;
}
