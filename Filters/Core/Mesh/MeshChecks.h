#ifndef dmgMeshChecks_h
#define dmgMeshChecks_h

#include "Support/Types.h"

#include <string>
#include <vector>

namespace dmg
{

/// The names of elements in error messages. Entry i is the caller's number of vertex or face i; an empty list stands for equal
/// numbers.
struct ElementNames
{
  std::vector<long long> Vertices;
  std::vector<long long> Faces;

  /// "point 12", the caller's words for vertex i.
  std::string Vertex(int i) const;
  /// "cell 812", the caller's words for face i.
  std::string Face(int i) const;
};

/// Refuses elements that are wrong by themselves, naming the element and the remedy: no face at
/// all, a corner index out of range, a repeated corner, a non-finite point, a face whose corners
/// share one place, an unused vertex. Coordinates beyond 1e40 are refused, as well as surfaces no larger than
/// 1e-40 and faces no larger than 1e-60: doubles hardly hold the squares of their areas.
/// The constructor of TriangleMesh starts with it; refusals about how faces meet come from there.
/// \throw InvalidInput
/// Cost: O(#V + #F).
void CheckElements(const Points& points, const Triangles& triangles, const ElementNames& names = {});

}

#endif
