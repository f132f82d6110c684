#include "swirl/run/recorded_run.hpp"

#include <gtest/gtest.h>

#include <string>

#include "io/scratch.hpp"
#include "swirl/io/checkpoint.hpp"
#include "swirl/io/file_error.hpp"

namespace swirl {
namespace {

// The state of a program in which discs move otherwise leads nowhere here.
TEST(RecordedRun, ACheckpointOfAnotherLawIsRejectedAndOneWithoutANumberIsOfTheFirst) {
    const Scratch scratch;
    RunConfig config;
    config.discs = 5;
    config.periods = 8;
    config.warmup = 2;
    RunFiles files;
    files.checkpoint = scratch / "run.checkpoint";
    files.keep_checkpoint = files.resume = true;
    const RunResult whole = run_recorded(config, files, {}, {});
    const Checkpoint saved = read_checkpoint(files.checkpoint);
    const std::string entry = R"("law":1,)";
    const std::size_t at = saved.about.find(entry);
    ASSERT_NE(at, std::string::npos) << saved.about;
    const auto with_law = [&](const std::string& law) {
        std::string about = saved.about;
        about.replace(at, entry.size(), law);
        write_checkpoint(files.checkpoint, {about, saved.state});
    };
    with_law("");
    EXPECT_EQ(run_recorded(config, files, {}, {}).state_hash, whole.state_hash);
    with_law(R"("law":2,)");
    try {
        run_recorded(config, files, {}, {});
        FAIL() << "a checkpoint of another law was resumed";
    } catch (const FileError& error) {
        EXPECT_NE(std::string(error.what()).find("another law of motion (2 there, 1 here)"),
                  std::string::npos)
            << error.what();
    }
}

}  // namespace
}  // namespace swirl
