// SPDX-License-Identifier: LGPL-2.1-or-later
// Checkpoints that no run has written: whatever is in the newest, it is
// noticed, without a crash and without memory for what is not there, and the
// one before it is used. Preset `sanitize` runs this under AddressSanitizer.

#include <talus/checkpoint/checkpoint.h>
#include <talus/checkpoint/checkpoint_folder.h>
#include <talus/io/checksum.h>
#include <talus/io/hdf5_handle.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "observers_setup.h"

namespace
{
  using namespace talus;
  namespace fs = std::filesystem;
  using Bytes  = std::vector<char>;

  /// Put an attribute of this type and extent (0: one value) in the place of
  /// the one that is there.
  void
  replace_attribute(const hid_t        file,
                    const std::string &object,
                    const std::string &name,
                    const hid_t        type,
                    const hsize_t      extent,
                    const void        *values)
  {
    const Hdf5Handle at(H5Oopen(file, object.c_str(), H5P_DEFAULT), H5Oclose);
    H5Adelete(at, name.c_str());
    const Hdf5Handle space(extent == 0 ? H5Screate(H5S_SCALAR)
                                       : H5Screate_simple(1, &extent, nullptr),
                           H5Sclose);
    const Hdf5Handle attribute(
      H5Acreate2(at, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT),
      H5Aclose);
    ASSERT_TRUE(attribute.is_valid());
    if (values != nullptr)
      {
        ASSERT_GE(H5Awrite(attribute, type, values), 0);
      }
  }



  void
  replace_attribute(const hid_t         file,
                    const std::string  &object,
                    const std::string  &name,
                    const std::uint64_t value)
  {
    replace_attribute(file, object, name, H5T_STD_U64LE, 0, &value);
  }



  /// Put an array of any type and extents in the place of the one that is
  /// there; without values nothing of it is in the file.
  void
  replace_array(const hid_t                 file,
                const std::string          &name,
                const hid_t                 type,
                const std::vector<hsize_t> &extents,
                const void                 *values    = nullptr,
                const bool                  in_chunks = false,
                const std::uint64_t         checksum_ = 0)
  {
    H5Ldelete(file, name.c_str(), H5P_DEFAULT);
    const int        n_dims = extents.size();
    const Hdf5Handle space(n_dims == 0 ? H5Screate(H5S_SCALAR)
                                       : H5Screate_simple(n_dims,
                                                          extents.data(),
                                                          nullptr),
                           H5Sclose);
    const Hdf5Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    if (in_chunks)
      {
        const std::vector<hsize_t> chunk(n_dims, 1024);
        H5Pset_chunk(properties, n_dims, chunk.data());
        H5Pset_deflate(properties, 9);
      }
    const Hdf5Handle array(
      H5Dcreate2(
        file, name.c_str(), type, space, H5P_DEFAULT, properties, H5P_DEFAULT),
      H5Dclose);
    ASSERT_TRUE(array.is_valid()) << name;
    if (values != nullptr)
      {
        ASSERT_GE(H5Dwrite(array, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values),
                  0);
      }
    replace_attribute(file, name, "checksum", checksum_);
  }



  /// A list of doubles whose checksum is right.
  void
  replace_list(const hid_t                file,
               const std::string         &name,
               const std::vector<double> &values)
  {
    replace_array(file,
                  name,
                  H5T_IEEE_F64LE,
                  {values.size()},
                  values.data(),
                  false,
                  checksum(values, 0));
  }



  struct Craft
  {
    std::string                what;
    std::function<void(hid_t)> change;
  };



  std::vector<Craft>
  heads()
  {
    std::vector<Craft> crafts;
    for (const std::string name :
         {"format version", "ranks", "step", "time [s]"})
      {
        crafts.push_back(
          {name + " is an array", [name](const hid_t file) {
             const std::vector<std::uint64_t> many(1000, 1);
             replace_attribute(
               file, "/", name, H5T_STD_U64LE, 1000, many.data());
           }});
        crafts.push_back(
          {name + " is negative", [name](const hid_t file) {
             const std::int64_t value = -1;
             replace_attribute(file, "/", name, H5T_STD_I64LE, 0, &value);
           }});
        crafts.push_back({name + " is a pointer", [name](const hid_t file) {
                            const Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
                            H5Tset_size(type, H5T_VARIABLE);
                            const char *value = "text";
                            replace_attribute(file, "/", name, type, 0, &value);
                          }});
      }
    crafts.push_back({"version is an array", [](const hid_t file) {
                        replace_attribute(file,
                                          "/",
                                          "talus version",
                                          H5T_C_S1,
                                          5000,
                                          std::string(5000, 'a').data());
                      }});
    for (const std::uint64_t n : {0ull, 2ull, 1ull << 32, ~0ull})
      crafts.push_back({text("ranks = ", n), [n](const hid_t file) {
                          replace_attribute(file, "/", "ranks", n);
                        }});
    crafts.push_back({"another step", [](const hid_t file) {
                        replace_attribute(file, "/", "step", 5);
                      }});
    crafts.push_back(
      {"no end time", [](const hid_t file) {
         const double nan = std::nan("");
         replace_attribute(file, "/", "end time [s]", H5T_IEEE_F64LE, 0, &nan);
       }});
    return crafts;
  }



  std::vector<Craft>
  arrays()
  {
    std::vector<Craft> crafts;
    for (const std::string name :
         {"state/numbers", "cells/points", "cells/weight", "points/mass"})
      {
        const auto add = [&](const std::string          &what,
                             const hid_t                 type,
                             const std::vector<hsize_t> &extents,
                             const bool                  in_chunks = false) {
          crafts.push_back(
            {name + what, [=](const hid_t file) {
               replace_array(file, name, type, extents, nullptr, in_chunks);
             }});
        };
        add(" is huge", H5T_IEEE_F64LE, {hsize_t(1) << 40});
        add(" has huge columns", H5T_IEEE_F64LE, {hsize_t(1) << 40, 100});
        add(" is huge in chunks", H5T_IEEE_F64LE, {hsize_t(1) << 40}, true);
        add(" has many columns", H5T_IEEE_F64LE, {1, 70000});
        add(" has three dimensions", H5T_IEEE_F64LE, {1, 1, 1});
        add(" is one number", H5T_IEEE_F64LE, {});
        add(" has integers", H5T_STD_I64LE, {32});
        add(" is empty", H5T_IEEE_F64LE, {0});
        crafts.push_back(
          {name + " is a group", [name](const hid_t file) {
             H5Ldelete(file, name.c_str(), H5P_DEFAULT);
             H5Gclose(H5Gcreate2(
               file, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
           }});
        crafts.push_back(
          {name + " leads elsewhere", [name](const hid_t file) {
             H5Ldelete(file, name.c_str(), H5P_DEFAULT);
             H5Lcreate_external(
               "/dev/zero", "/", file, name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
           }});
      }
    return crafts;
  }



  /// The checksums are right, but no run has such numbers.
  std::vector<Craft>
  numbers()
  {
    std::vector<Craft> crafts;
    const double       inf = std::numeric_limits<double>::infinity();
    for (const double value : {-1., 0.5, 1e300, 5e9, inf, -inf, std::nan("")})
      crafts.push_back(
        {text(value, " points in a cell"), [=](const hid_t file) {
           std::vector<double> counts(32, 0.);
           counts[0] = value;
           replace_list(file, "cells/points", counts);
         }});
    for (const double value : {-1., 0.5, 1., 1e9, inf, std::nan("")})
      crafts.push_back({text("body ", value), [=](const hid_t file) {
                          replace_list(file, "points/body", {0., value, 0.});
                        }});
    for (const double value : {-1., inf, std::nan("")})
      crafts.push_back(
        {text("weight ", value), [=](const hid_t file) {
           replace_list(file, "cells/weight", std::vector<double>(32, value));
         }});
    for (const std::string name :
         {"cells/weight", "points/mass", "state/numbers"})
      for (const unsigned int n : {0, 2, 5})
        crafts.push_back({text(n, " rows of ", name), [=](const hid_t file) {
                            replace_list(file, name, std::vector<double>(n));
                          }});
    return crafts;
  }



  std::vector<Craft>
  texts()
  {
    std::vector<Craft> crafts;
    for (const std::string name : {"parameters", "mesh", "text/words"})
      {
        crafts.push_back({name + " of 2 GB", [name](const hid_t file) {
                            const Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
                            H5Tset_size(type, (1ul << 31) - 1);
                            replace_array(file, name, type, {});
                          }});
        crafts.push_back({name + " is a pointer", [name](const hid_t file) {
                            const Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
                            H5Tset_size(type, H5T_VARIABLE);
                            const std::string value(100, 'a');
                            const char       *pointer = value.c_str();
                            replace_array(file, name, type, {}, &pointer);
                          }});
        crafts.push_back(
          {name + " is many texts", [name](const hid_t file) {
             const std::string value(1000, 'a');
             replace_array(file, name, H5T_C_S1, {1000}, value.c_str());
           }});
      }
    return crafts;
  }



  class CraftedCheckpoint : public ObserversTest
  {
  protected:
    CraftedCheckpoint()
      : checkpoint(std::make_unique<Checkpoint<2>>())
      , scene("0, 0", "8, 4")
    {
      scene.add({0.5, 0.5});
      scene.add({7.5, 3.5}, 3.);
      scene.add({0.25, 0.5}, 2.);
      scene.sort();
      state.add("answer", "-", answer, Reduction::equal);
      state.add_text(
        {"words", []() { return "some"; }, [](const std::string &) {}});
      checkpoint->begin(folder, MPI_COMM_WORLD);
      previous = write(3);
      newest   = write(4);
      std::ifstream in(newest / "state.h5", std::ios::binary);
      sound.assign(std::istreambuf_iterator<char>(in), {});
    }

    fs::path
    write(const unsigned long step)
    {
      return checkpoint->write({scene.points,
                                std::vector<double>(32, 1.),
                                state,
                                "subsection Bodies\n set Names = soil\nend\n",
                                step,
                                0.1 * step,
                                1.},
                               scene.grid);
    }

    void
    store(const Bytes &content) const
    {
      std::ofstream(newest / "state.h5", std::ios::binary)
        .write(content.data(), content.size());
    }

    FoundCheckpoint
    find() const
    {
      return find_checkpoint(folder, 2, MPI_COMM_WORLD);
    }

    void
    expect_noticed(const std::vector<Craft> &crafts)
    {
      for (const Craft &craft : crafts)
        {
          SCOPED_TRACE(craft.what);
          store(sound);
          {
            const Hdf5Handle file(H5Fopen((newest / "state.h5").c_str(),
                                          H5F_ACC_RDWR,
                                          H5P_DEFAULT),
                                  H5Fclose);
            craft.change(file);
          }
          const FoundCheckpoint found = find();
          EXPECT_EQ(found.path, previous);
          EXPECT_EQ(found.errors.size(), 1u);
        }
    }

    std::unique_ptr<Checkpoint<2>> checkpoint;
    Scene<2>                       scene;
    StateList                      state;
    double                         answer = 42.;
    fs::path                       previous, newest;
    Bytes                          sound;
  };



  TEST_F(CraftedCheckpoint, Heads)
  {
    expect_noticed(heads());
  }

  TEST_F(CraftedCheckpoint, Arrays)
  {
    expect_noticed(arrays());
  }

  TEST_F(CraftedCheckpoint, Numbers)
  {
    expect_noticed(numbers());
  }

  TEST_F(CraftedCheckpoint, Texts)
  {
    expect_noticed(texts());
  }



  // One to four bits anywhere, and files that end early. Where nothing is
  // noticed, all that is loaded is as it was.
  TEST_F(CraftedCheckpoint, FlippedBits)
  {
    std::mt19937 random(7);
    unsigned int n_noticed = 0;
    for (unsigned int i = 0; i < 500; ++i)
      {
        Bytes              content = sound;
        const unsigned int n_bits  = 1 + random() % 4;
        for (unsigned int bit = 0; bit < n_bits; ++bit)
          content[random() % content.size()] ^= char(1 << random() % 8);
        if (i % 20 == 0)
          content.resize(random() % content.size());
        store(content);
        const FoundCheckpoint found = find();
        n_noticed += (found.path == previous);
        if (found.path == previous)
          continue;
        EXPECT_EQ(found.head.step, 4u);
        Hdf5InputFile file(newest / "state.h5", MPI_COMM_WORLD);
        answer = 0.;
        load_state(file, state);
        EXPECT_EQ(answer, 42.);
      }
    EXPECT_GT(n_noticed, 100u);
  }
} // namespace
