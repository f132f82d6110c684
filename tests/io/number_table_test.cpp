#include "swirl/io/number_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "swirl/io/file_error.hpp"

namespace swirl {
namespace {

using Rows = std::vector<std::vector<double>>;

/// The columns `names` of a table that needs a header.
Rows rows_in(const std::string& text, const std::vector<std::string_view>& names) {
    TextLines lines("'a.csv'", text);
    NumberTable table(lines);
    std::vector<std::size_t> columns;
    for (const std::string_view name : names) columns.push_back(table.column({name}));
    Rows rows;
    while (table.next()) {
        rows.emplace_back();
        for (const std::size_t column : columns) rows.back().push_back(table.number(column));
    }
    return rows;
}

/// The radii of a table that may lack a header.
std::vector<double> radii_in(const std::string& text) {
    TextLines lines("'a.csv'", text);
    NumberTable table(lines, NumberTable::Header::optional);
    const std::size_t radius = table.column({"radius", "r"});
    std::vector<double> radii;
    while (table.next()) radii.push_back(table.number(radius));
    return radii;
}

template <class Read>
void expect_error(const Read& read, const std::string& says) {
    try {
        read();
        ADD_FAILURE() << "accepted, but should say " << says;
    } catch (const FileError& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr(says));
    }
}

const Rows expected{{0.5, 1.0}, {-2.0, 1892.0}};

TEST(NumberTable, EverySeparatorGivesTheSameNumbers) {
    for (const char* text :
         {"x,y\n0.5,1\n-2,1892\n", "x;y\n0.5;1\n-2;1892\n", "x\ty\n0.5\t1\n-2\t1892\n",
          "x y\n0.5  1\n-2\t1892\n", " x , y\r\n 0.5, 1\r\n\r\n -2, 1892 \r\n",
          "# origin, of the file\nx,y # names\n0.5,1\n-2,1892\n",
          "\xef\xbb\xbfx,y\n0.5,1\n-2,1892\n", "note,y,x\n\"a, \"\"b\"\" #\",1,0.5\n,1892,-2\n",
          "\"x\"; \"y\"\n\"0.5\";1\n-2;\"1892\" \n"})
        EXPECT_EQ(rows_in(text, {"x", "y"}), expected) << text;
    EXPECT_EQ(rows_in("Y,X\n1,0.5\n1892,-2\n", {"x", "y"}), expected);
}

TEST(NumberTable, ALineNamesTheSeparator) {
    for (const char* text :
         {"sep=;\nx;y\n0.5;1\n-2;1892\n", "\xef\xbb\xbfSEP=;\r\nx;y\r\n0,5;1\r\n-2;1892\r\n",
          "# a note\nsep=,\nx,y\n0.5,1\n-2,1892\n", "sep=\t\nx\ty\n0,5\t1\n-2\t1892\n",
          "\"sep=;\"\nx;y\n0.5;1\n-2;1892\n"})
        EXPECT_EQ(rows_in(text, {"x", "y"}), expected) << text;
    expect_error(
        [] {
            rows_in("sep=|\nx|y\n0|1\n", {"x", "y"});
        },
        "line 1: the separator is '|', but it must be ; or , or a tab");
}

TEST(NumberTable, OnlyOneColumnNeedsNoHeader) {
    const std::vector<double> radii{1.0, 0.5};
    for (const char* text : {"1\n0.5\n", "r\n1\n0.5\n", "Radius;note\n1;a\n0,5;b\n",
                             "sep=;\n1\n0,5\n", "sep=;\nradius\n1,0\n0,5\n"})
        EXPECT_EQ(radii_in(text), radii) << text;
    // 1,2 might be the decimal number 1.2, and 1 and 2.
    expect_error(
        [] { radii_in("1,2\n1,1\n1,3\n"); },
        "line 1: 2 columns without a header.\nhint: name the columns in the first line. If "
        "these are decimal commas, begin the file with the line sep=;");
    expect_error([] { radii_in("radius\n1,2\n"); },
                 "line 2: column 'radius' is '1,2', but it must be a finite number.\nhint: with "
                 "decimal commas, begin the file with the line sep=;");
    for (const char* text : {"1 2\n", "1;2\n", "1\t2\n", "1,2\n", "1,2;1,7\n", "0,1,0\n1,0,1\n"}) {
        expect_error([&] { radii_in(text); }, "columns without a header");
        expect_error([&] { rows_in(text, {"x", "y"}); }, "columns without a header");
    }
    expect_error([] { rows_in("1\n2\n", {"x"}); }, "line 1: 1 column without a header");
}

TEST(NumberTable, ACellThatMayBeANumberHasADecimalPoint) {
    const std::string text = "mu;path\n0,5;circle\n1;a,b.csv\n0.5;line\n";
    TextLines lines("'a.csv'", text);
    NumberTable table(lines);
    ASSERT_TRUE(table.next());
    EXPECT_EQ(table.text(0), "0.5");
    EXPECT_EQ(table.text(1), "circle");
    ASSERT_TRUE(table.next());
    EXPECT_EQ(table.text(1), "a,b.csv");
    ASSERT_TRUE(table.next());
    expect_error([&] { table.text(0); },
                 "line 4: column 'mu' is '0.5', but it must be written with");
}

TEST(NumberTable, ACellOfAListIsNoDecimalNumber) {
    const std::string text = "mu,measure\n\"0,5\",\"slip,rotation\"\n";
    TextLines lines("'a.csv'", text);
    NumberTable table(lines);
    ASSERT_TRUE(table.next());
    EXPECT_EQ(table.text(1), "slip,rotation");
    expect_error(
        [&] { table.text(0); },
        "line 2: column 'mu' is '0,5', but it must be a number with a decimal point.\nhint: "
        "with decimal commas, separate the columns by semicolons");
}

TEST(NumberTable, DecimalCommasNeedSemicolonsOrTabs) {
    for (const char* text : {"x;y\n0,5;1,0\n-2,0;1892\n", "x\ty\n0,5\t1\n-2\t1892,0\n",
                             "\xef\xbb\xbfx;y\r\n0,5;1\r\n-2;1,892e3\r\n"})
        EXPECT_EQ(rows_in(text, {"x", "y"}), expected) << text;
    const auto reads = [](const char* text) { return [text] { rows_in(text, {"x", "y"}); }; };
    expect_error(reads("x,y\n\"0,5\",1\n"), "line 2: column 'x' is '0,5', but it must be a finite");
    expect_error(reads("x y\n1 0,5\n"), "hint: with decimal commas, separate the columns by semi");
    for (const char* cell : {"1.234,5", "1,234.5", "1,2,3", ",5", "5,", "-,5"})
        expect_error(
            [cell] {
                rows_in(std::string("x;y\n0;") + cell + "\n", {"x", "y"});
            },
            std::string("line 2: column 'y' is '") + cell + "'");
    // With decimal commas, 1.500 is probably fifteen hundred.
    expect_error(reads("x;y\n0,5;1\n1.500;1\n"),
                 "line 3: column 'x' is '1.500', but it must be written with ','");
    expect_error(reads("x;y\n0.5;1\n1,500;1\n"), "line 3: column 'x' is '1,500'");
}

TEST(NumberTable, EveryRowHasTheFieldsOfTheFirstLine) {
    for (const char* text :
         {"x,y\n0,1,9\n", "x,y\n0\n", "x;y\n0;1;\n", "x y\n0 1 9\n", "x,y\n0;1\n", "x;y\n0,1\n"})
        expect_error([text] { rows_in(text, {"x", "y"}); }, "'a.csv', line 2: ");
    expect_error(
        [] {
            rows_in("x,y\n0,1\n\n0,1,9\n", {"x", "y"});
        },
        "line 4: 3 fields, but the first line has 2");
    expect_error(
        [] {
            rows_in("x,y\n0,5,1,5\n", {"x", "y"});
        },
        "4 fields, but the first line has 2.\nhint: with decimal commas, separate the columns by");
}

TEST(NumberTable, NoColumnAppearsTwice) {
    expect_error(
        [] {
            rows_in("x,y,x\n0,1,7\n", {"x", "y"});
        },
        "line 1: there are two columns 'x'");
    expect_error([] { rows_in("x,y,note,note\n0,1,7,7\n", {"x", "y"}); }, "two columns 'note'");
    expect_error(
        [] {
            rows_in("x,y,X\n0,1,7\n", {"x", "y"});
        },
        "the columns 'x' and 'X' have the same meaning");
    const std::string text = "t,x,time\n0,1,0\n";
    TextLines lines("'a.csv'", text);
    expect_error(
        [&] {
            NumberTable(lines).find({"t", "time"});
        },
        "the columns 't' and 'time' have the same meaning");
    EXPECT_EQ(rows_in("x,y,,\n0.5,1,,\n-2,1892,,\n", {"x", "y"}), expected);
}

TEST(NumberTable, DamagedTextsAreRejected) {
    const auto reads = [](std::string text) { return [text] { rows_in(text, {"x", "y"}); }; };
    expect_error(reads(""), "'a.csv' has no rows");
    expect_error(reads("# x,y\n"), "'a.csv' has no rows");
    expect_error(reads("x,z\n0,1\n"), "line 1: there is no column 'y'");
    expect_error(reads("x,y\n0,1"), "line 2: the last line has no line break");
    expect_error(reads("x,y\n\"0,1\n"), "line 2: a quotation mark is not closed");
    expect_error(reads("x,y\n\"0\"5,1\n"), "line 2: a field continues after its quotation mark");
    expect_error(reads("x,y\r0,1\r"), "line 1");
    for (const std::string& text :
         {std::string("\xff\xfex\0,\0y\0\n\0", 10), std::string("\xfe\xff\0x\0,\0y\0\n", 10),
          std::string("x\0,\0y\0\n\0", 8), std::string("\0x\0,\0y\0\n", 8)})
        expect_error(reads(text), "text in UTF-16");
    for (const char* cell : {"", "nan", "inf", "1e999", "0x1", "+1", "1 2", "one"})
        expect_error(reads(std::string("x,y\n0,") + cell + "\n"),
                     std::string("line 2: column 'y' is '") + cell + "'");
}

}  // namespace
}  // namespace swirl
