// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/agreement.h>
#include <talus/base/errors.h>
#include <talus/checkpoint/checkpoint_folder.h>
#include <talus/checkpoint/damage.h>
#include <talus/checkpoint/parameter_changes.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Compare every value to be loaded with its checksum, in one pass over the
    /// file.
    void
    verify_all(Hdf5InputFile &file)
    {
      std::vector<std::string> groups = {"cells", "points", "state", "text"};
      // Runs without obstacles have no tables.
      const std::vector<std::string> all = file.names("/");
      if (std::count(all.begin(), all.end(), "tables") > 0)
        groups.push_back("tables");
      for (const std::string &group : groups)
        for (const std::string &name : file.names(group))
          file.verify(group + "/" + name);
      file.verify("parameters");
      file.verify("mesh");
    }



    /// Check the attributes, which have no checksums. The name of the folder is
    /// the step.
    std::string
    fault_of(const CheckpointHead        &head,
             const std::filesystem::path &checkpoint)
    {
      if (head.n_ranks == 0 ||
          head.n_ranks > std::numeric_limits<unsigned int>::max())
        return text("it is of ", head.n_ranks, " ranks");
      if (!std::isfinite(head.time) || !std::isfinite(head.end_time))
        return text("it is at t = ", head.time, " of ", head.end_time, " s");
      if (checkpoint_path({}, head.step).filename() != checkpoint.filename())
        return text("it is of step ",
                    head.step,
                    ", but the name of its folder is another step");
      return "";
    }



    /// Check that the body of each point is a valid index. The number of bodies
    /// is known from the parameters only.
    std::string
    fault_of_bodies(Hdf5InputFile &file)
    {
      const std::string name    = "points/body";
      const auto [first, n_own] = file.share_of_rank(file.shape(name).first);
      const auto        bodies  = file.read(name, first, n_own);
      const std::string names =
        values_by_path(file.read_text("parameters"))["Bodies/Names"];
      if (!file.error().empty())
        return file.error();
      const double n_bodies = Utilities::split_string_list(names, ',').size();
      for (const double body : bodies)
        if (!(body >= 0. && body < n_bodies && body == std::floor(body)))
          return text("a point is of body ",
                      body,
                      ", but there are ",
                      n_bodies,
                      " bodies, counted from 0");
      return "";
    }



    /// Check that numbers of points per cell are whole and weights finite and
    /// not negative. Return the sum of the numbers of points in the rows read
    /// by this rank, or NaN.
    double
    sum_of_counts(Hdf5InputFile &file, const std::uint64_t n_cells)
    {
      const auto [first, n_own] = file.share_of_rank(n_cells);
      const auto points         = file.read("cells/points", first, n_own);
      const auto weights        = file.read("cells/weight", first, n_own);
      double     sum            = 0.;
      bool       is_good        = true;
      for (const double count : points)
        {
          is_good = is_good && count >= 0. && count < 4294967295. &&
                    count == std::floor(count);
          sum += count;
        }
      for (const double weight : weights)
        is_good = is_good && weight >= 0. && std::isfinite(weight);
      return is_good ? sum : std::numeric_limits<double>::quiet_NaN();
    }



    /// Check the lengths of all arrays: equal for arrays of cells, the number
    /// of points for columns, the number of ranks for numbers of the state.
    std::string
    fault_of_extents(Hdf5InputFile &file, const std::uint64_t n_ranks)
    {
      const std::uint64_t n_cells = file.shape("cells/points").first;
      const double        own_sum = sum_of_counts(file, n_cells);
      const double n_points = Utilities::MPI::sum(own_sum, file.communicator());
      if (!file.error().empty())
        return file.error();
      if (std::isnan(n_points) || file.shape("cells/weight").first != n_cells)
        return "the numbers of points per cell or the weights of the cells are "
               "impossible";
      for (const auto &[group, expected] :
           {std::pair<std::string, double>("points", n_points),
            std::pair<std::string, double>("state", n_ranks)})
        for (const std::string &name : file.names(group))
          if (const auto n = file.shape(group + "/" + name).first;
              n != expected)
            return text("'",
                        group,
                        "/",
                        name,
                        "' has ",
                        n,
                        " rows; ",
                        expected,
                        " expected");
      return file.error();
    }
  } // namespace



  /// Everything is checked before anything is used: instead of a damaged
  /// checkpoint the previous one is loaded. Only the first rank reads the mesh
  /// files.
  std::string
  find_damage(Hdf5InputFile &file, const CheckpointHead &head)
  {
    const std::filesystem::path checkpoint = file.path().parent_path();
    verify_all(file);
    const std::string saved = file.read_text("mesh");
    std::string       error = file.error();
    if (error.empty())
      error = fault_of(head, checkpoint);
    if (error.empty())
      error = fault_of_extents(file, head.n_ranks);
    // Errors in extents are identical on all ranks, so all ranks continue here.
    if (error.empty())
      error = fault_of_bodies(file);
    if (error.empty() && is_first_rank(file.communicator()) &&
        mesh_checksums(checkpoint) != saved)
      error = "the checksums of its mesh files do not match their content";
    return first_sentence(error, file.communicator());
  }
} // namespace talus
