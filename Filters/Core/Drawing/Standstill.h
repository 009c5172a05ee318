#ifndef dmgStandstill_h
#define dmgStandstill_h

#include "Support/Types.h"

namespace dmg
{

/// Whether a way over triangles turns around one place, as it does without end where these are tiny in one direction.
class Standstill
{
public:
  /// \param distance that it must go while it crosses so many triangles; longer steps back and forth do not count.
  Standstill(const Vector3& start, double distance)
    : Before(start)
    , Distance(distance)
  {
  }

  /// To be asked after each triangle. \param place() where the way is.
  template <class Place>
  bool IsReached(const Place& place)
  {
    constexpr int Triangles = 300;
    if (++this->Crossed % Triangles != 0)
    {
      return false;
    }
    const Vector3 now = place();
    const bool hasMoved = (now - this->Before).norm() >= this->Distance; // not where it is not finite
    this->Before = now;
    return !hasMoved;
  }

private:
  Vector3 Before;
  const double Distance;
  int Crossed = 0;
};

}

#endif
