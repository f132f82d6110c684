// A table of points: reading, plans, growth and seeds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/scratch.hpp"
#include "swirl/io/file_error.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/study/point_table.hpp"

namespace swirl {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class PointTable : public testing::Test {
  protected:
    std::vector<PointRow> rows(const std::string& text) {
        write_quickly(scratch_ / "t.csv", text);
        return read_points((scratch_ / "t.csv").string(), 1);
    }
    SweepPlan plan(const std::string& text, const ParameterTexts& common = {}) {
        return make_plan(rows(text), common);
    }
    std::string error_of(const std::string& text, const ParameterTexts& common = {}) {
        try {
            plan(text, common);
        } catch (const UsageError& error) {
            return error.what();
        }
        return "";
    }
    static std::vector<std::uint64_t> identities(const SweepPlan& made) {
        std::vector<std::uint64_t> all;
        for (std::size_t row = 0; row < made.rows(); ++row)
            all.push_back(identity_of(resolve(made.parameters_of_row(row))));
        return all;
    }
    Scratch scratch_;
};

TEST_F(PointTable, RowsArePointsWithTheirReplicas) {
    const SweepPlan made =
        plan("# made by hand\nmu-disc, discs,replicates # two kinds\n0.5,30,2\n\n1,40,1\n",
             {{"periods", "50"}});
    EXPECT_EQ(made.rows(), 2u);
    ASSERT_EQ(made.points(), 3u);
    const ParameterTexts first{{"discs", "30"}, {"mu_disc", "0.5"}, {"periods", "50"}},
        second{{"discs", "40"}, {"mu_disc", "1"}, {"periods", "50"}};
    EXPECT_EQ(made.parameters(0), first);
    EXPECT_EQ(made.parameters(1), first);
    EXPECT_EQ(made.parameters(2), second);
    EXPECT_EQ(made.replica(1), 1);
    EXPECT_EQ(made.replica(2), 0);
}

// A point has the same runs in a table and in a product of lists.
TEST_F(PointTable, SeedsAreThoseOfAProduct) {
    const SweepPlan product = make_plan({{"discs", "30,40"}, {"mu", "0.5"}}, 2),
                    table = plan("mu,discs,replicates\n0.5,40,2\n0.5,30,1\n");
    EXPECT_EQ(table.config(0).seed, product.config(2).seed);
    EXPECT_EQ(table.config(1).seed, product.config(3).seed);
    EXPECT_EQ(table.config(2).seed, product.config(0).seed);
}

TEST_F(PointTable, AGivenSeedIsThatOfTheFirstReplicate) {
    const SweepPlan made = plan("discs,seed,replicates\n30,7,3\n30,10,1\n");
    for (std::size_t point = 0; point < 4; ++point) EXPECT_EQ(made.config(point).seed, 7 + point);
    EXPECT_THAT(error_of("discs,seed,replicates\n30,7,3\n30,9,1\n"),
                HasSubstr("line 3: the run is that of '"));
    EXPECT_THAT(error_of("discs,seed,replicates\n30,18446744073709551614,3\n"),
                HasSubstr("below 2^64"));
}

TEST_F(PointTable, GrowthKeepsTheNumbersOfPoints) {
    const SweepPlan before = plan("discs,replicates\n30,1\n31,2\n");
    // Another spelling of a point is that point, and a new column is empty in older rows.
    const SweepPlan after =
        grown(before, rows("discs,mu,replicates\n31.0,1,1\n32,0.5,1\n30,1,3\n"), {}, {});
    ASSERT_EQ(after.points(), 6u);
    for (std::size_t point = 0; point < before.points(); ++point) {
        EXPECT_EQ(after.parameters(point), before.parameters(point));
        EXPECT_EQ(after.config(point).seed, before.config(point).seed);
    }
    EXPECT_THAT(after.row_replicas, ElementsAre(3, 2, 1));
    EXPECT_EQ(after.parameters(5), (ParameterTexts{{"discs", "32"}, {"mu", "0.5"}}));
    write_plan(scratch_.folder(), after);
    EXPECT_EQ(read_plan(scratch_.folder()), after);
    EXPECT_EQ(grown(after, {}, 2, {}).row_replicas, (std::vector<std::int64_t>{3, 2, 2}));
    EXPECT_THAT(points_of_rows(after, rows("discs,replicates\n30,2\n31,9\n33,1\n")),
                ElementsAre(ElementsAre(0, 3), ElementsAre(1, 2), ElementsAre()));
}

TEST_F(PointTable, SpreadsheetsGiveTheSamePoints) {
    const SweepPlan expected = plan("discs,mu,path,replicates\n30,0.5,line,2\n31,1,circle,1\n");
    for (const char* text : {"Discs;MU;Path;Seeds\n30;0,5;line;2\n31;1,0;circle;1\n",
                             "sep=;\r\ndiscs;mu;path;seeds\r\n30;0,5;line;2\r\n31;1;circle;1\r\n",
                             "DISCS\tMu\tpath\tseeds\n30\t0,5\tline\t2\n31\t1\tcircle\t1\n"})
        EXPECT_EQ(identities(plan(text)), identities(expected)) << text;
}

TEST_F(PointTable, InvalidTablesAreRejected) {
    for (const auto& [text, says] : std::initializer_list<std::pair<const char*, const char*>>{
             {"", "has no rows"},
             {"discs\n", "has no rows"},
             {"disks\n30\n", "line 1: there is no parameter 'disks'.\nhint: did you mean 'discs'?"},
             {"replicate,discs\n2,30\n", "did you mean 'replicates'?"},
             {"energy\n30\n", "hint: a column is a parameter"},
             {"discs,\n30,\n", "a column has no name"},
             {"discs,mu,discs\n30,1,30\n", "two columns 'discs'"},
             {"mu-disc,mu_disc\n1,1\n", "two columns 'mu_disc'"},
             {"replicates\n3\n", "no column of a parameter"},
             {"discs,mu\n30,1\n31\n", "line 3: 1 fields, but the first line has 2"},
             {"discs,mu\n30,\n", "line 2: mu is empty"},
             {"discs,mu\n30,nan\n", "line 2: --mu is 'nan'"},
             {"discs,mu\n30,inf\n", "line 2: --mu is 'inf'"},
             {"discs\n5:48\n", "line 2: --discs is '5:48'"},
             {"discs\n30\n900\n", "line 3: 900 discs do not fit"},
             {"discs,mu\n30,1\n31,1\n30,1.0\n", "line 4: the run is that of '"},
             {"discs,replicates\n30,0\n", "replicates is '0'"},
             {"discs,replicates\n30,2.5\n", "replicates is '2.5'"},
             {"discs;mu\n30;0,5\n31;0.5\n", "line 3: column 'mu' is '0.5', but it must be written"},
             {"30,1\n31,1\n", "line 1: 2 columns without a header"},
             {"discs\n30", "no line break"}})
        EXPECT_THAT(error_of(text), HasSubstr(says)) << text;
    EXPECT_THAT(error_of("discs\n30\n", {{"mu", "0.1,1"}}), HasSubstr("--mu is a list"));
    EXPECT_THAT(error_of("discs\n30\n", {{"discs", "30"}}), HasSubstr("omit one of them"));
}

TEST_F(PointTable, DamagedPlansOfTablesAreRejected) {
    const auto error_of_plan = [&](const std::string& text) -> std::string {
        write_quickly(scratch_ / "plan.json", text);
        try {
            read_plan(scratch_.folder());
        } catch (const FileError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(error_of_plan(R"({"format":2,"columns":{"discs":["5"]},"replicates":[2]})"), "");
    for (const char* plan :
         {R"("columns":{"discs":["5"]},"replicates":[])",
          R"("columns":{"discs":["5"]},"replicates":1)",
          R"("columns":{"discs":["5"]},"replicates":[0])",
          R"("columns":{"discs":["5"]},"replicates":[1,1])",
          R"("columns":{"discs":["5","5"]},"replicates":[1,1])",
          R"("columns":{"discs":["5","6"]},"replicates":[2,-1])",
          R"("columns":{},"replicates":[1])", R"("axes":{"discs":["5"]},"replicates":[1])",
          R"("columns":{"discs":["5"]},"replicates":[1],"chain":"mu")",
          R"("columns":{"discs":["5"]},"replicates":[1],"search":true)",
          R"("columns":{"discs":["5"]},"replicates":[1],"before":[{"replicates":[2]}])",
          R"("columns":{"discs":["5"]},"replicates":[1],"before":[{"replicates":[1,1]}])"})
        EXPECT_THAT(error_of_plan(std::string(R"({"format":2,)") + plan + "}"),
                    HasSubstr("is damaged: "))
            << plan;
}

}  // namespace
}  // namespace swirl
