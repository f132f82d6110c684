#include "swirl/io/table.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace swirl {
namespace {

TEST(Table, CsvKeepsAllDigitsAndQuotesText) {
    Table table({"name", "count", "value"});
    table.add({std::string("plain"), std::int64_t{3}, 0.1});
    table.add({std::string("with \"quotes\", and a comma"), std::int64_t{-1},
               std::numeric_limits<double>::quiet_NaN()});
    table.add({std::string(""), std::int64_t{0}, 1.0 / 3.0});
    EXPECT_EQ(table.csv(),
              "name,count,value\n"
              "plain,3,0.1\n"
              "\"with \"\"quotes\"\", and a comma\",-1,\n"
              ",0,0.3333333333333333\n");
}

TEST(Table, RowOfAnotherLengthIsRejected) {
    Table table({"a", "b"});
    EXPECT_THROW(table.add({1.0}), std::logic_error);
}

}  // namespace
}  // namespace swirl
