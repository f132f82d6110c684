// Suggestions for names that do not exist, and the options that have another name than their key.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include "swirl/run/names.hpp"
#include "swirl/run/parameters.hpp"

namespace swirl {
namespace {

const std::vector<std::string> options = {"--discs", "--mu",         "--mu-wall", "--frictionless",
                                          "--json",  "--trajectory", "--threads"};

std::string suggested(std::string_view unknown) {
    return nearest_name(unknown, options).value_or("");
}

TEST(NearestName, CorrectsOneOrTwoCharacters) {
    EXPECT_EQ(suggested("--disks"), "--discs");
    EXPECT_EQ(suggested("--disc"), "--discs");
    EXPECT_EQ(suggested("--dicss"), "--discs");
    EXPECT_EQ(suggested("--tarjectroy"), "--trajectory");
    EXPECT_EQ(nearest_name("rnu", {"map", "run"}), "run");
    EXPECT_EQ(nearest_name("fone", {"phone"}), "phone");
}

TEST(NearestName, CompletesAWordThatOnlyOneNameBeginsWith) {
    EXPECT_EQ(suggested("--traj"), "--trajectory");
    EXPECT_EQ(nearest_name("dens", {"density", "flow"}), "density");
    EXPECT_EQ(suggested("--m"), "");
    EXPECT_EQ(suggested("--"), "");
}

// A name that differs in half of its characters is another word.
TEST(NearestName, IsNoneForOtherShortWords) {
    EXPECT_EQ(nearest_name("--out", {"--mu", "--to", "--at"}), std::nullopt);
    EXPECT_EQ(nearest_name("--nu", {"--mu"}), std::nullopt);
    EXPECT_EQ(suggested("--frobnicate"), "");
}

TEST(NearestName, FindsTheNameOfEqualMeaning) {
    EXPECT_EQ(suggested("--out"), "--json");
    EXPECT_EQ(suggested("--output"), "--json");
    EXPECT_EQ(suggested("-o"), "--json");
    EXPECT_EQ(nearest_name("--output", {"--json", "--out"}), "--out");
    EXPECT_EQ(suggested("--friction"), "--mu");
    EXPECT_EQ(nearest_name("particles", {"discs", "mu"}), "discs");
    EXPECT_EQ(suggested("--cores"), "--threads");
}

TEST(NearestName, FindsTheNewNameOfAnOldOneInEachCommand) {
    EXPECT_EQ(nearest_name("--frames", {"--frame-interval", "--frames-per-period"}),
              "--frames-per-period");
    EXPECT_EQ(nearest_name("--frames", {"--view", "--frame-files"}), "--frame-files");
    EXPECT_EQ(nearest_name("--frames", {"--fps", "--max-frames"}), "--max-frames");
    EXPECT_EQ(nearest_name("frames", {"view", "frame_files"}), "frame_files");
    EXPECT_EQ(nearest_name("--path", {"--mu", "--motion"}), "--motion");
    EXPECT_EQ(nearest_name("--path", {"--out", "--motion-out"}), "--motion-out");
    EXPECT_EQ(nearest_name("--seeds", {"--seed", "--replicates"}), "--replicates");
    EXPECT_EQ(nearest_name("--seeds", {"--seed", "--events"}), "--seed");
    EXPECT_EQ(nearest_name("--of", {"--x", "--quantity"}), "--quantity");
    EXPECT_EQ(nearest_name("by_time", {"mean_by_time", "rigid_by_time"}), "mean_by_time");
}

// Files may have the former names of options. Other words are suggestions only.
TEST(PresentName, IsTheOptionOfAFormerOne) {
    EXPECT_EQ(present_name("frames", {"frame_interval", "frames_per_period"}), "frames_per_period");
    EXPECT_EQ(present_name("path", {"mu", "motion"}), "motion");
    EXPECT_EQ(present_name("path-phase", {"mu", "start_angle"}), "start_angle");
    EXPECT_EQ(present_name("start-angle", {"mu", "start_angle"}), "start_angle");
    EXPECT_EQ(present_name("frame", {"view", "frame"}), "frame");
    EXPECT_EQ(present_name("colour", {"color"}), "color");
    EXPECT_EQ(present_name("output", {"out"}), std::nullopt);
    EXPECT_EQ(present_name("length", {"periods"}), std::nullopt);
}

TEST(OptionName, IsNotTheKeyForTheMotionOfTheContainer) {
    EXPECT_EQ(option_name("mu_disc"), "--mu-disc");
    EXPECT_EQ(option_name("path"), "--motion");
    EXPECT_EQ(option_name("path_phase"), "--start-angle");
    EXPECT_EQ(plain_name("start-angle"), "path_phase");
    EXPECT_EQ(user_name("path"), "motion");
}

// The page and the tests of the program read this copy.
TEST(OptionName, TheCopyOfThePageIsUpToDate) {
    std::string rows;
    for (const Parameter& p : run_parameters) {
        if (const std::string option = user_name(p.name); option != p.name)
            rows += fmt::format("{}\"{}\": \"{}\"", rows.empty() ? "" : ", ", p.name, option);
    }
    const std::string wanted = "{" + rows + "}\n";
    const std::string file = std::string(SWIRL_SOURCE_DIR) + "/web/src/texts/option_of_key.json";
    if (std::getenv("SWIRL_WRITE_DOCS")) {
        std::ofstream(file) << wanted;
        return;
    }
    std::ostringstream there;
    there << std::ifstream(file).rdbuf();
    EXPECT_EQ(there.str(), wanted)
        << "This command writes the file: SWIRL_WRITE_DOCS=1 build/tests/tests/test_run "
           "--gtest_filter='OptionName.*'";
}

}  // namespace
}  // namespace swirl
