#include "swirl/run/programs.hpp"

#include <sys/stat.h>

#include "swirl/io/system_calls.hpp"

namespace swirl {
namespace {

namespace fs = std::filesystem;

constexpr const char* from_bin_to_commands = "../libexec/swirl/swirl-commands";
constexpr const char* from_commands_to_bin = "../../bin/swirl";

bool is_program(const fs::path& file) {
    std::error_code ignored;
    return fs::is_regular_file(file, ignored);
}

}  // namespace

bool is_trusted(const fs::path& file, const fs::path& program) {
    struct stat of_file {
    }, of_program{};
    return stat(file.c_str(), &of_file) == 0 && stat(program.c_str(), &of_program) == 0 &&
           (of_file.st_uid == 0 || of_file.st_uid == of_program.st_uid);
}

fs::path program_of_command(const std::string& command) {
    const fs::path self = system::program_file();
    for (const std::string& where : {"swirl-" + command, std::string(from_bin_to_commands)})
        if (const fs::path program = (self.parent_path() / where).lexically_normal();
            is_program(program) && is_trusted(program, self))
            return program;
    return {};
}

fs::path main_program() {
    const fs::path self = system::program_file();
    for (const char* const where : {"swirl", from_commands_to_bin})
        if (const fs::path program = (self.parent_path() / where).lexically_normal();
            is_program(program))
            return program;
    return self;
}

}  // namespace swirl
