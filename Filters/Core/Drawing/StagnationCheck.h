#ifndef dmgStagnationCheck_h
#define dmgStagnationCheck_h

#include "Support/Types.h"

namespace dmg
{

/// Detects a path over triangles that makes no progress, as one that turns around a vertex without end. Over 300 triangles it has
/// come less than a distance away, though its length is ten times that; or over 10,000 triangles less than 20 distances, as where it
/// winds around a spike. A path that crosses a band of thin triangles goes on.
class StagnationCheck
{
public:
  StagnationCheck(const Vector3& start, double distance)
    : Before(start)
    , LongBefore(start)
    , Last(start)
    , Distance(distance)
  {
  }

  /// Whether the path makes no progress; to be asked after each triangle.
  /// \param now where the path is.
  bool IsStagnant(const Vector3& now)
  {
    constexpr int Triangles = 300, ManyTriangles = 10'000;
    constexpr double Detour = 10.0, ManyDistances = 20.0;
    this->Length += (now - this->Last).norm();
    this->Last = now;
    if (++this->CrossedLong >= ManyTriangles)
    {
      return true;
    }
    if ((now - this->LongBefore).norm() >= ManyDistances * this->Distance)
    {
      this->LongBefore = now;
      this->CrossedLong = 0;
    }
    if (++this->Crossed % Triangles != 0)
    {
      return false;
    }
    const double moved = (now - this->Before).norm();
    const bool isStagnant = !(moved >= this->Distance || Detour * moved > this->Length); // also where nothing is finite
    this->Before = now;
    this->Length = 0.0;
    return isStagnant;
  }

private:
  Vector3 Before, LongBefore, Last;
  double Length = 0.0; ///< since Before
  const double Distance;
  int Crossed = 0;
  int CrossedLong = 0; ///< since LongBefore
};

}

#endif
