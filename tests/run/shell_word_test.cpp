// Words of printed commands are read back by a shell.
#include "swirl/run/shell_word.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <string>

namespace swirl {
namespace {

/// The output of `printf '[%s]' COMMAND` in /bin/sh.
std::string as_shell_reads(const std::string& command) {
    FILE* const shell = popen(("printf '[%s]' " + command).c_str(), "r");
    std::string text;
    for (int c = std::fgetc(shell); c != EOF; c = std::fgetc(shell)) text += static_cast<char>(c);
    EXPECT_EQ(pclose(shell), 0) << command;
    return text;
}

TEST(ShellWord, IsReadBackByAShell) {
    for (const std::string word : {"",
                                   "48",
                                   "plain/name-1_2.csv",
                                   "a b",
                                   "it's",
                                   "''",
                                   "\"",
                                   "$HOME",
                                   "`id`",
                                   "$(id)",
                                   "a\nb",
                                   "a;touch x #",
                                   "*",
                                   "~",
                                   "!x",
                                   "back\\slash",
                                   "tab\t",
                                   "--out",
                                   "{a,b}",
                                   "ümlaut",
                                   "\x1b[2J"})
        EXPECT_EQ(as_shell_reads(shell_word(word)), '[' + word + ']');
}

TEST(ShellWord, HasQuotesOnlyWhereNeeded) {
    EXPECT_EQ(shell_word("plain/name-1_2.csv"), "plain/name-1_2.csv");
    EXPECT_EQ(shell_word("20:0.6"), "20:0.6");
    EXPECT_EQ(shell_word("--out=a,b"), "--out=a,b");
}

}  // namespace
}  // namespace swirl
