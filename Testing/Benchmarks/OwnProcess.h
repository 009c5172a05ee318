#ifndef dmgBenchmarksOwnProcess_h
#define dmgBenchmarksOwnProcess_h

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace dmg::benchmarks
{

/// What came of work in a process of its own.
struct ProcessOutcome
{
  std::string Result;  ///< bytes
  std::string Failure; ///< why there is no result, else empty
};

/// Does work() in a process of its own, which starts as a copy of this one: its memory can be
/// counted, it can be stopped whatever library it is in, and it takes nobody with it when it fails.
/// \param work a function () -> std::string; what it throws becomes the failure.
/// \pre this process runs no threads that the work needs.
template <class Work>
ProcessOutcome InOwnProcess(int limitSeconds, const Work& work)
{
  int ends[2];
  std::fflush(nullptr);
  const pid_t child = pipe(ends) == 0 ? fork() : -1;
  if (child < 0)
  {
    return { "", "no process could be started" };
  }
  if (child == 0)
  {
    close(ends[0]);
    prctl(PR_SET_PDEATHSIG, SIGKILL); // nobody would read what it finds
    std::string message;
    try
    {
      message = "+" + work();
    }
    catch (const std::exception& error)
    {
      message = std::string("-") + error.what();
    }
    for (std::size_t sent = 0; sent < message.size();)
    {
      const ssize_t count = write(ends[1], message.data() + sent, message.size() - sent);
      if (count <= 0)
      {
        break;
      }
      sent += static_cast<std::size_t>(count);
    }
    std::exit(0);
  }

  close(ends[1]);
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(limitSeconds);
  std::string message;
  bool isLate = false;
  for (;;)
  {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
    pollfd readable = { ends[0], POLLIN, 0 };
    isLate = left.count() <= 0 || poll(&readable, 1, static_cast<int>(left.count())) == 0;
    if (isLate)
    {
      kill(child, SIGKILL);
      break;
    }
    char bytes[65536];
    const ssize_t count = read(ends[0], bytes, sizeof(bytes));
    if (count <= 0)
    {
      break;
    }
    message.append(bytes, static_cast<std::size_t>(count));
  }
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (isLate)
  {
    return { "", "stopped after " + std::to_string(limitSeconds) + " s" };
  }
  if (message.empty())
  {
    return { "",
      WIFSIGNALED(status) ? "ended by signal " + std::to_string(WTERMSIG(status)) : "ended without a result" };
  }
  return message[0] == '+' ? ProcessOutcome{ message.substr(1), "" } : ProcessOutcome{ "", message.substr(1) };
}

}

#endif
