#ifndef dmgSpatialOrder_h
#define dmgSpatialOrder_h

#include "Mesh/TangentFrames.h"
#include "Mesh/TriangleMesh.h"

#include <functional>
#include <vector>

namespace dmg
{

/// Orders items along Morton's curve through their positions in a cube. An item outside of the cube may come anywhere.
/// \param placeOf the position of an item; several threads call it.
/// \param size the side of the cube, whose corner of least coordinates is low.
std::vector<int> InSpatialOrder(int number, const std::function<Vector3(int)>& placeOf, const Vector3& low, double size,
  const ExecutionContext& context);

/// Orders faces along Morton's curve through their centres. Elements that CheckElements would refuse may come anywhere.
/// \pre corners are in range.
std::vector<int> FacesInSpatialOrder(const Points& points, const Triangles& triangles, const ExecutionContext& context);

/// A numbering in which neighbours in space are neighbours in memory: faces in spatial order, vertices by their first face.
/// Files number surfaces in any order, which may make walks from neighbour to neighbour slow.
/// Cost: O(#F).
class SpatialOrder
{
public:
  /// \pre as FacesInSpatialOrder; every vertex has a face.
  SpatialOrder(const Points& points, const Triangles& triangles, const ExecutionContext& context);

  /// [new number] is the old one.
  const std::vector<int>& Faces() const { return this->OldFaces; }
  const std::vector<int>& Vertices() const { return this->OldVertices; }

  /// Per edge of the mesh in this order: [new number] is the old one, and +1 where both are
  /// oriented alike, else -1.
  struct SignedEdges
  {
    std::vector<int> Numbers;
    Vector<double> Signs;
  };
  SignedEdges Edges(const TriangleMesh& mesh, const TriangleMesh& sorted) const;

  /// A copy of the surface in this order. The corners of a face keep their order.
  /// \throw InvalidInput as the constructor of TriangleMesh, with numbers of this order.
  TriangleMesh Apply(const Points& points, const Triangles& triangles, const ExecutionContext& context) const;
  TangentFrames ApplyToFaces(const TangentFrames& faceFrames, const ExecutionContext& context) const;

private:
  std::vector<int> OldFaces;
  std::vector<int> OldVertices;
  std::vector<int> NewVertices;
};

}

#endif
