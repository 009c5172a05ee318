#include "Support/Processes.h"

#include "Support/Errors.h"

#include <algorithm>
#include <sstream>

namespace dmg
{

namespace
{

/// The kind of exception that a step has thrown.
enum class Outcome : char
{
  Done,
  Invalid,
  Failed,
  NoMemory,
  Stopped
};

Outcome OutcomeOf(const std::function<void()>& step, std::string& message)
{
  try
  {
    step();
    return Outcome::Done;
  }
  catch (const Cancelled&)
  {
    return Outcome::Stopped;
  }
  catch (const std::bad_alloc&)
  {
    return Outcome::NoMemory;
  }
  catch (const InvalidInput& error)
  {
    message = error.what();
    return Outcome::Invalid;
  }
  catch (const std::exception& error)
  {
    message = error.what();
    return Outcome::Failed;
  }
}

std::vector<std::string> LinesOf(const std::string& text)
{
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);)
  {
    lines.push_back(line);
  }
  return lines;
}

[[noreturn]] void Throw(Outcome outcome, const std::string& message)
{
  switch (outcome)
  {
    case Outcome::Stopped:
      throw Cancelled();
    case Outcome::NoMemory:
      throw MemoryRanOut();
    case Outcome::Invalid:
      throw InvalidInput(message);
    default:
      throw SolverFailure(message);
  }
}

}

void Processes::Together(const std::function<void()>& step) const
{
  std::string message;
  const Outcome outcome = OutcomeOf(step, message);
  const int first = this->Least(outcome == Outcome::Done ? this->Size() : this->Rank());
  if (first < this->Size())
  {
    const std::string text = this->TextOf(first, static_cast<char>(outcome) + message);
    const std::string name = first == 0 || text.size() == 1 ? "" : "on rank " + std::to_string(first) + ": ";
    Throw(static_cast<Outcome>(text[0]), name + text.substr(1));
  }
}

void Processes::Checkpoint(const ExecutionContext& context, double fraction) const
{
  this->Together([&] { context.Checkpoint(fraction); });
}

std::string Processes::FirstText(const std::string& here) const
{
  const int first = this->Least(here.empty() ? this->Size() : this->Rank());
  return first < this->Size() ? this->TextOf(first, here) : "";
}

void Processes::CheckSame(const std::string& here, const std::string& what) const
{
  const std::vector<std::string> all = this->Gather(here);
  std::vector<std::string> first = LinesOf(all[0]);
  for (std::size_t rank = 1; rank < all.size(); ++rank)
  {
    std::vector<std::string> other = LinesOf(all[rank]);
    first.resize(std::max(first.size(), other.size()));
    other.resize(first.size());
    const auto [a, b] = std::mismatch(first.begin(), first.end(), other.begin());
    if (a != first.end())
    {
      throw InvalidInput("ranks 0 and " + std::to_string(rank) + " differ in " + what + ": \"" + *a + "\" and \"" + *b +
        "\"; give all ranks the same");
    }
  }
}

}
