// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/io/checksum.h>
#include <talus/io/hdf5_image.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>

#include "observers_setup.h"

namespace
{
  using namespace talus;

  const std::vector<double> numbers = {0.1,
                                       -0.,
                                       std::numeric_limits<double>::infinity(),
                                       std::nan("3"),
                                       5e-324,
                                       1e300};

  std::string
  bytes()
  {
    Hdf5Image image;
    image.write("a group/numbers [m/s]", numbers, 3);
    image.write("one", {0.3});
    image.write("nothing", {}, 2);
    image.write_text("text/two lines", "two\nlines");
    image.write_text("empty", "");
    return image.bytes();
  }



  TEST(Hdf5Image, GivesBackWhatItGotBitByBit)
  {
    const Hdf5Image image(bytes(), "state.h5");
    const auto      found = image.read("a group/numbers [m/s]", 3);
    ASSERT_EQ(found.size(), numbers.size());
    EXPECT_EQ(std::memcmp(found.data(), numbers.data(), 8 * numbers.size()), 0);
    EXPECT_EQ(image.read_number("one"), 0.3);
    EXPECT_TRUE(image.read("nothing", 2).empty());
    EXPECT_EQ(image.read_text("text/two lines"), "two\nlines");
    EXPECT_EQ(image.read_text("empty"), "");
  }



  TEST(Hdf5Image, SameBytesAgain)
  {
    const std::string first = bytes();
    const Hdf5Image   open(first, "state.h5");
    EXPECT_EQ(bytes(), first);
  }



  // One array per number would take minutes.
  TEST(Hdf5Image, ManyNumbers)
  {
    Hdf5Image                 image;
    const std::vector<double> many(200000, 0.5);
    image.write("many", many, 100000);
    const Hdf5Image read(image.bytes(), "state.h5");
    EXPECT_EQ(read.read("many", 100000), many);
  }



  TEST(Hdf5Image, NamesWhatIsMissing)
  {
    const Hdf5Image image(bytes(), "/folder/state.h5");
    for (const auto &[name, n_columns] :
         {std::pair<std::string, unsigned int>{"numbers", 1},
          {"one", 2},
          {"a group", 1},
          {"a group/numbers [m/s]", 2},
          {"text/two lines", 1}})
      {
        const std::string sentence = sentence_thrown_by(
          [&, n = n_columns, &name = name]() { image.read(name, n); });
        for (const std::string &part :
             {"'" + name + "'", std::string("/folder/state.h5")})
          EXPECT_NE(sentence.find(part), std::string::npos) << sentence;
      }
    for (const std::string name : {"words", "one"})
      EXPECT_NE(sentence_thrown_by([&]() { image.read_text(name); }).find(name),
                std::string::npos);
    for (const std::string &content :
         {std::string(), std::string("no HDF5"), bytes().substr(0, 700)})
      {
        const Hdf5Image damaged(content, "state.h5");
        EXPECT_NE(sentence_thrown_by([&]() {
                    damaged.read("one");
                  }).find("'one'"),
                  std::string::npos);
      }
  }



  class ChecksumTest : public ObserversTest
  {};

  TEST_F(ChecksumTest, OfBlocksNoticesContentOrderAndLength)
  {
    const std::filesystem::path path   = folder / "file";
    const auto                  sum_of = [&](const std::string &content) {
      std::ofstream(path, std::ios::binary) << content;
      return checksum_of_file(path, MPI_COMM_WORLD);
    };
    EXPECT_EQ(checksum_of_file(path, MPI_COMM_WORLD), 0u);
    constexpr std::size_t block = 1 << 20;
    const std::string     a(block, 'a'), b(block, 'b'), rest = "the rest";
    const auto            sum = sum_of(a + b + rest);
    EXPECT_EQ(sum_of(a + b + rest), sum);
    EXPECT_EQ(checksum_of_file(path), checksum(a + b + rest));
    std::string last = a + b + rest;
    last.back() ^= 1;
    for (const std::string &other :
         {b + a + rest, a + b, a + a + rest, last, a + b + rest + '\0'})
      EXPECT_NE(sum_of(other), sum);
  }
} // namespace
