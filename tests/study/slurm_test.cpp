#include "swirl/study/slurm.hpp"

#include <gmock/gmock.h>

#include "swirl/run/failure.hpp"

namespace swirl {
namespace {

using testing::HasSubstr;
using testing::Not;

SlurmJob job(const std::string& time = "", const std::string& partition = "") {
    return {.tasks = 4, .cores = 2, .time = time, .partition = partition};
}

TEST(SlurmScript, QuotesTheFolderAndDoublesItsPercentSigns) {
    const std::string text = slurm_script(job("2:00:00", "day"), "/a b/50 %");
    EXPECT_THAT(text, HasSubstr("#SBATCH --output=\"/a b/50 %%/log/%A_%a.log\"\n"));
    EXPECT_THAT(text, HasSubstr("--out '/a b/50 %' "));
    EXPECT_THAT(text, HasSubstr("#SBATCH --time=2:00:00\n#SBATCH --partition=day\n"));
}

TEST(SlurmScript, PassesFurtherOptionsToSbatch) {
    SlurmJob with = job();
    with.sbatch = {"account=physics", "--mem=4G", "-C", "exclusive"};
    EXPECT_THAT(slurm_script(with, "/a"),
                HasSubstr("#SBATCH --account=physics\n#SBATCH --mem=4G\n#SBATCH -C\n"
                          "#SBATCH --exclusive\n"));
    for (const char* text : {"", "mem=4G\ntouch x", "mem=$(touch x)", "=4G", "mem 4G"}) {
        with.sbatch = {text};
        EXPECT_THROW(slurm_script(with, "/a"), UsageError) << text;
    }
}

// A task of one core must not keep a whole node from others, nor start a run for each of its cores.
TEST(SlurmScript, UsesTheCoresThatSlurmGives) {
    for (const int cores : {0, 2}) {
        SlurmJob with = job();
        with.cores = cores;
        const std::string text = slurm_script(with, "/a");
        EXPECT_THAT(text, Not(HasSubstr("exclusive")));
        EXPECT_EQ(text.find("#SBATCH --cpus-per-task=2\n") != text.npos, cores == 2);
        EXPECT_THAT(text, HasSubstr(" --threads \"$SLURM_CPUS_ON_NODE\"\n"));
    }
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
