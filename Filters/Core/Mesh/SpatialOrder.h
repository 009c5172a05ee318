#ifndef dmgSpatialOrder_h
#define dmgSpatialOrder_h

#include "Mesh/TangentFrames.h"
#include "Mesh/TriangleMesh.h"

#include <functional>
#include <vector>

namespace dmg
{

/// Things along Morton's curve through their places in a cube. One that stands outside of the cube may come anywhere.
/// \param placeOf that of each of them; several threads ask.
/// \param size the side of the cube, whose corner of least coordinates is low.
std::vector<int> InSpatialOrder(int number, const std::function<Vector3(int)>& placeOf, const Vector3& low, double size,
  const ExecutionContext& context);

/// The faces along Morton's curve through their centres. No coordinates are refused: elements that CheckElements
/// would refuse stand anywhere.
/// \pre corners are in range.
std::vector<int> FacesInSpatialOrder(const Points& points, const Triangles& triangles, const ExecutionContext& context);

/// A numbering in which neighbours in space are neighbours in memory: faces in
/// spatial order, vertices by their first face. Files number surfaces in any order, and walks
/// from neighbour to neighbour are slow in a bad one.
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

  /// The same surface in this order; the corners of a face stay in theirs.
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
