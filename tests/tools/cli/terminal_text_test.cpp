// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/cli/terminal_text.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <string>

namespace terracut::cli {
namespace {

TEST(TextForATerminal, IsLeftAsItIsWhereItIsText) {
  const std::string text = "März/東京 🚗 'a b' -> 50 %\nsecond line";
  EXPECT_EQ(for_terminal(text), text);
  EXPECT_EQ(line_for_terminal("a\nb"), "a?b");
}

TEST(TextForATerminal, HasNoControlCharactersAndNothingThatIsNoUtf8) {
  EXPECT_EQ(for_terminal("a\x1b[2J\x07\r\t\x7f"), "a?[2J????");
  EXPECT_EQ(for_terminal("\xc2\x9b"
                         "2J"),
            "??2J")
      << "a C1 control sequence";
  EXPECT_EQ(for_terminal("M\xe4rz"), "M?rz") << "Latin-1";
  EXPECT_EQ(for_terminal("\xc0\x9b\xe0\x82\x9b\xed\xa0\x80\xf5\x80\x80\x80\xe6\x9d"),
            std::string(14, '?'))
      << "longer than it need be, a surrogate, beyond Unicode, cut off";
  EXPECT_EQ(for_terminal(std::string("a\0b", 3)), "a?b");
}

/// What /bin/bash makes of a word.
std::string as_bash_reads(const std::string& word) {
  const std::string command = "bash -c 'eval \"printf %s $WORD\"'";
  ::setenv("WORD", word.c_str(), 1);
  std::FILE* const pipe = ::popen(command.c_str(), "r");
  std::string read;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) read += static_cast<char>(c);
  ::pclose(pipe);
  return read;
}

TEST(ShellWord, IsOneWordWithEveryCharacter) {
  for (const std::string text : {"plain", "with blank", "it's", "'; touch owned; '",
                                 "$(x) `y` \\ \"", "a\nb\x1b[2J'\\", "M\xe4rz", "März", ""}) {
    EXPECT_EQ(as_bash_reads(shell_word(text)), text);
    EXPECT_EQ(for_terminal(shell_word(text)), shell_word(text)) << "can be printed";
  }
}

}  // namespace
}  // namespace terracut::cli
