#ifndef dmgBenchmarksCommandLine_h
#define dmgBenchmarksCommandLine_h

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

namespace dmg::benchmarks
{

/// The words after a program's name: options are taken out one by one, and what is left are paths.
class CommandLine
{
public:
  CommandLine(int argc, char* argv[])
    : Words(argv + 1, argv + argc)
  {
  }

  /// True if the option was given.
  bool Take(const std::string& option)
  {
    const auto found = std::find(this->Words.begin(), this->Words.end(), option);
    if (found == this->Words.end())
    {
      return false;
    }
    this->Words.erase(found);
    return true;
  }

  /// The word after the option, or what stood in \p value.
  void Take(const std::string& option, std::string& value)
  {
    const auto found = std::find(this->Words.begin(), this->Words.end(), option);
    if (found != this->Words.end() && found + 1 != this->Words.end())
    {
      value = *(found + 1);
      this->Words.erase(found, found + 2);
    }
  }
  void Take(const std::string& option, int& value)
  {
    std::string word = std::to_string(value);
    this->Take(option, word);
    value = std::atoi(word.c_str());
  }

  /// What has not been taken, without words that look like options.
  std::vector<std::string> Paths() const
  {
    std::vector<std::string> paths;
    std::copy_if(this->Words.begin(), this->Words.end(), std::back_inserter(paths),
      [](const std::string& word) { return word.rfind("--", 0) != 0; });
    return paths;
  }

  /// An option that nobody took.
  bool HasUnknown() const { return this->Paths().size() < this->Words.size(); }

private:
  std::vector<std::string> Words;
};

}

#endif
