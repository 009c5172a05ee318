#include "Preparation/PreparationReport.h"

namespace dmg
{

bool PreparationReport::IsChanged() const
{
  return this->CellsTurned + this->CellsDoubled + this->EdgesParted + this->EdgesCut + this->PointsParted > 0;
}

std::string PreparationReport::Text() const
{
  std::string text;
  const auto add = [&text](int count, const std::string& singular, const std::string& done)
  {
    if (count > 0)
    {
      text +=
        (text.empty() ? "" : ", ") + std::to_string(count) + " " + singular + (count == 1 ? "" : "s") + " " + done;
    }
  };
  add(this->CellsTurned, "cell", "turned");
  add(this->PointsJoined, "point", "joined");
  add(this->CellsDoubled, "cell", "doubled");
  add(this->CellsCollapsed, "cell", "without area");
  add(this->EdgesParted, "edge", "of more than two sheets parted");
  add(this->EdgesCut, "edge", "cut, as the surface has one side only");
  add(this->PointsParted, "pinched point", "parted");
  return text;
}

}
