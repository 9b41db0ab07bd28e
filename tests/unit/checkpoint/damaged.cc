// SPDX-License-Identifier: LGPL-2.1-or-later
// Every damage of the newest checkpoint is noticed, whatever the file, and the
// previous checkpoint is used. Preset `sanitize` runs this under
// AddressSanitizer.

#include <talus/checkpoint/checkpoint.h>
#include <talus/checkpoint/checkpoint_folder.h>

#include <gtest/gtest.h>

#include <map>
#include <random>

#include "observers_setup.h"

namespace
{
  using namespace talus;
  namespace fs = std::filesystem;

  class DamagedCheckpoint : public ObserversTest
  {
  protected:
    DamagedCheckpoint()
      : checkpoint(std::make_unique<Checkpoint<2>>())
      , scene("0, 0", "8, 4")
    {
      scene.add({0.5, 0.5});
      scene.add({7.5, 3.5}, 3.);
      scene.add({0.25, 0.5}, 2.);
      scene.sort();
      state.add("answer", "-", answer, Reduction::equal);
      checkpoint->begin(folder, MPI_COMM_WORLD);
      previous = write(3);
      newest   = write(4);
      for (const auto &entry : fs::directory_iterator(newest))
        {
          std::ifstream in(entry.path(), std::ios::binary);
          sound[entry.path().filename()].assign(
            std::istreambuf_iterator<char>(in), {});
        }
    }

    fs::path
    write(const unsigned long step)
    {
      return checkpoint->write({scene.grid,
                                scene.points,
                                std::vector<double>(32, 1.),
                                state,
                                "subsection Bodies\n set Names = soil\nend\n",
                                step,
                                0.1 * step,
                                1.});
    }

    void
    store(const std::string &name, const std::string &content) const
    {
      std::ofstream(newest / name, std::ios::binary) << content;
    }

    /// The damage is noticed, the message names the file, and a sound file
    /// makes the checkpoint usable again.
    void
    expect_noticed(const std::string &name, const std::string &content) const
    {
      SCOPED_TRACE(name);
      store(name, content);
      FoundCheckpoint found = find_checkpoint(folder, 2, MPI_COMM_WORLD);
      EXPECT_EQ(found.path, previous);
      ASSERT_EQ(found.errors.size(), 1u);
      EXPECT_NE(found.errors[0].find("'" + name + "'"), std::string::npos)
        << found.errors[0];
      store(name, sound.at(name));
    }

    std::unique_ptr<Checkpoint<2>>     checkpoint;
    Scene<2>                           scene;
    StateList                          state;
    double                             answer = 42.;
    fs::path                           previous, newest;
    std::map<std::string, std::string> sound;
  };



  TEST_F(DamagedCheckpoint, FilesAreListed)
  {
    ASSERT_EQ(sound.size(), 6u);
    for (const auto &[name, content] : sound)
      {
        EXPECT_TRUE(is_checkpoint_file(name)) << name;
        EXPECT_EQ(sound["checksums"].find(name + ' ') != std::string::npos,
                  true)
          << name;
      }
    EXPECT_EQ(find_checkpoint(folder, 2, MPI_COMM_WORLD).path, newest);
  }



  // One to four bits anywhere.
  TEST_F(DamagedCheckpoint, FlippedBits)
  {
    std::mt19937 random(7);
    for (const auto &[name, content] : sound)
      for (unsigned int i = 0; i < 50; ++i)
        {
          std::string        damaged = content;
          const unsigned int n_bits  = 1 + random() % 4;
          for (unsigned int bit = 0; bit < n_bits; ++bit)
            damaged[random() % content.size()] ^= char(1 << random() % 8);
          if (damaged != content)
            expect_noticed(name, damaged);
        }
  }



  TEST_F(DamagedCheckpoint, FilesThatEndEarlyOrLate)
  {
    for (const auto &[name, content] : sound)
      {
        for (const std::size_t n :
             {std::size_t(0), content.size() / 2, content.size() - 1})
          expect_noticed(name, content.substr(0, n));
        expect_noticed(name, content + content);
        // Zeros at the end, as behind a write that was cut short.
        std::string zeros = content;
        zeros.replace(zeros.size() / 2, zeros.npos, zeros.size() / 2, '\0');
        expect_noticed(name, zeros);
      }
  }



  TEST_F(DamagedCheckpoint, FilesAreMissingOrOfAnotherStep)
  {
    for (const auto &[name, content] : sound)
      {
        fs::remove(newest / name);
        EXPECT_EQ(find_checkpoint(folder, 2, MPI_COMM_WORLD).path, previous)
          << name;
        store(name, content);
      }
    fs::copy_file(previous / "state.h5",
                  newest / "state.h5",
                  fs::copy_options::overwrite_existing);
    EXPECT_EQ(find_checkpoint(folder, 2, MPI_COMM_WORLD).path, previous);
  }
} // namespace
