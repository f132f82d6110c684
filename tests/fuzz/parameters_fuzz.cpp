// The parameters in a result (JSON), as `verify` and `--resume` read them. Writing them again must
// give the same text.
#include <nlohmann/json.hpp>

#include "fuzzed_file.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"
#include "swirl/run/parameters.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace swirl;
    read_or_reject<UsageError>([&] {
        const std::string text(reinterpret_cast<const char*>(data), size);
        const RunConfig config = resolve(parameters_in(text));
        const std::string written = config_json(config).dump();
        if (config_json(resolve(parameters_in(written))).dump() != written) __builtin_trap();
    });
    return 0;
}
