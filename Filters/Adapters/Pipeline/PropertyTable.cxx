#include "Adapters/Pipeline/PropertyTable.h"

#include "Adapters/Pipeline/PropertyRanges.h"

#include <cctype>
#include <iomanip>
#include <sstream>

namespace dmg
{

namespace
{

/// Digits by which numbers that differ are printed differently, but for roundings.
constexpr int Digits = 15;

std::string TextOf(double value)
{
  std::ostringstream text;
  text << std::setprecision(Digits) << value;
  return text.str();
}

/// "NumberOfQuads" becomes "Number Of Quads".
std::string LabelOf(const std::string& name)
{
  std::string label;
  for (const char letter : name)
  {
    label += std::isupper(static_cast<unsigned char>(letter)) && !label.empty() ? " " : "";
    label += letter;
  }
  return label;
}

}

PropertyTable::Row& PropertyTable::Add(const std::string& name, const std::string& text, double value)
{
  this->Rows.emplace_back();
  this->Rows.back().Name = name;
  this->Rows.back().Text = text;
  this->Rows.back().Value = value;
  return this->Rows.back();
}

PropertyTable::Row& PropertyTable::Number(const std::string& name, double value)
{
  return this->Add(name, TextOf(value), value);
}

PropertyTable::Row& PropertyTable::Number(const std::string& name, double value, double least, double most)
{
  Row& row = this->Add(name, TextOf(value), value);
  row.Least = least;
  row.Most = most;
  row.HasRange = true;
  return row;
}

PropertyTable::Row& PropertyTable::Choice(const std::string& name, int value, const std::vector<std::string>& names)
{
  const int size = static_cast<int>(names.size());
  Row& row = this->Number(name, value, 0, size - 1);
  row.Text = value >= 0 && value < size ? names[value] : "(out of range) " + row.Text;
  return row;
}

PropertyTable::Row& PropertyTable::Switch(const std::string& name, bool value)
{
  return this->Add(name, value ? "On" : "Off");
}

PropertyTable::Row& PropertyTable::Text(const std::string& name, const std::string& value)
{
  return this->Add(name, value);
}

PropertyTable::Row& PropertyTable::Vector(const std::string& name, const double* value)
{
  return this->Add(name, TextOf(value[0]) + " " + TextOf(value[1]) + " " + TextOf(value[2]));
}

PropertyTable::Row& PropertyTable::List(const std::string& name, const std::vector<double>& values)
{
  std::string text;
  for (const double value : values)
  {
    text += (text.empty() ? "" : " ") + TextOf(value);
  }
  return this->Add(name, text);
}

void PropertyTable::Check() const
{
  for (const Row& row : this->Rows)
  {
    if (row.HasRange)
    {
      const std::string label = LabelOf(row.Name);
      CheckRanges({ { label.c_str(), row.Value, row.Least, row.Most } });
    }
  }
}

void PropertyTable::Print(std::ostream& os, vtkIndent indent) const
{
  for (const Row& row : this->Rows)
  {
    os << indent << row.Name << ": " << row.Text << "\n";
  }
}

void PropertyTable::ToCore() const
{
  for (const Row& row : this->Rows)
  {
    row.ToCore ? row.ToCore() : void();
  }
}

void PropertyTable::ToFilter() const
{
  for (const Row& row : this->Rows)
  {
    row.ToFilter ? row.ToFilter() : void();
  }
}

}
