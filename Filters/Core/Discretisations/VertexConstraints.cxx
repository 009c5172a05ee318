#include "Discretisations/VertexConstraints.h"

#include "Operators/ConnectionLaplacian.h"

#include "Support/Errors.h"
#include "Support/Remedy.h"
#include "Support/ShortText.h"

#include <algorithm>
#include <cmath>

namespace dmg
{

namespace
{

/// Faces without area hold their corners, too.
constexpr double SmallestShare = 1e-9;

/// The share of a face's area that counts at a corner of it: a third, or half at both ends of a side.
double PartOfCorner(int corner, int side)
{
  if (side < 0)
  {
    return 1.0 / 3.0;
  }
  return corner == (side + 2) % 3 ? 0.0 : 0.5;
}

}

void CheckValue(const ValueConstraint& value, const std::string& name)
{
  if (!std::isfinite(value.Value) || !(value.Weight > 0.0) || !std::isfinite(value.Weight))
  {
    throw InvalidInput("the value " + ShortText(value.Value) + " with the weight " + ShortText(value.Weight) +
      ", prescribed on " + name + ", is not finite or its weight not positive; repair it, or leave the point out, " +
      TextOf(Remedy::MaskOfValues));
  }
}

void CheckSource(const Vector<double>& source, int numberOfVertices, const ElementNames& names)
{
  if (source.size() != numberOfVertices)
  {
    throw InvalidInput("the source has " + std::to_string(source.size()) + " numbers in place of one for each of the " +
      std::to_string(numberOfVertices) + " vertices");
  }
  for (int vertex = 0; vertex < numberOfVertices; ++vertex)
  {
    if (!(std::abs(source[vertex]) <= LargestPrescribed))
    {
      throw InvalidInput("the source is " + ShortText(source[vertex]) + " at " + names.Vertex(vertex) +
        ", which is not finite or too large; repair it");
    }
  }
}

std::vector<char> SurroundedVertices(const TriangleMesh& mesh, const std::vector<Constraint>& onFaces)
{
  std::vector<char> isPrescribed(mesh.NumberOfFaces(), 0);
  for (const Constraint& onFace : onFaces)
  {
    CheckElement(onFace.Element, mesh.NumberOfFaces(), "face");
    isPrescribed[onFace.Element] |= onFace.Side < 0;
  }
  std::vector<char> isSurrounded(mesh.NumberOfVertices(), 1);
  for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
  {
    isSurrounded[mesh.Tail(h)] &= isPrescribed[TriangleMesh::FaceOf(h)];
  }
  return isSurrounded;
}

std::vector<PowerAtVertex> PowersAtVertices(const FramedMesh& surface, const VertexConnection& connection, int N,
  const Constraints& constraints, const std::vector<char>& isSurrounded, const ElementNames& names)
{
  const TriangleMesh& mesh = surface.Mesh;
  const Vector<double> areas = LumpedMass(mesh);
  std::vector<PowerAtVertex> sums(mesh.NumberOfVertices());
  for (const Constraint& onFace : constraints.OnFaces)
  {
    const int face = onFace.Element;
    CheckElement(face, mesh.NumberOfFaces(), "face");
    const auto isInside = [&](int k) { return isSurrounded[mesh.FaceCorners()(face, k)] != 0; };
    const bool holdsInside = onFace.Side < 0 && (isInside(0) || isInside(1) || isInside(2));
    const Complex v = TangentialPart(surface.Faces, face, onFace.Direction, onFace.Weight, names.Face(face), "cell");
    const double area = mesh.FaceArea(face);
    for (int k = 0; k < 3; ++k)
    {
      if (const double part = PartOfCorner(k, onFace.Side); part > 0.0 && (isInside(k) || !holdsInside))
      {
        const int h = 3 * face + k;
        const int vertex = mesh.Tail(h);
        const double share = std::max(part * area, SmallestShare * areas[vertex]) / areas[vertex];
        sums[vertex].Add(
          onFace.Weight * (areas[vertex] > 0.0 ? share : 1.0), PowerOfDirection(connection.TurnFromFace(h) * v, N));
      }
    }
  }
  for (const Constraint& atVertex : constraints.AtVertices)
  {
    const int vertex = atVertex.Element;
    CheckElement(vertex, mesh.NumberOfVertices(), "vertex");
    const Complex v =
      TangentialPart(surface.Vertices, vertex, atVertex.Direction, atVertex.Weight, names.Vertex(vertex), "point");
    sums[vertex].Add(atVertex.Weight, PowerOfDirection(v, N));
  }
  return sums;
}

}
