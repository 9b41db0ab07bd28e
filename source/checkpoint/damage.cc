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
    /// Every value that would be loaded against its checksum: costs one reading
    /// of the file.
    void
    verify_all(Hdf5InputFile &file)
    {
      std::vector<std::string> groups = {"cells", "points", "state", "text"};
      // Runs without obstacles have none.
      const std::vector<std::string> all = file.names("/");
      if (std::count(all.begin(), all.end(), "tables") > 0)
        groups.push_back("tables");
      for (const std::string &group : groups)
        for (const std::string &name : file.names(group))
          file.verify(group + "/" + name);
      file.verify("parameters");
      file.verify("mesh");
    }



    /// The attributes have no checksums of their own. The folder has the step as
    /// its name.
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
                    ", where that of its name was expected");
      return "";
    }



    /// The body of each point is the number of one. How many there are, only the
    /// parameters tell.
    std::string
    fault_of_bodies(Hdf5InputFile &file)
    {
      const unsigned int n =
        Utilities::MPI::n_mpi_processes(file.communicator());
      const unsigned int rank =
        Utilities::MPI::this_mpi_process(file.communicator());
      const std::string   name     = "points/body";
      const std::uint64_t n_points = file.shape(name).first;
      const std::uint64_t first    = n_points * rank / n;
      const std::uint64_t end      = n_points * (rank + 1) / n;
      const auto          bodies   = file.read(name, first, end - first);
      const std::string   names =
        parameter_in(file.read_text("parameters"), "Bodies/Names");
      if (!file.error().empty())
        return file.error();
      const double n_bodies = Utilities::split_string_list(names, ',').size();
      for (const double body : bodies)
        if (!(body >= 0. && body < n_bodies && body == std::floor(body)))
          return text("a point is of body ",
                      body,
                      ", where there are ",
                      n_bodies,
                      ", counted from 0");
      return "";
    }



    /// Numbers of points per cell are whole, weights are positive or 0. Returns
    /// the sum of the rows that this rank looks at, or NaN.
    double
    sum_of_counts(Hdf5InputFile &file, const std::uint64_t n_cells)
    {
      const unsigned int n =
        Utilities::MPI::n_mpi_processes(file.communicator());
      const unsigned int rank =
        Utilities::MPI::this_mpi_process(file.communicator());
      const std::uint64_t first = n_cells * rank / n;
      const std::uint64_t end   = n_cells * (rank + 1) / n;
      const auto points         = file.read("cells/points", first, end - first);
      const auto weights        = file.read("cells/weight", first, end - first);
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



    /// Whether all arrays are as long as they have to be: those of the cells
    /// alike, those of the points as the cells have points, and a share of each
    /// rank in the numbers.
    std::string
    fault_of_extents(Hdf5InputFile &file, const std::uint64_t n_ranks)
    {
      const std::uint64_t n_cells = file.shape("cells/points").first;
      const double        own_sum = sum_of_counts(file, n_cells);
      const double n_points = Utilities::MPI::sum(own_sum, file.communicator());
      if (!file.error().empty())
        return file.error();
      if (std::isnan(n_points) || file.shape("cells/weight").first != n_cells)
        return "the numbers of points per cell, or the weights of the cells, "
               "cannot be such";
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
                        " rows, where ",
                        expected,
                        " were expected");
      return file.error();
    }
  } // namespace



  /// All is looked at before anything is used: a damaged checkpoint is then left
  /// for the one before it. The mesh files are looked at by the first rank only.
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
    // Extents are told to all ranks alike, so that all of them come here.
    if (error.empty())
      error = fault_of_bodies(file);
    if (error.empty() && is_first_rank(file.communicator()) &&
        mesh_checksums(checkpoint) != saved)
      error = "the checksums of its mesh files do not match their content";
    return first_sentence(error, file.communicator());
  }
} // namespace talus
