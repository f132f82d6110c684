#include "swirl/study/slurm.hpp"

#include <gmock/gmock.h>

#include "swirl/run/failure.hpp"

namespace swirl {
namespace {

using testing::HasSubstr;

SlurmJob job(const std::string& time = "", const std::string& partition = "") {
    return {.nodes = 4, .cpus = 2, .time = time, .partition = partition};
}

TEST(SlurmScript, QuotesTheFolderAndDoublesItsPercentSigns) {
    const std::string text = slurm_script(job("2:00:00", "day"), "/a b/50 %");
    EXPECT_THAT(text, HasSubstr("#SBATCH --output=\"/a b/50 %%/log/%A_%a.log\"\n"));
    EXPECT_THAT(text, HasSubstr("--out '/a b/50 %' "));
    EXPECT_THAT(text, HasSubstr("#SBATCH --time=2:00:00\n#SBATCH --partition=day\n"));
}

TEST(SlurmScript, LineBreaksInOptionsAreRejected) {
    EXPECT_THROW(slurm_script(job("1:00\ntouch x"), "/a"), UsageError);
    EXPECT_THROW(slurm_script(job("", "day\ntouch x"), "/a"), UsageError);
    EXPECT_THROW(slurm_script(job("1:00 # "), "/a"), UsageError);
    EXPECT_THROW(slurm_script(job(), "/a\ntouch x"), UsageError);
    EXPECT_THROW(slurm_script(job(), "/a\"b"), UsageError);
}

}  // namespace
}  // namespace swirl
