// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/application/command_line.h>
#include <talus/application/message.h>
#include <talus/application/parameter_file.h>
#include <talus/application/program.h>
#include <talus/application/run.h>
#include <talus/base/agreement.h>
#include <talus/base/errors.h>
#include <talus/base/mpi_setup.h>

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



  /// Make the run and advance it to the end, or describe it. Returns the exit
  /// status. Only run_program() prints errors.
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
                             command_line.overrides,
                             MPI_COMM_WORLD);
    RunOptions          options;
    options.output_folder = command_line.output_folder;
    options.resume        = command_line.resume;
    options.overwrite     = command_line.overwrite;
    Run run(file, options, MPI_COMM_WORLD);
    if (!command_line.validate)
      return run.advance_to_end() ? 0 : stopped;
    run.check_output_folder();
    run.forecast();
    const std::string remarks = run.count_of_remarks();
    if (is_first_rank(MPI_COMM_WORLD))
      std::cout << command_line.parameter_file << " is valid"
                << (remarks.empty() ? "" : ", with " + remarks) << "."
                << std::endl;
    return 0;
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
