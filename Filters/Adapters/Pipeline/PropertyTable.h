#ifndef dmgPropertyTable_h
#define dmgPropertyTable_h

#include "vtkIndent.h"

#include <functional>
#include <limits>
#include <ostream>
#include <string>
#include <vector>

namespace dmg
{

/// The properties of a filter, a row each: its name, value and range. PrintSelf prints the rows, by which ranks compare filters; RequestData
/// checks them; and what a row says of a member of the core's options is the default of the property, and what RequestData asks the core
/// for.
class PropertyTable
{
public:
  struct Row
  {
    std::string Name; ///< "NumberOfQuads", which the window calls "Number Of Quads"
    std::string Text; ///< the value, as PrintSelf prints it
    double Value = 0.0;
    double Least = -std::numeric_limits<double>::infinity(); ///< the range of numbers and choices
    double Most = std::numeric_limits<double>::infinity();
    bool HasRange = false;
    std::function<void()> ToCore, ToFilter; ///< empty where it is of no member

    /// The value is that of a member of the core's options. \param set takes another value.
    template <class Member, class Setter, class Number>
    void Is(Member& member, Number value, const Setter& set)
    {
      this->ToCore = [&member, value] { member = static_cast<Member>(value); };
      this->ToFilter = [&member, set] { set(static_cast<Number>(member)); };
    }
  };

  /// A number in a range; without one, any number.
  Row& Number(const std::string& name, double value);
  Row& Number(
    const std::string& name, double value, double least, double most = std::numeric_limits<double>::infinity());
  /// A choice from 0 on.
  Row& Choice(const std::string& name, int value, const std::vector<std::string>& names);
  Row& Switch(const std::string& name, bool value);
  Row& Text(const std::string& name, const std::string& value);
  Row& Vector(const std::string& name, const double* value);
  Row& List(const std::string& name, const std::vector<double>& values);

  /// \throw InvalidInput a value is out of its range, or not a number: the label of the first, its value and the range.
  void Check() const;
  void Print(std::ostream& os, vtkIndent indent) const;
  /// Gives the members of the core the values of the properties, or the properties those of the core.
  void ToCore() const;
  void ToFilter() const;

private:
  Row& Add(const std::string& name, const std::string& text, double value = 0.0);

  std::vector<Row> Rows;
};

}

#endif
