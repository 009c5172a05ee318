#ifndef dmgJointFlattening_h
#define dmgJointFlattening_h

#include "StructurePreserving/Decimation/OneRing.h"

#include <complex>
#include <vector>

namespace dmg
{

/// Lays the faces of a one-ring before and after the collapse into one plane, such that both fill
/// the same polygon: the least-squares conformal map of the two together, with the corners of the
/// polygon shared. Liu et al. 2021, section 4; thesis, section 3.5.
///
/// An object keeps its work space and serves one thread.
class JointFlattening
{
public:
  enum class Method
  {
    /// Angles are kept as well as possible; may fold thin or strongly bent rings.
    Conformal,
    /// A polygon inscribed in a circle and uniform weights inside: never folds, keeps no angles.
    ConvexPolygon,
  };

  /// \return false where the map is not one-to-one: a face after the collapse, or one of positive
  /// area before, is not counter-clockwise, or the fan winds around the hub more than once.
  bool Flatten(const OneRing& ring, Method method);

  /// Positions in the plane by the local numbers of the ring.
  const std::vector<Complex>& Plane() const { return this->Positions; }

private:
  void FlattenConformally(const OneRing& ring);
  void FlattenIntoCircle(const OneRing& ring);
  void PinBoundary(const OneRing& ring);
  bool IsOneToOne(const OneRing& ring) const;
  void AddTriangle(const OneRing& ring, const std::array<int, 3>& corners);
  void SolveForFree();

  std::vector<Complex> Positions;
  std::vector<int> Unknown; // local number -> unknown, or -1 where pinned
  std::vector<int> Vertex;  // unknown -> local number
  std::vector<Complex> A;   // dense Hermitian, lower triangle by rows
};

}

#endif
