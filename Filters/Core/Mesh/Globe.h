#ifndef dmgGlobe_h
#define dmgGlobe_h

#include "Support/Types.h"

#include <Eigen/Geometry> // For the cross product

#include <cmath>

/// Directions on globes around the origin, and globes from maps.
namespace dmg
{

/// The directions at a place of a globe: unit vectors, which are zero on the axis, where there is no east.
struct GlobeDirections
{
  Vector3 East;
  Vector3 North;
  Vector3 Up;
};

/// \param axis from the origin to the north pole, not zero.
inline GlobeDirections DirectionsOnGlobe(const Vector3& axis, const Vector3& place)
{
  constexpr double Rounding = 1e-6; // of coordinates in single precision
  const Vector3 up = place.stableNormalized();
  const Vector3 east = axis.normalized().cross(up);
  if (!(east.norm() > Rounding))
  {
    return { Vector3::Zero(), Vector3::Zero(), up };
  }
  return { east.normalized(), up.cross(east.normalized()), up };
}

/// The point of the unit sphere at a longitude and a latitude in degrees; the north pole is (0, 0, 1).
inline Vector3 OnUnitSphere(double longitude, double latitude)
{
  const double lambda = longitude * Pi / 180.0, phi = latitude * Pi / 180.0;
  return { std::cos(phi) * std::cos(lambda), std::cos(phi) * std::sin(lambda), std::sin(phi) };
}

/// The directions there; at the poles those of the meridian.
inline GlobeDirections DirectionsAt(double longitude, double latitude)
{
  const double lambda = longitude * Pi / 180.0;
  const Vector3 up = OnUnitSphere(longitude, latitude), east(-std::sin(lambda), std::cos(lambda), 0.0);
  return { east, up.cross(east), up };
}

}

#endif
