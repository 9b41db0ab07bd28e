// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/application/program.h>

#include <sys/wait.h>

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

// Runs the program as often as it is asked to, each time in a process of its
// own, but loads its libraries only once. deal.II brings two hundred of them,
// which takes longer than most of what the tests of bad input ask for.
//
// A request comes on standard input: how many arguments there are, the time
// limit in seconds, the folder to run in, files for standard output and
// standard error, and the arguments, each ended by a zero byte. The answer is a
// line with the exit status or, as a negative number, the signal that ended the
// run.

namespace
{
  struct Request
  {
    unsigned int             time_limit; // s
    std::string              folder, output, error;
    std::vector<std::string> arguments;
  };



  std::string
  next_string()
  {
    std::string result;
    std::getline(std::cin, result, '\0');
    return result;
  }



  /// False at the end of the requests.
  bool
  read_request(Request &request)
  {
    const std::string n_arguments = next_string();
    if (!std::cin)
      return false;
    request.time_limit = std::stoi(next_string());
    request.folder     = next_string();
    request.output     = next_string();
    request.error      = next_string();
    request.arguments  = {"talus"};
    for (int i = std::stoi(n_arguments); i > 0; --i)
      request.arguments.push_back(next_string());
    return bool(std::cin);
  }



  void
  redirect(const std::string &file, const int flags, const int descriptor)
  {
    const int opened = open(file.c_str(), flags, 0666);
    if (opened < 0 || dup2(opened, descriptor) < 0)
      {
        std::perror(file.c_str());
        std::_Exit(126);
      }
    close(opened);
  }



  /// Does not return, and leaves as main() does.
  [[noreturn]] void
  run(Request &request)
  {
    if (chdir(request.folder.c_str()) != 0)
      {
        std::perror(request.folder.c_str());
        std::_Exit(126);
      }
    redirect("/dev/null", O_RDONLY, STDIN_FILENO);
    redirect(request.output, O_WRONLY | O_CREAT | O_TRUNC, STDOUT_FILENO);
    redirect(request.error, O_WRONLY | O_CREAT | O_TRUNC, STDERR_FILENO);
    std::vector<char *> argv;
    for (std::string &argument : request.arguments)
      argv.push_back(argument.data());
    argv.push_back(nullptr);
    alarm(request.time_limit);
    std::exit(talus::run_program(argv.size() - 1, argv.data()));
  }
} // namespace



int
main()
{
  Request request;
  while (read_request(request))
    {
      const pid_t child = fork();
      if (child == 0)
        run(request);
      int status = 0;
      if (child < 0 || waitpid(child, &status, 0) != child)
        {
          std::perror("talus-fork-server");
          return 1;
        }
      std::cout << (WIFSIGNALED(status) ? -WTERMSIG(status)
                                        : WEXITSTATUS(status))
                << std::endl;
    }
}
