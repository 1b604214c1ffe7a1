// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/artefact/sha256.h"

#include <gtest/gtest.h>

#include "tests/unit/artefact/temporary_folder.h"

namespace roomcut::test {

TEST(Sha256, gives_the_digests_of_the_standard) {
  EXPECT_EQ(sha256_hex(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256_hex("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(Sha256, does_not_depend_on_how_the_bytes_are_cut) {
  const std::string text(100000, 'x');
  Sha256 sha;
  for (std::size_t at = 0; at < text.size(); at += 777) {
    sha.update(std::string_view(text).substr(at, 777));
  }
  EXPECT_EQ(sha.hex(), sha256_hex(text));
}

TEST(Sha256, of_a_file_is_that_of_its_bytes) {
  const TemporaryFolder folder;
  const std::string text(3000000, 'y');
  put_bytes(folder / "a", text);
  EXPECT_EQ(sha256_of_file(folder / "a"), sha256_hex(text));
}

TEST(Sha256, of_a_file_that_is_not_there_is_refused) {
  const TemporaryFolder folder;
  EXPECT_EQ(code_of([&] { sha256_of_file(folder / "none"); }), "A01");
  EXPECT_EQ(code_of([&] { sha256_of_file(folder.path()); }), "A01");
}

}  // namespace roomcut::test
