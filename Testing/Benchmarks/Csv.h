#ifndef dmgBenchmarksCsv_h
#define dmgBenchmarksCsv_h

#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace dmg::benchmarks
{

/// A table in a file, for spreadsheets and plots. Cells hold no commas; NaN is an empty cell.
class Csv
{
public:
  /// Makes the folder, if there is none.
  /// \throw std::runtime_error the file cannot be written.
  Csv(const std::filesystem::path& path, const std::string& header)
  {
    std::filesystem::create_directories(std::filesystem::absolute(path).parent_path());
    this->File.open(path);
    if (!this->File)
    {
      throw std::runtime_error("cannot write " + path.string());
    }
    this->File << header << "\n";
  }

  /// Written at once, so that a run that ends early leaves its rows.
  template <class... Cells>
  void Row(const Cells&... cells)
  {
    const char* separator = "";
    ((this->File << separator, this->Write(cells), separator = ","), ...);
    this->File << "\n" << std::flush;
  }

private:
  void Write(const std::string& text)
  {
    for (const char c : text)
    {
      this->File << (c == ',' ? ';' : c);
    }
  }
  void Write(int number) { this->File << number; }
  void Write(double number)
  {
    if (!std::isnan(number))
    {
      this->File << number;
    }
  }

  std::ofstream File;
};

}

#endif
