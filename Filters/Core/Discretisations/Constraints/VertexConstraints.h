#ifndef dmgVertexConstraints_h
#define dmgVertexConstraints_h

#include "Constraints/Constraints.h"
#include "Mesh/FramedMesh.h"
#include "Mesh/VertexConnection.h"

#include <string>
#include <vector>

namespace dmg
{

/// The sum of the constraints at a vertex.
struct PowerAtVertex
{
  double Weight = 0.0;
  Complex Power = 0.0; ///< the N-th powers of the directions, each times its weight

  void Add(double weight, Complex power)
  {
    this->Weight += weight;
    this->Power += weight * power;
  }
};

/// Checks a value of a function. \param name of its vertex.
/// \throw InvalidInput it is not finite, or its weight not positive.
void CheckValue(const ValueConstraint& value, const std::string& name);
/// \throw InvalidInput there is not one number for each vertex, or one is not finite or too large.
void CheckSource(const Vector<double>& source, int numberOfVertices, const ElementNames& names);

/// Vertices with directions on all faces around. On the boundary of a region with directions on faces, a vertex has them on one side
/// only. Their mean is then the direction half an edge inside of the region.
/// \throw InvalidInput there is no such face.
std::vector<char> SurroundedVertices(const TriangleMesh& mesh, const std::vector<Constraint>& onFaces);

/// Constraints as a power field at points takes them, per vertex of the mesh. A direction on a face counts at its corners, each with
/// the part of the vertex's area that the face has there; where a corner is surrounded, at such corners alone. A direction
/// along a side counts at both ends of it. Where sides of a curve meet, their mean is the tangent of the curve, however uneven they are.
/// \param isSurrounded SurroundedVertices.
/// \throw InvalidInput as CheckElement and TangentialPart.
std::vector<PowerAtVertex> PowersAtVertices(const FramedMesh& surface, const VertexConnection& connection, int N,
  const Constraints& constraints, const std::vector<char>& isSurrounded, const ElementNames& names);

}

#endif
