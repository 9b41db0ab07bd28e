// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/application/command_line.h>
#include <talus/application/message.h>
#include <talus/application/parameter_file.h>
#include <talus/application/program.h>
#include <talus/base/agreement.h>
#include <talus/base/errors.h>
#include <talus/base/mpi_setup.h>
#include <talus/simulation/simulation.h>

#include <deal.II/base/mpi.h>

#include <chrono>
#include <iostream>
#include <thread>

namespace
{
  using namespace talus;

  /// Exit status of a run that was stopped and can be resumed: EX_TEMPFAIL of
  /// sysexits.h.
  constexpr int stopped = 75;



  /// Print the error and return the exit status. If all ranks failed, as for a
  /// wrong parameter, all end together after one sentence; if only some ranks
  /// failed, the rest waits in vain and is aborted.
  int
  fail(const std::string &sentence)
  {
    // A non-blocking barrier tells whether all ranks failed. Two seconds
    // suffice for ranks that fail for the same reason at the same time.
    MPI_Request all_failed;
    int         is_complete = 0;
    MPI_Ibarrier(MPI_COMM_WORLD, &all_failed);
    for (unsigned int i = 0; i < 200 && !is_complete; ++i)
      {
        MPI_Test(&all_failed, &is_complete, MPI_STATUS_IGNORE);
        if (!is_complete)
          std::this_thread::sleep_for(std::chrono::milliseconds(10));
      }
    if (is_first_rank(MPI_COMM_WORLD) || !is_complete)
      std::cerr << "talus: " << sentence << std::endl;
    if (!is_complete)
      MPI_Abort(MPI_COMM_WORLD, 1);
    return 1;
  }



  /// Save the last state after an error and return a sentence about it. If the
  /// saving fails, too, the first error must still be reported.
  template <int dim>
  std::string
  saved_state(Simulation<dim> &simulation)
  {
    try
      {
        const unsigned int rank =
          dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
        const bool is_alone =
          dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1;
        return (is_alone ? " The last state is in '"
                         : text(" The points of rank ", rank, " are in '")) +
               simulation.write_last_state() + "'.";
      }
    catch (const ExcUser &exception)
      {
        return " The last state was not saved: " + message(exception);
      }
  }



  /// Make all objects, which declare the parameters, then fill and run the
  /// simulation. Returns the exit status. An error of a point is rethrown with
  /// the place of the last state; only run_program() prints errors.
  template <int dim>
  int
  run(const CommandLine &command_line, const ParameterFile &file)
  {
    Simulation<dim> simulation(file.preview());
    file.parse();
    if (!command_line.output_folder.empty())
      simulation.output().set_folder(command_line.output_folder);
    if (command_line.overwrite)
      simulation.allow_overwriting();
    if (command_line.resume)
      simulation.resume();
    else
      simulation.set_up();
    if (command_line.validate)
      {
        simulation.check_output_folder();
        simulation.forecast();
        const std::string remarks = simulation.count_of_remarks();
        if (is_first_rank(MPI_COMM_WORLD))
          std::cout << command_line.parameter_file << " is valid"
                    << (remarks.empty() ? "" : ", with " + remarks) << "."
                    << std::endl;
        return 0;
      }
    try
      {
        return simulation.run() ? 0 : stopped;
      }
    catch (const ExcPoint &exception)
      {
        throw ExcPoint(message(exception) + saved_state(simulation));
      }
  }



  /// Choose the template argument by the dimension in the parameter file.
  int
  act(const CommandLine &command_line)
  {
    if (command_line.document)
      {
        if (is_first_rank(MPI_COMM_WORLD))
          document(std::cout);
        return 0;
      }
    const ParameterFile file(command_line.parameter_file,
                             command_line.overrides);
    return file.preview().dimension == 2 ? run<2>(command_line, file)
                                         : run<3>(command_line, file);
  }
} // namespace



namespace talus
{
  int
  run_program(int argc, char **argv)
  {
    // Call before MPI starts, as MPI reads the environment only then.
    prepare_mpi();
    // Pass no options to the libraries: PETSc, if part of deal.II, would report
    // unused options at the end.
    int                                      n_words = 1;
    dealii::Utilities::MPI::MPI_InitFinalize mpi(n_words, argv, 1);
    try
      {
        const auto command_line = parse_command_line(argc, argv);
        return command_line.has_value() ? act(*command_line) : 0;
      }
    // Only here a run is ended after an error.
    catch (const std::exception &exception)
      {
        return fail(message(exception));
      }
  }
} // namespace talus
